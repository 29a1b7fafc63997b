#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Tetrahedra and seconds of our tetrahedralisation beside TetGen's.

Every file is given to TetGen and to us, by default and with compact=max, one after the other on
one machine and each in a process of its own. All times are those of one call on arrays in memory,
the mean of `REPEATS`: ``cpu`` processor seconds of all threads, ``wall`` seconds by the clock;
ours with validation and verification, TetGen's for the switch p (the surface is kept as a set,
Steiner points may divide it, no quality). Totals are over the files where all three succeed.
TetGen comes from PyPI into an environment of its own; the product never needs it.

Usage: ``tets_vs_tetgen.py [FILE|FOLDER]... [-o RESULT.json] [--limit S] [--only REGEX]``
"""

from __future__ import annotations

import argparse
import csv
import json
import os
import platform
import re
import sys
import tempfile
from pathlib import Path
from typing import Any

from cells_vs_cgal import ROOT, timed
from peer import python_with

CORPUS = ROOT.parent / "shared/corpus"
TETGEN = "tetgen==0.8.4"
REPEATS = 3
STEINER = ("steiner_edge", "steiner_facet", "steiner_inner")

# Issue 3: the most tetrahedra per TetGen's, by default, with compact=max and on any one file,
# the most files with Steiner points left, and the most seconds per TetGen's.
TARGETS = {
    "default_tets_ratio": 1.0,
    "max_tets_ratio": 0.9,
    "max_worst_ratio": 1.1,
    "max_steiner_share": 0.25,
    "default_cpu_ratio": 1.0,
}

OURS = """
import json, sys, time
from freecad_tetra import as_solid, kernel, tetrahedralize
kernel.load()
solid, repeats = as_solid(sys.argv[1]), int(sys.argv[3])
cpu, wall = time.process_time(), time.perf_counter()
for _ in range(repeats):
    mesh = tetrahedralize(solid, compact=sys.argv[2])
cpu, wall = (time.process_time() - cpu) / repeats, (time.perf_counter() - wall) / repeats
report = mesh.report.to_dict()
print(json.dumps({
    "tets": len(mesh), "cpu": cpu, "wall": wall, "counts": report["counts"],
    "seconds": report["seconds"], "volume_error": report["volume_error"],
}))
"""

THEIRS = """
import json, sys, time
import numpy, tetgen
arrays = numpy.load(sys.argv[1])
cpu = wall = 0.0
for _ in range(int(sys.argv[2])):
    mesher = tetgen.TetGen(arrays["vertices"], arrays["triangles"])
    start = time.process_time(), time.perf_counter()
    points, tets, *_ = mesher.tetrahedralize(switches="pQ")
    cpu += time.process_time() - start[0]
    wall += time.perf_counter() - start[1]
