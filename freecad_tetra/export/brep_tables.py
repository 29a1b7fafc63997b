# SPDX-License-Identifier: LGPL-2.1-or-later
"""The vertices, edges and faces that neighbouring pieces share, as arrays.

All by numpy, a piece costs no loop of Python: 20,000 tetrahedra are a common case.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt

from freecad_tetra.model import ConvexCells, FloatArray, IntArray, LongArray, TetMesh

TOLERANCE = 1e-7  # OpenCascade's smallest
SHORT = 3e-7  # edges between two points that the tolerance cannot keep apart
SIDES = np.array([[1, 2, 3], [0, 3, 2], [0, 1, 3], [0, 2, 1]])  # counter-clockwise from outside


@dataclass(frozen=True)
class Tables:
    """Pieces with what they share; ids are 0-based.

    Attributes
    ----------
    points : (p, 3) float64
    slack : (p,) float64
        How far a point may lie from the planes of its facets.
    starts : (F + 1,) int64
        Facet f has the corners ``starts[f] .. starts[f + 1] - 1`` of `corners`.
    corners, edge, forward : (...,) int64, int64, bool
        Point, edge that leaves it, and whether that runs from its lower end.
    ends : (E, 2) int64
        Lower and higher point of each edge.
    face : (F,) int64
        Face of each facet; two facets of neighbours have one.
    first : (N,) int64
        Facet that each face lies like; the other is its reverse.
    piece : (F,) int64
        Piece of each facet, an index into `kept`, ascending.
    facet : (F,) int64
        Facet of the input that each facet is.
    kept : (C,) int64
        Pieces of the input that have a volume.
    """

    points: FloatArray
    slack: FloatArray
    starts: LongArray
    corners: LongArray
    edge: LongArray
    forward: npt.NDArray[np.bool_]
    ends: LongArray
    face: LongArray
    first: LongArray
    piece: LongArray
    facet: LongArray
    kept: LongArray

    def reversed_facets(self) -> npt.NDArray[np.bool_]:
        """Return which facets are the other side of their face, (F,) bool."""
        other: npt.NDArray[np.bool_] = self.first[self.face] != np.arange(len(self.face))
        return other

    def sides(self) -> LongArray:
        """Return the two pieces at each face, -1 for none, (N, 2) int64."""
        out = np.full((len(self.first), 2), -1, np.int64)
        out[self.face, self.reversed_facets().astype(np.int64)] = self.piece
        return out


def cells_of_tets(mesh: TetMesh) -> ConvexCells:
    """Return tetrahedra as cells with four facets each; inner ones have no source, O(t)."""
    count = len(mesh.tets)
    loops = mesh.tets[:, SIDES].reshape(-1, 3)
    facet_face = np.full(4 * count, -1, np.int32)
    facet_source = np.full(4 * count, -1, np.int32)
    order, where = _matched(np.sort(loops, axis=1), np.sort(mesh.skin, axis=1))
    facet_face[where], facet_source[where] = mesh.skin_face[order], mesh.skin_source[order]
    return ConvexCells(
        points=mesh.points,
        facet_offsets=np.arange(0, 12 * count + 1, 3),
        facet_vertices=loops.reshape(-1),
        cell_offsets=np.arange(0, 4 * count + 1, 4),
        facet_source=facet_source,
        facet_face=facet_face,
        cell_solid=mesh.tet_solid,
        point_source=mesh.point_source,
        face_names=mesh.face_names,
        report=mesh.report,
    )


def _matched(rows: IntArray, wanted: IntArray) -> tuple[LongArray, LongArray]:
    """Return (i, j) with ``wanted[i] == rows[j]``, for wanted rows that are there once."""
    both = np.concatenate([wanted, rows])
    _, key = np.unique(both, axis=0, return_inverse=True)
    key = key.reshape(-1)
    source = np.full(len(both), -1, np.int64)
    source[key[: len(wanted)]] = np.arange(len(wanted))
    order = source[key[len(wanted) :]]
    where = np.flatnonzero(order >= 0)
    return order[where], where


def tables(cells: ConvexCells) -> Tables:
    """Find what pieces share; edges shorter than OpenCascade can tell are closed, O(n log n)."""
    corners, facet = _closed(cells)
    sizes = np.bincount(facet, minlength=len(cells.facet_offsets) - 1)
    cell = np.repeat(np.arange(len(cells)), np.diff(cells.cell_offsets))
    whole = np.bincount(cell, weights=sizes > 2, minlength=len(cells)) > 3
    keep = (sizes > 2) & whole[cell]
    corners, sizes = corners[keep[facet]], sizes[keep]
    starts = np.concatenate([[0], np.cumsum(sizes)])
    kept = np.flatnonzero(whole)
    piece = np.searchsorted(kept, cell[keep])
    edge, forward, ends = _edges(corners, starts)
    face, first = _faces(corners, starts)
    slack = _slack(cells.points, corners, starts)
    return Tables(
        cells.points, slack, starts, corners, edge, forward, ends, face, first, piece,
        np.flatnonzero(keep), kept,
    )  # fmt: skip


def planes(table: Tables, facets: LongArray) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Return (origin, unit normal, unit x) of facets by Newell's rule, (n, 3) each."""
    return _planes(table.points, table.corners, table.starts, facets)


