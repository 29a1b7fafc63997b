#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Seconds from tetrahedra to a FreeCAD compound, ours beside Part.makeSolid one by one.

Grids of 750 to 20,250 tetrahedra become a shape in FreeCAD's own process: ours as BREP text with
shared vertices, edges and faces; FreeCAD's as four Part.Face, a Part.Shell and a Part.Solid for
each, in a Part.Compound, up to `PEER_LIMIT` tetrahedra. All times are processor seconds of one
call. The script starts itself again inside FreeCAD.

Usage: ``compound_vs_part.py [-o RESULT.json]`` (FREECADCMD names another FreeCAD)
"""

from __future__ import annotations

import argparse
import json
import os
import platform
import subprocess
import sys
from pathlib import Path
from time import perf_counter, process_time
from typing import Any

import numpy as np

ROOT = Path(__file__).resolve().parents[1]
sys.path.insert(0, str(ROOT))
from freecad_tetra.model import TetMesh  # noqa: E402 (after the path)

GRIDS = (5, 9, 15)  # cubes along an edge, of 6 tetrahedra each: 750, 4,374 and 20,250
EXACT = 5000  # the count that issue 4 names, the first tetrahedra of the grid of 10 cubes
PEER_LIMIT = 5000
TARGETS = {5000: 1.0, 20250: 5.0}  # issue 4, seconds
KUHN = [(0, 1, 3, 7), (0, 5, 1, 7), (0, 3, 2, 7), (0, 2, 6, 7), (0, 4, 5, 7), (0, 6, 4, 7)]
INSIDE = "TETRA_BENCHMARK_INSIDE"  # the file that the run inside FreeCAD writes


def grid(cubes: int, count: int | None = None) -> TetMesh:
    """Return the first `count` tetrahedra of a cube of 10 mm in `cubes`^3 parts."""
    side = cubes + 1
    axis = np.arange(side) * (10.0 / cubes)
    points = np.stack(np.meshgrid(axis, axis, axis, indexing="ij"), -1).reshape(-1, 3)
    first = np.arange(side**3).reshape(side, side, side)[:-1, :-1, :-1].ravel()
    corner = [first + (c & 1) * side * side + (c >> 1 & 1) * side + (c >> 2) for c in range(8)]
    tets = np.stack([np.stack([corner[c] for c in tet], 1) for tet in KUHN], 1).reshape(-1, 4)
    p = points[tets]
    turned = np.linalg.det(p[:, 1:] - p[:, :1]) < 0
    tets[turned] = tets[turned][:, [0, 1, 3, 2]]
    tets = tets[:count]
    return TetMesh(
        points, tets, np.zeros((0, 3)), [], [], np.zeros(len(tets)), np.full(len(points), -1)
    )


def one_by_one(mesh: TetMesh) -> Any:
    """Return the compound that FreeCAD's Python makes of single solids."""
    import Part
    from FreeCAD import Vector

    points = [Vector(*p) for p in mesh.points.tolist()]
    solids = []
    for tet in mesh.tets.tolist():
        faces = []
        for side in ((1, 2, 3), (0, 3, 2), (0, 1, 3), (0, 2, 1)):
            ring = [points[tet[i]] for i in (*side, side[0])]
            faces.append(Part.Face(Part.makePolygon(ring)))
        solids.append(Part.makeSolid(Part.makeShell(faces)))
    return Part.makeCompound(solids)


def timed(make: Any, mesh: TetMesh) -> dict[str, Any]:
    """Return seconds and what came out."""
    cpu, wall = process_time(), perf_counter()
    shape = make(mesh)
    spent = {"cpu": process_time() - cpu, "wall": perf_counter() - wall}
    volume = shape.Volume
    return {**spent, "solids": len(shape.Solids), "faces": len(shape.Faces), "volume": volume,
            "type": shape.ShapeType}  # fmt: skip


def inside(path: str) -> None:
    """Run all cases in FreeCAD and write them to a file."""
    import FreeCAD

    from freecad_tetra.workbench import write_back

    rows = []
    for cubes, count in [*((n, None) for n in GRIDS), (10, EXACT)]:
        mesh = grid(cubes, count)
        row = {"tets": len(mesh), "ours": timed(write_back.shape_of_pieces, mesh)}
        if len(mesh) <= PEER_LIMIT:
            row["part"] = timed(one_by_one, mesh)
            row["ratio"] = row["part"]["cpu"] / row["ours"]["cpu"]
        rows.append(row)
    rows.sort(key=lambda row: row["tets"])
    found = {"freecad": ".".join(FreeCAD.Version()[:3]), "rows": rows}
    Path(path).write_text(json.dumps(found))


def main() -> int:
    """Run FreeCAD, print the table, write the JSON; 1 when a target is missed."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("-o", "--output", type=Path)
    arguments = parser.parse_args()
    file = ROOT / "build" / "compound_vs_part.json"
    file.unlink(missing_ok=True)
    program = os.environ.get("FREECADCMD", "freecadcmd")
    done = subprocess.run(
        [program, str(Path(__file__).resolve())], stdin=subprocess.DEVNULL, capture_output=True,
        text=True, env={**os.environ, INSIDE: str(file)},
    )  # fmt: skip
    if not file.is_file():
        print(done.stdout, done.stderr, sep="\n", file=sys.stderr)
        return 1
    found = json.loads(file.read_text())
    missed = []
    for row in found["rows"]:
        ours, part = row["ours"], row.get("part")
        peer = f"{part['cpu']:7.2f} s, {row['ratio']:5.1f} times ours" if part else ""
        print(f"{row['tets']:6} tetrahedra: {ours['cpu']:5.2f} s   Part.makeSolid {peer}")
        if ours["cpu"] > TARGETS.get(row["tets"], np.inf):
            missed.append(f"{row['tets']} tetrahedra in {TARGETS[row['tets']]} s")
    machine = {"processor": platform.machine(), "cores": os.cpu_count()}
    if arguments.output:
        out = {"machine": machine, **found, "missed": missed}
        arguments.output.write_text(json.dumps(out, indent=1) + "\n")
    return 1 if missed else 0


if os.environ.get(INSIDE):
    inside(os.environ[INSIDE])
elif __name__ == "__main__":
    sys.exit(main())
