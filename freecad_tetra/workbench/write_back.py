# SPDX-License-Identifier: LGPL-2.1-or-later
"""Pieces become one Part.Shape whose neighbours share their vertices, edges and faces."""

from __future__ import annotations

from typing import Any

import numpy as np

from freecad_tetra.errors import TetraError
from freecad_tetra.export import brep, brep_tables
from freecad_tetra.export.brep_tables import Tables
from freecad_tetra.model import ConvexCells, FloatArray, LongArray, TetMesh

_TRIES = 4


def shape_of_pieces(pieces: ConvexCells | TetMesh, explode: float = 0.0) -> Any:
    """Return a Part.Shape with one solid for each piece, in their order; O(n log n).

    Pieces thinner than OpenCascade can tell are left out.

    Parameters
    ----------
    pieces : ConvexCells or TetMesh
    explode : float
        Every piece moves by this share of the way from the centre of all to its own centre.

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
    if isinstance(pieces, TetMesh):
        return _shape(pieces, brep_tables.tables(brep_tables.cells_of_tets(pieces)), explode)
    if explode:
        return _shape(pieces, brep_tables.tables(pieces), explode)
    return _shape_of_neighbours(pieces)


def _shape_of_neighbours(cells: ConvexCells) -> Any:
    """Return cells that are divided where they meet.

    Where points are not exact, some may be too thin for OpenCascade once they are divided:
    those stay as they are.
    """
    alone: list[int] = []
    for _ in range(_TRIES):
        table = brep_tables.tables(cells, True, alone)
        shape = _shape(cells, table, 0.0)
        if table.slack.max() <= brep_tables.TOLERANCE or shape.isValid():
            return shape
        faulty = [k for k, solid in enumerate(shape.Solids) if not solid.isValid()]
        alone += table.kept[faulty].tolist()
    return _shape(cells, brep_tables.tables(cells), 0.0)


def _shape(pieces: ConvexCells | TetMesh, table: Tables, explode: float) -> Any:
    import Part

    shifts = _shifts(table, explode) if explode else None
    whole = [] if explode else _face_to_face(pieces, table)
    shape = Part.Shape()
    shape.importBrepFromString(brep.text(table, whole, shifts), False)
    if shape.isNull() or len(shape.Solids) != len(table.kept):
        raise TetraError("OpenCascade cannot read the pieces", "please report the part")
    return shape


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
