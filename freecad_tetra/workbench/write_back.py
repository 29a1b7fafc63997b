# SPDX-License-Identifier: LGPL-2.1-or-later
"""Pieces become one Part.Shape whose neighbours share their vertices, edges and faces."""

from __future__ import annotations

from typing import Any

from freecad_tetra.errors import TetraError
from freecad_tetra.model import ConvexCells, TetMesh
from freecad_tetra.workbench.piece_text import PieceText, piece_text

_TRIES = 4


def shape_of_pieces(
    pieces: ConvexCells | TetMesh, explode: float = 0.0, made: PieceText | None = None
) -> Any:
    """Return a Part.Shape with one solid for each piece, in their order; O(n log n).

    Pieces thinner than OpenCascade can tell are left out. Where points are not exact, some may
    be too thin once they are divided: those share less.

    Parameters
    ----------
    pieces : ConvexCells or TetMesh
    explode : float
        Every piece moves by this share of the way from the centre of all to its own centre.
    made : PieceText, optional
        The text of these pieces at `explode` 0, when it is there already.

    Returns
    -------
    Part.Shape
        Pieces that hang together face to face are a CompSolid, when `explode` is 0. The whole
        is that CompSolid, or a Compound of CompSolids and solids.

    Raises
    ------
    TetraError
        OpenCascade does not read the pieces.
    """
    if isinstance(pieces, TetMesh) or explode:
        return _shape(made if made and not explode else piece_text(pieces, explode))
    alone: list[int] = []
    for _ in range(_TRIES):
        text = made if made and not alone else piece_text(pieces, 0.0, alone)
        shape = _shape(text)
        solids = [] if text.exact else shape.Solids
        faulty = [k for k, solid in enumerate(solids) if not solid.isValid()]
        if not faulty:
            return shape
        alone += text.kept[faulty].tolist()
    return _shape(piece_text(pieces, 0.0, None))


def _shape(text: PieceText) -> Any:
    import Part

    shape = Part.Shape()
    shape.importBrepFromString(text.text, False)
    if shape.isNull() or len(shape.Solids) != len(text.kept):
        raise TetraError("OpenCascade cannot read the pieces", "please report the part")
    return shape
