# SPDX-License-Identifier: LGPL-2.1-or-later
"""cadquery: pieces come back as solids that share their faces."""

from __future__ import annotations

from typing import Any

from freecad_tetra.adapters import require
from freecad_tetra.export import pieces
from freecad_tetra.model import ConvexCells, TetMesh


def compound(result: ConvexCells | TetMesh) -> Any:
    """Return a ``cadquery.Compound`` of one labelled solid per piece, in their order."""
    cadquery = require("cadquery", "handing solids to cadquery")
    made = cadquery.Shape.cast(pieces.occ_compound(result))
    made.label = "pieces"
    return made


def solids(result: ConvexCells | TetMesh) -> list[Any]:
    """Return one ``cadquery.Solid`` per piece; ``label`` is that of its solid and its number."""
    found: list[Any] = list(compound(result))
    for solid, name in zip(found, pieces.names(result)):
        solid.label = name
    return found
