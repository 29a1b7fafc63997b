# SPDX-License-Identifier: LGPL-2.1-or-later
"""Three uniform refinements of a curved part: error of a displacement, and its order.

A quarter of a thick tube under inner pressure, in plane strain, has no singular point: the growth
of its outer radius is compared with the finest mesh's and with Lame's. Middles and new points
lie on the cylinders, so the order is that of the elements: 2 for four nodes, 4 for ten.

Usage: ``fem_convergence.py [-o FILE.json] [--plot FILE.png] [--times N]``; wants ccx and mmg3d.
Exit code 1 when an order between the finest meshes is lower than that by more than a half.
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
from freecad_tetra.fem.refine import refine
from freecad_tetra.fem.second_order import second_order

PRESSURE, INNER, OUTER = 10.0, 10.0, 20.0
MODULUS, POISSON = cx.STEEL
EXPECTED, SLACK = {"tet4": 2.0, "tet10": 4.0}, 0.5  # of the order between the two finest meshes


def lame() -> float:
    """Return the growth of the outer radius in plane strain."""
    share = PRESSURE * INNER**2 / (OUTER**2 - INNER**2)
    return (1 + POISSON) / MODULUS * share * OUTER * (2 - 2 * POISSON)


def growth(mesh: cx.Mesh, folder: Path) -> float:
    """Return the mean growth of the outer radius."""
    radius = np.hypot(mesh.points[:, 0], mesh.points[:, 1])
    bore = cx.face_at(mesh, lambda p: np.hypot(p[:, 0], p[:, 1]) < INNER + 1e-6)
    flat = [(0, 0.0), (1, 0.0), (2, 0.0), (2, 10.0)]
    cuts = [cx.face_at(mesh, lambda p, a=a, x=x: np.abs(p[:, a] - x) < 1e-7) for a, x in flat]
    fixed = {cut.name: (axis,) for cut, axis in zip(cuts, (1, 2, 3, 3))}
    loads = ["*DSLOAD", f"{bore.name}_surface,P,{PRESSURE}"]
    found = cx.solve(folder, mesh, fixed, loads, limit=3000)
    on = np.abs(radius - OUTER) < 1e-7
    moved = found.displacement[on]
    out = (moved[:, :2] * mesh.points[on, :2]).sum(axis=1) / OUTER
    return float(out.mean())


def study(order: int, times: int) -> list[dict[str, float]]:
    """Return elements, relative edge length and growth of each mesh, coarsest first."""
    shape = parts.quarter_tube()
    project = brep.projector(shape)
    mesh = fem_mesh(shape, order=1, quality=True, size=15.0, chord=1.5)
    rows = []
    for step in range(times + 1):
        made = second_order(mesh, project)[0] if order == 2 else mesh
        with tempfile.TemporaryDirectory() as folder:
            rows.append({"elements": len(made), "h": 0.5**step,
                         "growth": growth(made, Path(folder))})  # fmt: skip
        print(f"order {order}: {len(made)} elements, {rows[-1]['growth']:.10g}", flush=True)
        if step < times:
            mesh = refine(mesh, project)
    for row in rows:
        row["error"] = abs(row["growth"] / lame() - 1)
        row["error_to_finest"] = abs(row["growth"] / rows[-1]["growth"] - 1)
    return rows


def orders(rows: list[dict[str, float]]) -> list[float]:
    """Return the order between neighbouring meshes, by the error against Lame."""
    return [float(np.log2(a["error"] / b["error"])) for a, b in pairwise(rows)]


def plot(found: dict[str, list[dict[str, float]]], path: str) -> None:
    """Draw error over edge length, both logarithmic."""
    import matplotlib

    matplotlib.use("Agg")
    from matplotlib import pyplot

    figure, axes = pyplot.subplots(figsize=(5.5, 4))
    for name, rows in found.items():
        axes.loglog([r["h"] for r in rows], [r["error"] for r in rows], "o-", label=f"{name}, Lame")
        rest = rows[:-1]
        axes.loglog(
            [r["h"] for r in rest], [r["error_to_finest"] for r in rest], "x--",
            label=f"{name}, finest",
        )  # fmt: skip
    axes.set_xlabel("edge length, relative")
    axes.set_ylabel("error of the outer radius' growth")
    axes.grid(True, which="both", alpha=0.3)
    axes.legend()
    figure.tight_layout()
    figure.savefig(path, dpi=110)


def main() -> int:
    """Run the study for both orders; return 1 when one is missed."""
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("-o", "--output")
    parser.add_argument("--plot")
    parser.add_argument("--times", type=int, default=3, help="refinements")
    given = parser.parse_args()
    found = {f"tet{n}": study(order, given.times) for n, order in ((4, 1), (10, 2))}
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
