# SPDX-License-Identifier: LGPL-2.1-or-later
"""build123d: pieces come back as labelled solids that share their faces."""

from __future__ import annotations

from typing import Any

from freecad_tetra.adapters import require
from freecad_tetra.export import pieces
from freecad_tetra.model import ConvexCells, TetMesh


def compound(result: ConvexCells | TetMesh) -> Any:
    """Return a ``build123d.Compound`` whose children are the pieces, in their order."""
    build123d = require("build123d", "handing solids to build123d")
    whole = build123d.Compound(pieces.occ_compound(result))
    children = list(whole.solids())
    for solid, name in zip(children, pieces.names(result)):
        solid.label = name
    return build123d.Compound(label="pieces", children=children)
