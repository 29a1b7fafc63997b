# SPDX-License-Identifier: LGPL-2.1-or-later
"""Functions for ``Workplane.invoke``; importing this adds them as methods to cadquery's classes.

import freecad_tetra.cq
mesh = part.tetrahedralize()       # a TetMesh
cells = part.convexCells()         # a Workplane with one solid per cell
part.invoke(freecad_tetra.cq.convex_cells)
"""

from __future__ import annotations

from typing import Any

from freecad_tetra import adapters, api
from freecad_tetra.adapters import cadquery as solids
from freecad_tetra.model import TetMesh

__all__ = ["convex_cells", "tetrahedralize"]

cadquery: Any = adapters.require("cadquery", "freecad_tetra.cq")


def tetrahedralize(part: Any, **options: Any) -> TetMesh:
    """Return the tetrahedra of a Workplane or Assembly; see `freecad_tetra.tetrahedralize`."""
    return api.tetrahedralize(part, **options)


def convex_cells(part: Any, **options: Any) -> Any:
    """Return a Workplane with the convex cells as solids; see `freecad_tetra.convex_cells`.

    The solids share their common faces; their ``label`` tells the part and the number.
    """
    found = solids.solids(api.convex_cells(part, **options))
    if isinstance(part, cadquery.Workplane):
        return part.newObject(found)
    return cadquery.Workplane().newObject(found)


for _class in (cadquery.Workplane, cadquery.Assembly):
    _class.tetrahedralize = tetrahedralize
    _class.convexCells = convex_cells