def following(starts: LongArray) -> LongArray:
    """Return for every corner the index of the next in its facet."""
    step = np.arange(1, starts[-1] + 1)
    step[starts[1:] - 1] = starts[:-1]
    return step


def _closed(cells: ConvexCells) -> tuple[LongArray, LongArray]:
    """Return all corners and their facets, with the ends of short edges made one."""
    sizes = np.diff(cells.facet_offsets)
    facet = np.repeat(np.arange(len(sizes)), sizes)
    corners = cells.facet_vertices.astype(np.int64)
    if not len(corners):
        return corners, facet
    after = corners[following(cells.facet_offsets)]
    lengths = np.linalg.norm(cells.points[corners] - cells.points[after], axis=1)
    short = np.flatnonzero(lengths < SHORT)
    if not len(short):
        return corners, facet
    parent = np.arange(len(cells.points))
    for a, b in zip(corners[short].tolist(), after[short].tolist()):
        a, b = _root(parent, a), _root(parent, b)
        parent[max(a, b)] = min(a, b)
    root = np.array([_root(parent, i) for i in range(len(parent))])
    keep = root[corners] != root[after]
    return root[corners][keep], facet[keep]


def _root(parent: npt.NDArray[Any], i: int) -> int:
    while parent[i] != i:
        i = int(parent[i])
    return i


def _edges(
    corners: LongArray, starts: LongArray
) -> tuple[LongArray, npt.NDArray[np.bool_], LongArray]:
    if not len(corners):
        return corners, np.zeros(0, bool), np.zeros((0, 2), np.int64)
    after = corners[following(starts)]
    size = int(corners.max()) + 1
    key = np.minimum(corners, after) * size + np.maximum(corners, after)
    known, edge = np.unique(key, return_inverse=True)
    return edge.reshape(-1), corners < after, np.stack([known // size, known % size], axis=1)


def _faces(corners: LongArray, starts: LongArray) -> tuple[LongArray, LongArray]:
    """Number the faces by their first facet; a facet and its reverse are one face."""
    sizes = np.diff(starts)
    leader = np.arange(len(sizes))
    for size in np.unique(sizes).tolist():
        facets = np.flatnonzero(sizes == size)
        rows = corners[starts[facets][:, None] + np.arange(size)]
        turn = (np.argmin(rows, axis=1)[:, None] + np.arange(size)) % size
        rows = np.take_along_axis(rows, turn, axis=1)  # the smallest point leads
        back = rows[:, 1] > rows[:, -1]
        rows[back, 1:] = rows[back, :0:-1]
        _, first, key = np.unique(rows, axis=0, return_index=True, return_inverse=True)
        first = first[key.reshape(-1)]
        joined = back != back[first]  # the same way round is no neighbour
        leader[facets[joined]] = facets[first[joined]]
    first, face = np.unique(leader, return_inverse=True)
    return face.reshape(-1), first


def _slack(points: FloatArray, corners: LongArray, starts: LongArray) -> FloatArray:
    slack = np.full(len(points), TOLERANCE)
    if len(corners):
        facets = np.arange(len(starts) - 1)
        origin, normal, _ = _planes(points, corners, starts, facets)
        facet = np.repeat(facets, np.diff(starts))
        off = np.abs(np.einsum("ij,ij->i", points[corners] - origin[facet], normal[facet]))
        worst = 1.1 * np.maximum.reduceat(off, starts[:-1])
        np.maximum.at(slack, corners, worst[facet])
    return slack


def _planes(
    points: FloatArray, corners: LongArray, starts: LongArray, facets: LongArray
) -> tuple[FloatArray, FloatArray, FloatArray]:
    sizes = np.diff(starts)
    facet = np.repeat(np.arange(len(sizes)), sizes)
    here, there = points[corners], points[corners[following(starts)]]
    shifted = here - here[starts[:-1]][facet]
    turned = np.cross(shifted, there - here[starts[:-1]][facet])
    sides = there - here
    lengths = np.linalg.norm(sides, axis=1)
    longest = np.lexsort((-lengths, facet))[starts[:-1]][facets]
    x = sides[longest] / lengths[longest][:, None]
    normal = np.add.reduceat(turned, starts[:-1], axis=0)[facets]
    # A sliver's normal is noise: it has at least to be perpendicular to its long side.
    normal = normal - np.einsum("ij,ij->i", normal, x)[:, None] * x
    flat = ~(np.linalg.norm(normal, axis=1) > 0)
    normal[flat] = np.cross(x[flat], np.eye(3)[np.argmin(np.abs(x[flat]), axis=1)])
    normal /= np.linalg.norm(normal, axis=1)[:, None]
    origin = (np.add.reduceat(here, starts[:-1], axis=0) / sizes[:, None])[facets]
    return origin, normal, x
