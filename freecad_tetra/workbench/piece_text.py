# SPDX-License-Identifier: LGPL-2.1-or-later
"""The BREP text of all pieces and what they share; needs no FreeCAD, so that the child makes it."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from freecad_tetra.export import brep, brep_tables
from freecad_tetra.export.brep_tables import Tables
from freecad_tetra.model import ConvexCells, FloatArray, LongArray, TetMesh


@dataclass(frozen=True)
class PieceText:
    """A shape as OpenCascade reads it.

    Attributes
    ----------
    text : str
    kept : (C,) int64
        The piece that each solid is.
    exact : bool
        Points lie on the planes of their faces as far as OpenCascade can tell; then no solid
        is too thin for it.
    """

    text: str
    kept: LongArray
    exact: bool


def piece_text(
    pieces: ConvexCells | TetMesh, explode: float = 0.0, alone: Sequence[int] | None = ()
) -> PieceText:
    """Return the text of pieces, one solid each; O(n log n).

    Parameters
    ----------
    pieces : ConvexCells or TetMesh
        Tetrahedra are face to face, cells are divided where they meet.
    explode : float
        Every piece moves by this share of the way from the centre of all to its own centre, and
        shares nothing.
    alone : sequence of int, optional
        Cells that are not divided; None for all.
    """
    if isinstance(pieces, TetMesh):
        table = brep_tables.tables(brep_tables.cells_of_tets(pieces))
    elif explode or alone is None:
        table = brep_tables.tables(pieces)
    else:
        table = brep_tables.tables(pieces, True, alone)
    shifts = _shifts(table, explode) if explode else None
    whole = [] if explode else _face_to_face(pieces, table)
    exact = bool((table.slack <= brep_tables.TOLERANCE).all())
    return PieceText(brep.text(table, whole, shifts), table.kept, exact)


def _shifts(table: Tables, explode: float) -> FloatArray:
    """Return how far each piece moves, (C, 3) float64."""
    corner_piece = table.piece[table.facet_of_corner()]
    count = np.bincount(corner_piece, minlength=len(table.kept))
    places = table.points[table.corners]
    own = np.stack([np.bincount(corner_piece, weights=x, minlength=len(count)) for x in places.T])
    centres = (own / count).T
    middle = (places.min(axis=0) + places.max(axis=0)) / 2
    return explode * (centres - middle)


def _face_to_face(pieces: ConvexCells | TetMesh, table: Tables) -> list[LongArray]:
    """Return the groups of pieces, two or more, that share every inner facet with a neighbour."""
    sides = table.sides()
    paired = (sides[:, 0] >= 0) & (sides[:, 1] >= 0)
    group = _groups(len(table.kept), sides[paired])
    ragged = np.zeros(len(table.kept), bool)
    if isinstance(pieces, ConvexCells):
        alone = np.flatnonzero((pieces.facet_source[table.facet] < 0) & ~paired[table.face])
        ragged[group[table.piece[alone]]] = True
    found = [np.flatnonzero(group == g) for g in np.unique(group[~ragged[group]]).tolist()]
    return [members for members in found if len(members) > 1]


def _groups(count: int, pairs: LongArray) -> LongArray:
    """Return for each of `count` pieces the smallest piece that hangs together with it."""
    group = np.arange(count)
    while True:
        least = group.copy()
        np.minimum.at(least, pairs[:, 0], group[pairs[:, 1]])
        np.minimum.at(least, pairs[:, 1], group[pairs[:, 0]])
        least = least[least]
        if np.array_equal(least, group):
            return group
        group = least