repeats = int(sys.argv[2])
print(json.dumps({
    "tets": len(tets), "cpu": cpu / repeats, "wall": wall / repeats,
    "steiner": len(points) - len(arrays["vertices"]),
}))
"""


def last_line(run: tuple[dict[str, Any], str]) -> dict[str, Any]:
    """Return status and, of a run that succeeded, the figures in its last line of output."""
    result, output = run
    if result["status"] != "ok":
        return {"status": result["status"]}
    figures: dict[str, Any] = json.loads(output.splitlines()[-1])
    return {"status": "ok", **figures}


def run_tetgen(python: Path, file: Path, limit: float) -> dict[str, Any]:
    """Return what TetGen makes of the very arrays that we get."""
    import numpy as np

    from freecad_tetra import as_solid

    solid = as_solid(file)
    with tempfile.TemporaryDirectory() as folder:
        arrays = Path(folder) / "surface.npz"
        np.savez(arrays, vertices=solid.vertices, triangles=solid.triangles)
        found = timed([str(python), "-c", THEIRS, str(arrays), str(REPEATS)], REPEATS * limit)
    return last_line(found)


def run_ours(file: Path, compact: str, limit: float) -> dict[str, Any]:
    """Return what we make of a file."""
    command = [sys.executable, "-c", OURS, str(file), compact, str(REPEATS)]
    result = last_line(timed(command, REPEATS * limit))
    if result["status"] == "ok":
        counts = result.pop("counts")
        result["steiner"] = sum(counts.get(key, 0) for key in STEINER)
    return result


def manifest() -> dict[str, int]:
    """Return the counts of TetGen that the corpus lists."""
    with (CORPUS / "manifest.csv").open(encoding="utf-8") as lines:
        return {row["name"]: int(row["tetgen_tets"]) for row in csv.DictReader(lines)}


def totals(rows: list[dict[str, Any]]) -> dict[str, Any]:
    """Return sums and ratios over the files where all runs succeed."""
    ways = ("default", "max")
    done = [r for r in rows if all(r[way]["status"] == "ok" for way in (*ways, "tetgen"))]
    result: dict[str, Any] = {
        "files": len(done),
        "failed": [r["name"] for r in rows if any(r[way]["status"] != "ok" for way in ways)],
        "tetgen_failed": [r["name"] for r in rows if r["tetgen"]["status"] != "ok"],
    }
    if not done:
        return result
    for way in ("tetgen", *ways):
        for key in ("tets", "cpu", "wall"):
            result[f"{way}_{key}"] = sum(r[way][key] for r in done)
        with_steiner = [r["name"] for r in done if r[way]["steiner"]]
        result[f"{way}_steiner_points"] = sum(r[way]["steiner"] for r in done)
        result[f"{way}_steiner_files"] = with_steiner
        result[f"{way}_steiner_share"] = len(with_steiner) / len(done)
    listed = [r for r in done if r["listed_tets"]]
    for way in ways:
        for key in ("tets", "cpu", "wall"):
            result[f"{way}_{key}_ratio"] = result[f"{way}_{key}"] / result[f"tetgen_{key}"]
        worst = max(done, key=lambda r: r[way]["tets"] / r["tetgen"]["tets"])
        result[f"{way}_worst_ratio"] = worst[way]["tets"] / worst["tetgen"]["tets"]
        result[f"{way}_worst_file"] = worst["name"]
        if listed:
            ours, theirs = (
                sum(r[way]["tets"] for r in listed),
                sum(r["listed_tets"] for r in listed),
            )
            result[f"{way}_tets_per_listed"] = ours / theirs
            result[f"{way}_worst_per_listed"] = max(
                r[way]["tets"] / r["listed_tets"] for r in listed
            )
    result["missed"] = [key for key, most in TARGETS.items() if result[key] > most]
    return result


def line_of(row: dict[str, Any]) -> str:
    """Return one line of the table."""
    parts = [f"{row['name']:34.34s}"]
    for way in ("tetgen", "default", "max"):
        found = row[way]
        if found["status"] != "ok":
            parts.append(f"{found['status']:>24s}")
            continue
        parts.append(
            f"{found['tets']:6d} {found['steiner']:4d} {found['cpu']:6.3f} {found['wall']:5.2f}"
        )
    if all(row[way]["status"] == "ok" for way in ("tetgen", "max")):
        parts.append(f"{row['max']['tets'] / row['tetgen']['tets']:5.3f}")
    return " | ".join(parts)


def parse(arguments: list[str]) -> argparse.Namespace:
    """Return the options of the command line."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("inputs", type=Path, nargs="*", help="OFF or STL files, or folders")
    parser.add_argument("--venv", type=Path, default=ROOT / "build/benchmark-venv", help="TetGen's")
    parser.add_argument("-o", "--output", type=Path, help="JSON file to write")
    parser.add_argument("--limit", type=float, default=60.0, help="processor seconds of a call")
    parser.add_argument("--only", default="", help="files whose name this expression matches")
    return parser.parse_args(arguments)


def files_of(inputs: list[Path], only: str) -> list[Path]:
    """Return the surfaces in files and folders, the small ones first."""
    found = [
        file.resolve()
        for given in inputs or [CORPUS / "off"]
        for file in (given.iterdir() if given.is_dir() else [given])
        if file.suffix.lower() in (".off", ".stl") and re.search(only, file.name)
    ]
    return sorted(found, key=lambda file: (file.stat().st_size, file.name))


def main(arguments: list[str]) -> int:
    """Measure, print a table, write the JSON; 1 when a run of ours fails or misses a target."""
    options = parse(arguments)
    python = python_with(TETGEN, options.venv)
    listed = manifest()
    columns = f"{'tets':>6s} {'St.':>4s} {'cpu s':>6s} {'wall':>5s}"
    print(f"{'TetGen, ours, ours compact=max':34s} | {columns} | {columns} | {columns} | ratio")
    rows: list[dict[str, Any]] = []
    for file in files_of(options.inputs, options.only):
        row: dict[str, Any] = {"name": file.stem, "listed_tets": listed.get(file.stem)}
        row["tetgen"] = run_tetgen(python, file, options.limit)
        row |= {way: run_ours(file, way, options.limit) for way in ("default", "max")}
        rows.append(row)
        print(line_of(row), flush=True)
    summary = totals(rows)
    print(json.dumps(summary, indent=1))
    if options.output:
        machine = {"processor": platform.machine(), "cores": os.cpu_count()}
        result = {"machine": machine, "tetgen": TETGEN, "totals": summary, "files": rows}
        options.output.parent.mkdir(parents=True, exist_ok=True)
        options.output.write_text(json.dumps(result, indent=1) + "\n", encoding="utf-8")
    return 1 if summary["failed"] or summary.get("missed") else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
