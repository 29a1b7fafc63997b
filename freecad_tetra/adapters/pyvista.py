# SPDX-License-Identifier: LGPL-2.1-or-later
"""pyvista: grids of tetrahedra or convex polyhedra, and a window that shows them apart."""

from __future__ import annotations

from typing import Any

import numpy as np

from freecad_tetra.adapters import require
from freecad_tetra.model import ConvexCells, FloatArray, TetMesh

_TETRA, _POLYHEDRON = 10, 42


def grid(result: ConvexCells | TetMesh) -> Any:
    """Return a ``pyvista.UnstructuredGrid`` with the cell data ``solid`` and ``piece``."""
    pyvista = require("pyvista", "handing a grid to pyvista")
    return _grid(pyvista, result, result.points)


def _grid(pyvista: Any, result: ConvexCells | TetMesh, points: FloatArray) -> Any:
    if isinstance(result, TetMesh):
        rows = np.column_stack([np.full(len(result), 4), result.tets]).reshape(-1)
        kinds, solid = np.full(len(result), _TETRA, np.uint8), result.tet_solid
    else:
        rows = _polyhedra(result)
        kinds, solid = np.full(len(result), _POLYHEDRON, np.uint8), result.cell_solid
    made = pyvista.UnstructuredGrid(rows, kinds, np.array(points))
    made.cell_data["solid"] = solid
    made.cell_data["piece"] = np.arange(len(result))
    made.field_data["solid_names"] = [
        result.labels.solid(i) for i in range(int(solid.max(initial=-1)) + 1)
    ]
    return made


def _polyhedra(result: ConvexCells) -> Any:
    """Return the face streams that VTK takes for polyhedra, each led by its length."""
    stream: list[int] = []
    for k in range(len(result)):
        loops = [result.facet(f).tolist() for f in result.cell_facets(k)]
        stream += [1 + sum(len(loop) + 1 for loop in loops), len(loops)]
        for loop in loops:
            stream += [len(loop), *loop]
    return np.array(stream, np.int64)


def plot(result: ConvexCells | TetMesh, explode: float, options: dict[str, Any]) -> Any:
    """Show the pieces apart in a window; returns what ``pyvista.Plotter.show`` returns."""
    pyvista = require("pyvista", "plotting")
    shown = dict(options)
    plotter = pyvista.Plotter(off_screen=shown.pop("off_screen", None))
    whole = grid(result)
    pieces = whole.explode(explode) if explode else whole
    order = np.random.default_rng(0).permutation(max(1, len(result)))
    pieces.cell_data["colour"] = order[pieces.cell_data["piece"]]
    plotter.add_mesh(pieces, scalars="colour", cmap="turbo", show_edges=True, show_scalar_bar=False)
    return plotter.show(**shown)
