#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Error and seconds of our hulls beside CoACD's at the same number of parts.

Both get the same triangles and the same limits, each in a process of its own. Ours are exact cells
merged to `max_cells` of at most `max_vertices`; CoACD's threshold is lowered until it
gives as many parts as we have, and its hulls are decimated to the same number of vertices. They are
kept in build/coacd for the next run.
Seconds are processor seconds of all threads for the call on arrays in memory, CoACD's for the run
with that threshold alone. Both are measured by the same samples (tests/tools/hull_measure.py):
``error`` is the largest distance between the surfaces of the hulls' union and of the part, either
way, as a share of the diagonal.

Usage: ``hulls_vs_coacd.py [FILE|FOLDER]... [-o RESULT.json] [--limit S] [--only REGEX]``
"""

from __future__ import annotations

import argparse
import json
import os
import platform
import re
import sys
import tempfile
from pathlib import Path
from typing import Any

import numpy as np
from cells_vs_cgal import ROOT, timed
from peer import python_with

sys.path.insert(0, str(ROOT / "tests/tools"))
from hull_measure import measure

CORPUS = ROOT.parent / "shared/corpus/brep"
COACD = "coacd==1.0.14"
THRESHOLDS = (0.05, 0.02, 0.01)  # CoACD takes no lower one
# Ten parts that have more than 64 exact cells, from brackets to a fan shroud.
PARTS = (
    "page67_bynormandc|Page_036|Page_043|Page_046|Page_053|Page_068|Page_087|Page_094|"
    "prusa_fan-shroud|prusa_y-belt-holder"
)

OURS = """
import sys, time, json, numpy as np
from freecad_tetra import convex_cells
arrays = np.load(sys.argv[1])
start = time.process_time()
cells = convex_cells((arrays["vertices"], arrays["triangles"]),
                     max_cells=int(sys.argv[3]), max_vertices=int(sys.argv[4]))
seconds = time.process_time() - start
np.savez(sys.argv[2], *[cell.points for cell in cells])
limits = cells.report.details["limits"]
print(json.dumps({"seconds": seconds, "stated": limits["hull_error"],
                  "exact_cells": limits["cells_before"]}))
"""

THEIRS = """
import sys, time, json, numpy as np, coacd
coacd.set_log_level("error")
arrays = np.load(sys.argv[1])
mesh = coacd.Mesh(arrays["vertices"], arrays["triangles"])
start = time.process_time()
parts = coacd.run_coacd(mesh, threshold=float(sys.argv[5]), max_convex_hull=int(sys.argv[3]),
                        decimate=True, max_ch_vertex=int(sys.argv[4]))
seconds = time.process_time() - start
np.savez(sys.argv[2], *[points for points, _ in parts])
print(json.dumps({"seconds": seconds, "threshold": float(sys.argv[5])}))
"""


def hulls_of(command: list[str], result: Path, limit: float) -> tuple[dict[str, Any], list[Any]]:
    """Return what a run printed, and the points of its hulls."""
    status, output = timed(command, limit)
    if status["status"] != "ok":
        return status, []
    with np.load(result) as arrays:
        hulls = [arrays[name] for name in arrays.files]
    told: dict[str, Any] = json.loads(output.splitlines()[-1])
    vertices = max(len(np.unique(hull, axis=0)) for hull in hulls)
    return {"status": "ok", **told, "parts": len(hulls), "vertices": vertices}, hulls


def hulls_of_coacd(
    arrays: Path, name: str, parts: int, options: argparse.Namespace
) -> tuple[dict[str, Any], list[Any]]:
    """Return CoACD's hulls, of the first threshold that gives enough; kept from a run before."""
    kept = options.kept / f"{name}-{parts}-{options.vertices}.json"
    result = kept.with_suffix(".npz")
    if kept.exists():
        with np.load(result) as stored:
            return json.loads(kept.read_text()), [stored[key] for key in stored.files]
    found: dict[str, Any] = {"status": "not run"}
    hulls: list[Any] = []
    for threshold in THRESHOLDS:
        command = [str(python_with(COACD, options.venv)), "-c", THEIRS, str(arrays), str(result)]
        command += [str(parts), str(options.vertices), str(threshold)]
        found, hulls = hulls_of(command, result, options.limit)
        if found["status"] != "ok" or found["parts"] >= parts:
            break
    if hulls:
        kept.write_text(json.dumps(found))
    return found, hulls


