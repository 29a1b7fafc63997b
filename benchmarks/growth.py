#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""How seconds, memory and pieces grow with the size of the input.

Every run is a process of its own. ``cpu`` and ``wall`` are the seconds of the whole call on
arrays in memory with validation and verification; ``peak`` is the most memory that the process
ever held, Python and input with it. The families: a torus with bumps and a ball, both with
whole-number corners that the kernel's grid of 2**20 steps has ("off-grid" ones are larger than
that, so that their corners are rounded and restored; "turned" ones are doubles); and Chazelle's
lower-bound family, where N notches cross N others. Targets are in `TARGETS`.

Usage: ``growth.py [-o RESULT.json] [--plot PICTURE.png] [--limit S] [--only REGEX]``
"""

from __future__ import annotations

import argparse
import json
import math
import os
import platform
import re
import sys
from pathlib import Path
from typing import Any

from cells_vs_cgal import timed

TORI = {2 * u * v: (u, v) for u, v in ((25, 20), (50, 50), (100, 100), (250, 200))}
BALLS = {2 * u * (v - 1): (u, v) for u, v in ((100, 51), (250, 101), (500, 501))}
BUMPS = 0.3
NOTCHES = (2, 3, 4, 6, 8, 16, 32)
CELLS_UP_TO = 5000

# The most wall seconds and bytes that the biggest solids may take (issue 3).
TARGETS: dict[tuple[str, int], tuple[float, int | None]] = {
    ("torus", 100_000): (180.0, 6 * 2**30),
    ("ball", 500_000): (120.0, None),
}

WORKER = """
import json, resource, sys, time
sys.path.insert(0, "tests")
import freecad_tetra, shapes_exact
maker, arguments, turn, kind, memory = json.loads(sys.argv[1])
resource.setrlimit(resource.RLIMIT_AS, (memory, memory))
surface = shapes_exact.turned(getattr(shapes_exact, maker)(*arguments), turn)
solid = freecad_tetra.as_solid(surface)
call = freecad_tetra.tetrahedralize if kind == "tets" else freecad_tetra.convex_cells
cpu, wall = time.process_time(), time.perf_counter()
result = call(solid)
cpu, wall = time.process_time() - cpu, time.perf_counter() - wall
status = open("/proc/self/status").read()  # ru_maxrss would start with that of the parent
report = result.report.to_dict()
print(json.dumps({
    "triangles": len(solid.triangles), "pieces": len(result), "cpu": cpu, "wall": wall,
    "peak": 1024 * int(status.split("VmHWM:")[1].split()[0]), "counts": report["counts"],
    "seconds": report["seconds"], "volume_error": report["volume_error"],
}))
"""


def runs() -> list[dict[str, Any]]:
    """Return what there is to run, the light ones first in each family."""
    found: list[dict[str, Any]] = []
    still = (0, 0, 0)
    for family, maker, sizes, more, turn in (
        ("torus", "torus", TORI, [BUMPS, 2**18], still),
        ("torus-off-grid", "torus", TORI, [BUMPS, 2**20], still),
        ("ball", "sphere", BALLS, [2**19], still),
        ("ball-off-grid", "sphere", BALLS, [2**20], still),
        ("ball-turned", "sphere", BALLS, [2**19], (13, 29, 41)),
        ("chazelle", "chazelle", {n: (n,) for n in NOTCHES}, [], still),
    ):
        for kind in ("tets", "cells"):
            for size, given in sizes.items():
                if kind == "tets" or size <= CELLS_UP_TO:
                    run = {"family": family, "size": size, "kind": kind}
                    found.append(
                        {**run, "maker": maker, "arguments": [*given, *more], "turn": turn}
                    )
    return found


def name_of(run: dict[str, Any]) -> str:
    """Return the name by which --only chooses a run."""
    return f"{run['family']}-{run['size']}-{run['kind']}"


def measure(run: dict[str, Any], limit: float, memory: float) -> dict[str, Any]:
    """Return a run with its figures."""
    job = [run["maker"], run["arguments"], run["turn"], run["kind"], int(memory * 2**30)]
    whole, output = timed([sys.executable, "-c", WORKER, json.dumps(job)], limit)
    figures = json.loads(output) if whole["status"] == "ok" else {}
    row = {k: run[k] for k in ("family", "size", "kind")} | {"status": whole["status"]} | figures
    wall, peak = TARGETS.get((run["family"], run["size"]), (None, None))
    if wall and run["kind"] == "tets":
        kept = row["status"] == "ok" and row["wall"] <= wall and row["peak"] <= (peak or math.inf)
        row["target"] = {"wall": wall, "peak": peak, "kept": kept}
    return row


def steiner(row: dict[str, Any]) -> int:
    """Return the Steiner points of a row."""
    counts = row["counts"]
    return sum(counts.get(f"steiner_{where}", 0) for where in ("edge", "facet", "inner"))


def line_of(row: dict[str, Any]) -> str:
    """Return one line of the table."""
    start = f"{row['family']:14s} {row['size']:7d} {row['kind']:5s}"
    if row["status"] != "ok":
        return f"{start} {row['status']}"
    share = row["pieces"] / (row["size"] ** 2 if row["family"] == "chazelle" else row["triangles"])
    kept = {True: "kept", False: "MISSED", None: ""}[row.get("target", {}).get("kept")]
    return (
        f"{start} {row['triangles']:9d} {row['pieces']:8d} {share:8.3f} {steiner(row):7d}"
        f" {row['cpu']:8.3f} {row['wall']:8.3f} {row['peak'] / 2**20:8.0f} {kept}"
    )


def draw(rows: list[dict[str, Any]], picture: Path) -> None:
    """Plot seconds, memory and pieces over the triangles of the input, all logarithmic."""
    import matplotlib

    matplotlib.use("Agg")
    from matplotlib import pyplot

    figure, axes = pyplot.subplots(1, 3, figsize=(15, 5), layout="constrained")
    done = [row for row in rows if row["status"] == "ok"]
    families = list(dict.fromkeys(row["family"] for row in done))
    lines = dict.fromkeys((row["family"], row["kind"]) for row in done)
    columns = (("cpu", 1, "processor seconds"), ("peak", 2**20, "peak memory, MiB"),
               ("pieces", 1, "pieces"))  # fmt: skip
    for axis, (key, unit, label) in zip(axes, columns):
        for family, kind in lines:
            chosen = [r for r in done if (r["family"], r["kind"]) == (family, kind)]
            axis.loglog(
                [r["triangles"] for r in chosen],
                [r[key] / unit for r in chosen],
                "o-" if kind == "tets" else "s--",
                color=f"C{families.index(family)}",
                label=f"{family}, {kind}",
            )
        axis.set_xlabel("triangles of the input")
        axis.set_title(label)
        axis.grid(True, which="major", alpha=0.4)
    axes[0].legend()
    figure.savefig(picture, dpi=100)


def parse(arguments: list[str]) -> argparse.Namespace:
    """Return the options of the command line."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("-o", "--output", type=Path, help="JSON file to write")
    parser.add_argument("--plot", type=Path, help="PNG file to write")
    parser.add_argument("--limit", type=float, default=300.0, help="processor seconds of a run")
    parser.add_argument("--memory", type=float, default=10.0, help="GiB of a run")
    parser.add_argument("--only", default="", help="runs whose name this expression matches")
    parser.add_argument("--merge", action="store_true", help="keep the other rows of the output")
    return parser.parse_args(arguments)


