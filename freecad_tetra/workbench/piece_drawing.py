# SPDX-License-Identifier: LGPL-2.1-or-later
"""The arrays that show pieces: corners, triangles and edges of each, and how it moves apart."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from freecad_tetra.model import ConvexCells, FloatArray, LongArray, TetMesh
from freecad_tetra.workbench.piece_centres import centres

# Faces of a positive tetrahedron, counter-clockwise seen from outside, and its edges.
TET_FACES = np.array([[0, 2, 1], [0, 1, 3], [1, 2, 3], [0, 3, 2]])
TET_EDGES = np.array([[0, 1], [0, 2], [0, 3], [1, 2], [1, 3], [2, 3]])


@dataclass(frozen=True)
class Drawing:
    """Arrays of a scene; no vertex belongs to two pieces.

    Attributes
    ----------
    points : (v, 3) float64
    piece : (v,) int64
        Piece of each vertex, ascending.
    triangles : (t, 3) int64
        Ids into `points`, ordered by piece, counter-clockwise seen from outside.
    parts : (pieces,) int64
        How many triangles each piece has.
    edges : (e, 2) int64
        Ids into `points`.
    shifts : (v, 3) float64
        How each vertex moves when pieces are drawn apart by the factor 1.
    """

    points: FloatArray
    piece: LongArray
    triangles: LongArray
    parts: LongArray
    edges: LongArray
    shifts: FloatArray


def drawing(pieces: ConvexCells | TetMesh) -> Drawing:
    """Return the arrays that show the pieces, O(size log size)."""
    if isinstance(pieces, TetMesh):
        corner, piece, triangles, edges = _of_tets(pieces)
    else:
        corner, piece, triangles, edges = _of_cells(pieces)
    count = len(pieces)
    middle = centres(pieces)
    shifts = (middle - middle.mean(axis=0))[piece] if count else np.zeros((0, 3))
    parts = np.bincount(piece[triangles[:, 0]], minlength=count).astype(np.int64)
    return Drawing(pieces.points[corner], piece, triangles, parts, edges, shifts)


def _of_tets(mesh: TetMesh) -> tuple[LongArray, LongArray, LongArray, LongArray]:
    """Return (corner of each vertex, its piece, triangles, edges)."""
    first = 4 * np.arange(len(mesh), dtype=np.int64)[:, None, None]
    corner = mesh.tets.astype(np.int64).ravel()
    piece = np.repeat(np.arange(len(mesh), dtype=np.int64), 4)
    return corner, piece, (first + TET_FACES).reshape(-1, 3), (first + TET_EDGES).reshape(-1, 2)


def _of_cells(cells: ConvexCells) -> tuple[LongArray, LongArray, LongArray, LongArray]:
    """Return (corner of each vertex, its piece, triangles, edges)."""
    fans, facet = cells.fans()
    cell_of_facet = np.repeat(np.arange(len(cells), dtype=np.int64), np.diff(cells.cell_offsets))
    stride = max(1, len(cells.points))
    size = np.diff(cells.facet_offsets)
    tail = np.arange(len(cells.facet_vertices))
    last = np.repeat(cells.facet_offsets[1:] - 1, size)
    head = np.where(tail == last, np.repeat(cells.facet_offsets[:-1], size), tail + 1)
    loops = np.stack([cells.facet_vertices[tail], cells.facet_vertices[head]], axis=1)
    by_fan = cell_of_facet[facet][:, None] * stride + fans
    by_edge = np.sort(np.repeat(cell_of_facet, size)[:, None] * stride + loops, axis=1)
    by_edge = np.unique(by_edge, axis=0)
    keys = np.unique(by_fan)
    triangles = np.searchsorted(keys, by_fan)
    return keys % stride, keys // stride, triangles, np.searchsorted(keys, by_edge)
