# SPDX-License-Identifier: LGPL-2.1-or-later
"""Pieces become one Part.Shape whose neighbours share their vertices, edges and faces."""

from __future__ import annotations

from typing import Any

from freecad_tetra.model import ConvexCells, TetMesh


def shape_of_pieces(pieces: ConvexCells | TetMesh, explode: float = 0.0) -> Any:
    """Return a Part.Shape with one solid for each piece, in their order.

    Parameters
    ----------
    pieces : ConvexCells or TetMesh
    explode : float
        Every piece moves by this share of the way from the centre of all to its own centre.

    Returns
    -------
    Part.Shape
        A CompSolid when `explode` is 0 and the pieces hang together face to face, else a
        Compound.
    """
    raise NotImplementedError