def stored(output: Path | None) -> dict[str, dict[str, Any]]:
    """Return the rows of an earlier run by name."""
    if output is None or not output.exists():
        return {}
    rows = json.loads(output.read_text(encoding="utf-8"))["runs"]
    return {name_of(row): row for row in rows}


def main(arguments: list[str]) -> int:
    """Measure, print a table, write JSON and plot; 1 when a run fails or misses its target."""
    options = parse(arguments)
    kept = stored(options.output) if options.merge else {}
    rows: list[dict[str, Any]] = []
    print(
        f"{'family':14s} {'size':>7s} {'kind':5s} {'triangles':>9s} {'pieces':>8s} {'per':>8s}"
        f" {'Steiner':>7s} {'cpu s':>8s} {'wall s':>8s} {'MiB':>8s}"
    )
    for run in runs():
        if re.search(options.only, name_of(run)):
            rows.append(measure(run, options.limit, options.memory))
            print(line_of(rows[-1]), flush=True)
        elif name_of(run) in kept:
            rows.append(kept[name_of(run)])
    if options.output:
        machine = {"processor": platform.machine(), "cores": os.cpu_count()}
        options.output.parent.mkdir(parents=True, exist_ok=True)
        result = {"machine": machine, "limit": options.limit, "runs": rows}
        options.output.write_text(json.dumps(result, indent=1) + "\n", encoding="utf-8")
    if options.plot:
        draw(rows, options.plot)
    bad = [r for r in rows if r["status"] != "ok" or not r.get("target", {}).get("kept", True)]
    return 1 if bad else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