def compare(file: Path, options: argparse.Namespace) -> dict[str, Any]:
    """Return the figures of both for one part."""
    from freecad_tetra import validate

    surface = validate(file).surface()
    part = (surface.vertices, surface.triangles)
    row: dict[str, Any] = {"name": file.stem, "triangles": len(surface.triangles)}
    with tempfile.TemporaryDirectory() as folder:
        arrays, result = Path(folder) / "part.npz", Path(folder) / "hulls.npz"
        np.savez(arrays, vertices=part[0], triangles=part[1])
        limits = [str(arrays), str(result), str(options.cells), str(options.vertices)]
        found, hulls = hulls_of([sys.executable, "-c", OURS, *limits], result, options.limit)
        row["ours"] = found | _judged(part, hulls, surface.diagonal())
        parts = row["ours"]["parts"]
        found, hulls = hulls_of_coacd(arrays, file.stem, parts, options)
        row["coacd"] = found | _judged(part, hulls, surface.diagonal())
    return row


def _judged(part: Any, hulls: list[Any], diagonal: float) -> dict[str, float]:
    if not hulls:
        return {}
    found = measure(part, hulls, 40000, seed=1)
    lengths = {key: found[key] / diagonal for key in ("outward", "inward", "error")}
    volume = abs(np.linalg.det(part[0][part[1]]).sum() / 6)
    return lengths | {key: found[key] / volume for key in ("volume_added", "volume_missed")}


def line_of(row: dict[str, Any]) -> str:
    """Return one line of the table."""
    parts = [f"{row['name']:32.32s} {row['triangles']:6d}"]
    for way in ("ours", "coacd"):
        r = row[way]
        if r["status"] != "ok":
            parts.append(r["status"])
            continue
        parts.append(
            f"{r['parts']:3d} {r['vertices']:3d} {r['seconds']:7.2f} {r['outward']:.4f} "
            f"{r['inward']:.4f} {r['volume_added']:.4f} {r['volume_missed']:.4f}"
        )
    return " | ".join(parts)


def totals(rows: list[dict[str, Any]]) -> dict[str, Any]:
    """Return how often we are better, and the ratios over all parts."""
    both = [r for r in rows if r["ours"]["status"] == r["coacd"]["status"] == "ok"]
    result: dict[str, Any] = {"parts": len(rows), "compared": len(both)}
    for key in ("error", "seconds", "volume_added"):
        better = [r["name"] for r in both if r["ours"][key] < r["coacd"][key]]
        result[f"{key}_smaller_on"] = len(better)
        result[f"{key}_not_smaller"] = [r["name"] for r in both if r["name"] not in better]
        ratio = [r["ours"][key] / max(r["coacd"][key], 1e-12) for r in both]
        result[f"{key}_ratio_mean"] = float(np.exp(np.mean(np.log(np.maximum(ratio, 1e-12)))))
    return result


def main(arguments: list[str]) -> int:
    """Measure, print a table, write the JSON; 1 when CoACD is better anywhere."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("inputs", type=Path, nargs="*", help="parts, or folders of them")
    parser.add_argument("--venv", type=Path, default=ROOT / "build/benchmark-venv", help="CoACD's")
    parser.add_argument("-o", "--output", type=Path, help="JSON file to write")
    parser.add_argument(
        "--kept", type=Path, default=ROOT / "build/coacd", help="where CoACD's hulls are kept"
    )
    parser.add_argument("--limit", type=float, default=900.0, help="processor seconds of a run")
    parser.add_argument("--only", default=PARTS, help="files whose name this expression matches")
    parser.add_argument("--cells", type=int, default=64)
    parser.add_argument("--vertices", type=int, default=60)
    options = parser.parse_args(arguments)
    options.kept.mkdir(parents=True, exist_ok=True)
    files = [
        file
        for given in options.inputs or [CORPUS]
        for file in (sorted(given.iterdir()) if given.is_dir() else [given])
        if re.search(options.only, file.name)
    ]
    columns = "  n vtx     cpu s outward inward  added missed"
    print(f"{'part, triangles':39s} | {columns} (ours) | {columns} (CoACD)")
    rows = []
    for file in files:
        rows.append(compare(file, options))
        print(line_of(rows[-1]), flush=True)
    summary = totals(rows)
    print(json.dumps(summary, indent=1))
    if options.output:
        machine = {"processor": platform.machine(), "cores": os.cpu_count()}
        result = {"machine": machine, "coacd": COACD, "totals": summary, "parts": rows}
        options.output.parent.mkdir(parents=True, exist_ok=True)
        options.output.write_text(json.dumps(result, indent=1) + "\n", encoding="utf-8")
    better = not summary["error_not_smaller"] and not summary["seconds_not_smaller"]
    return 0 if better else 1


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
