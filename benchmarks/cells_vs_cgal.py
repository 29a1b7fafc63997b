#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Pieces and seconds of our convex cells beside CGAL's convex_decomposition_3.

Every file is given to CGAL (with a time limit) and to us, one after the other on one machine.
All seconds are processor seconds of all threads, so that a busy machine does not tell. Of ours
two are taken: ``call`` is the whole Python call on arrays in memory with validation and
verification, the mean of `REPEATS`; ``cli`` the command line from start to end with reading and
writing. CGAL's ``decompose`` is convex_decomposition_3 alone, without making the Nef polyhedron.
Totals are over the files where CGAL succeeds.

Usage: ``cells_vs_cgal.py [FOLDER] --cgal PROGRAM [-o RESULT.json] [--limit S] [--only REGEX]``
"""

from __future__ import annotations

import argparse
import json
import math
import os
import platform
import re
import resource
import signal
import subprocess
import sys
import tempfile
from pathlib import Path
from typing import Any

ROOT = Path(__file__).resolve().parents[1]
REPEATS = 3

WORKER = """
import json, sys, time
from freecad_tetra import convex_cells
from freecad_tetra.api import as_solid
solid = as_solid(sys.argv[1])
start = time.process_time()
for _ in range(int(sys.argv[2])):
    cells = convex_cells(solid, method="bajaj-dey")
call = (time.process_time() - start) / int(sys.argv[2])
report = cells.report.to_dict()
print(json.dumps({
    "pieces": len(cells), "call": call, "triangles": len(solid.triangles),
    "volume": float(cells.volumes().sum()), "seconds": report["seconds"],
    "counts": report["counts"],
}))
"""


def timed(command: list[str], limit: float) -> tuple[dict[str, Any], str]:
    """Run a command for at most `limit` processor seconds; return seconds, status and output."""

    def set_limit() -> None:
        resource.setrlimit(resource.RLIMIT_CPU, (math.ceil(limit), math.ceil(limit) + 1))

    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    done = subprocess.run(
        command, capture_output=True, text=True, cwd=ROOT, check=False, preexec_fn=set_limit
    )
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    seconds = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
    if done.returncode == 0:
        status = "ok"
    elif done.returncode in (-signal.SIGXCPU, -signal.SIGKILL):
        status = f"over {limit:g} s"
    else:
        status = f"exit {done.returncode}"
    return {"status": status, "cpu": seconds}, done.stdout


def run_cgal(program: Path, file: Path, limit: float) -> dict[str, Any]:
    """Return what CGAL makes of a file."""
    result, output = timed([str(program), str(file)], limit)
    if result["status"] == "ok":
        result |= json.loads(output)
    return result


def run_ours(file: Path, limit: float) -> dict[str, Any]:
    """Return what we make of a file, by Python and by the command line."""
    result, output = timed([sys.executable, "-c", WORKER, str(file), str(REPEATS)], limit)
    if result["status"] != "ok":
        return result
    result |= json.loads(output)
    with tempfile.TemporaryDirectory() as folder:
        command = [str(Path(sys.executable).with_name("freecad-tetra")), "cells", str(file)]
        cli, _ = timed([*command, "-o", str(Path(folder) / "cells.obj")], limit)
    if cli["status"] != "ok":
        result["status"] = f"command line: {cli['status']}"
    result["cli"] = cli["cpu"]
    return result


def totals(rows: list[dict[str, Any]]) -> dict[str, Any]:
    """Return sums and ratios over the files where both succeed."""
    both = [r for r in rows if r["cgal"]["status"] == "ok" and r["ours"]["status"] == "ok"]
    missed = [r["name"] for r in rows if r["ours"]["status"] != "ok"]
    if not both:
        return {"files": 0, "failed": missed}
    cgal_seconds = sum(r["cgal"]["decompose"] for r in both)
    cgal_pieces = sum(r["cgal"]["pieces"] for r in both)
    pieces = sum(r["ours"]["pieces"] for r in both)
    worst = max(both, key=lambda r: r["ours"]["pieces"] / r["cgal"]["pieces"])
    result: dict[str, Any] = {
        "files": len(both),
        "failed": missed,
        "cgal_seconds": cgal_seconds,
        "cgal_pieces": cgal_pieces,
        "pieces": pieces,
        "pieces_ratio": pieces / cgal_pieces,
        "worst_pieces_ratio": worst["ours"]["pieces"] / worst["cgal"]["pieces"],
        "worst_file": worst["name"],
    }
    for key in ("call", "cli"):
        seconds = sum(r["ours"][key] for r in both)
        result[f"{key}_seconds"] = seconds
        result[f"times_faster_{key}"] = cgal_seconds / seconds
    return result


def line_of(row: dict[str, Any]) -> str:
    """Return one line of the table."""
    cgal, ours = row["cgal"], row["ours"]
    theirs = (
        f"{cgal['pieces']:6d} {cgal['decompose']:8.3f}"
        if "pieces" in cgal
        else (f"{cgal['status']:>15s}")
    )
    mine = (
        f"{ours['pieces']:6d} {ours['call']:8.4f} {ours['cli']:7.2f}"
        if "cli" in ours
        else ours["status"]
    )
    return f"{row['name']:36.36s} {theirs} | {mine}"


def parse(arguments: list[str]) -> argparse.Namespace:
    """Return the options of the command line."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    default = ROOT.parent / "shared/corpus/off"
    parser.add_argument("folder", type=Path, nargs="?", default=default, help="OFF files")
    parser.add_argument("--cgal", type=Path, required=True, help="the program cgal_cells")
    parser.add_argument("-o", "--output", type=Path, help="JSON file to write")
    parser.add_argument("--limit", type=float, default=40.0, help="processor seconds for CGAL")
    parser.add_argument("--our-limit", type=float, default=240.0, help="processor seconds for us")
    parser.add_argument("--only", default="", help="files whose name this expression matches")
    return parser.parse_args(arguments)


def main(arguments: list[str]) -> int:
    """Measure, print a table, write the JSON; 1 when one of our runs fails."""
    options = parse(arguments)
    files = sorted(options.folder.glob("*.off"), key=lambda file: (file.stat().st_size, file.name))
    rows: list[dict[str, Any]] = []
    print(f"{'file':36s} {'CGAL':>6s} {'s':>8s} | {'ours':>6s} {'call s':>8s}   cli s")
    for file in (file for file in files if re.search(options.only, file.name)):
        cgal = run_cgal(options.cgal, file, options.limit)
        rows.append({"name": file.stem, "cgal": cgal, "ours": run_ours(file, options.our_limit)})
        print(line_of(rows[-1]), flush=True)
    summary = totals(rows)
    print(json.dumps(summary, indent=1))
    if options.output:
        machine = {"processor": platform.machine(), "cores": os.cpu_count()}
        result = {"machine": machine, "limit": options.limit, "totals": summary, "files": rows}
        options.output.parent.mkdir(parents=True, exist_ok=True)
        options.output.write_text(json.dumps(result, indent=1) + "\n", encoding="utf-8")
    return 1 if summary["failed"] else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
