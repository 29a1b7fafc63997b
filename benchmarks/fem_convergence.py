# SPDX-License-Identifier: LGPL-2.1-or-later
"""Three uniform refinements of a curved cantilever: error of its tip displacement, and its order.

A hook, half of a ring, is held in its plane of symmetry at one end and pulled evenly at the other,
so no point is singular. Middles and new points lie on the cylinders, and the mean displacement of
the tip is as exact as the energy: order 2 is expected of four nodes, 4 of ten. Errors are against
the finest mesh of ten nodes, which is so much better that it biases no order by more than 0.1.

Usage: ``fem_convergence.py [-o FILE.json] [--plot FILE.png] [--times N]``; wants ccx and mmg3d.
Exit code 1 when the order between the finest meshes is lower than that by more than a half.
"""

from __future__ import annotations

import argparse
import json
import sys
import tempfile
from itertools import pairwise
from pathlib import Path
from typing import Any

import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "tests" / "fem"))

import calculix as cx
import parts

from freecad_tetra import brep, fem_mesh
from freecad_tetra.fem import triangles
from freecad_tetra.fem.refine import refine
from freecad_tetra.fem.second_order import second_order

PULL = 10.0  # MPa
EXPECTED, SLACK = {"tet4": 2.0, "tet10": 4.0}, 0.5


def end(mesh: cx.Mesh, side: int) -> Any:
    """Return the flat end at positive or negative x."""
    return cx.face_at(mesh, lambda p: (np.abs(p[:, 1]) < 1e-7) & (side * p[:, 0] > 0))


def tip_displacement(mesh: cx.Mesh, folder: Path) -> float:
    """Return the tip's displacement along the pull, a mean by area."""
    root, tip = end(mesh, 1), end(mesh, -1)
    middle = cx.face_at(mesh, lambda p: np.abs(p[:, 2]) < 1e-7)
    # Nothing pulls along x, so one node holds the hook there without a force.
    loads = ["*BOUNDARY", f"{root.nodes[0] + 1},1", "*DSLOAD", f"{tip.name}_surface,P,{-PULL}"]
    found = cx.solve(folder, mesh, {root.name: (2,), middle.name: (3,)}, loads, limit=3000)
    rows = mesh.skin[tip.elements]
    share = triangles.shares(mesh.points, rows)
    return float(-(share * found.displacement[rows, 1]).sum() / share.sum())


def study(order: int, times: int) -> list[dict[str, float]]:
    """Return elements, relative edge length and tip displacement of each mesh, coarsest first."""
    shape = parts.half_ring()
    project = brep.projector(shape)
    mesh = fem_mesh(shape, order=1, quality=True, size=10.0, chord=1.0)
    rows = []
    for step in range(times + 1):
        made = second_order(mesh, project)[0] if order == 2 else mesh
        with tempfile.TemporaryDirectory() as folder:
            tip = tip_displacement(made, Path(folder))
        rows.append({"elements": len(made), "h": 0.5**step, "tip": tip})
        print(f"order {order}: {len(made)} elements, tip {tip:.10g} mm", flush=True)
        if step < times:
            mesh = refine(mesh, project)
    return rows


def compare(found: dict[str, list[dict[str, float]]]) -> None:
    """Add the errors against the finest mesh of ten nodes, which has none itself."""
    finest = found["tet10"][-1]["tip"]
    for row in [row for rows in found.values() for row in rows]:
        if row["tip"] != finest:
            row["error"] = abs(row["tip"] / finest - 1)


def orders(rows: list[dict[str, float]]) -> list[float]:
    """Return the order between neighbouring meshes that have errors."""
    errors = [row["error"] for row in rows if "error" in row]
    return [float(np.log2(a / b)) for a, b in pairwise(errors)]


def plot(found: dict[str, list[dict[str, float]]], path: str) -> None:
    """Draw error over edge length, both logarithmic, and the slopes that are expected."""
    import matplotlib

    matplotlib.use("Agg")
    from matplotlib import pyplot

    figure, axes = pyplot.subplots(figsize=(5.5, 4))
    for name, rows in found.items():
        known = [row for row in rows if "error" in row]
        h, error = (np.array([row[key] for row in known]) for key in ("h", "error"))
        (line,) = axes.loglog(h, error, "o-", label=name)
        slope = error[-1] * (h / h[-1]) ** EXPECTED[name]
        axes.loglog(h, slope, ":", color=line.get_color(), label=f"order {EXPECTED[name]:g}")
    lengths = [row["h"] for row in found["tet4"]]
    axes.set_xticks(lengths, [f"1/{1 / h:g}" for h in lengths])
    axes.minorticks_off()
    axes.set_xlabel("edge length, relative")
    axes.set_ylabel("error of the tip displacement")
    axes.grid(True, which="both", alpha=0.3)
    axes.legend()
    figure.tight_layout()
    figure.savefig(path, dpi=110)


def main() -> int:
    """Run the study for both orders; return 1 when one is missed."""
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("-o", "--output")
    parser.add_argument("--plot")
    parser.add_argument("--times", type=int, default=3, help="refinements, two at least")
    given = parser.parse_args()
    found = {f"tet{n}": study(order, given.times) for n, order in ((4, 1), (10, 2))}
    compare(found)
    missed = [name for name, rows in found.items() if orders(rows)[-1] < EXPECTED[name] - SLACK]
    for name, rows in found.items():
        print(name, "orders", [round(x, 2) for x in orders(rows)])
    if given.output:
        told: dict[str, Any] = {"missed": missed}
        told |= {name: {"rows": rows, "orders": orders(rows)} for name, rows in found.items()}
        Path(given.output).write_text(json.dumps(told, indent=1) + "\n")
    if given.plot:
        plot(found, given.plot)
    return 1 if missed else 0


if __name__ == "__main__":
    sys.exit(main())
