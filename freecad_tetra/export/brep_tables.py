# SPDX-License-Identifier: LGPL-2.1-or-later
"""The vertices, edges and faces that neighbouring pieces share, as arrays.

All by numpy, a piece costs no loop of Python: 20,000 tetrahedra are a common case.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt

from freecad_tetra.export import imprint
from freecad_tetra.export.overlay import Facets
from freecad_tetra.model import ConvexCells, FloatArray, IntArray, LongArray, TetMesh

TOLERANCE = 1e-7  # OpenCascade's smallest
SHORT = 3e-7  # edges between two points that the tolerance cannot keep apart
_NEAR = 10.0  # times the distance of points from the planes of their facets
SIDES = np.array([[1, 2, 3], [0, 3, 2], [0, 1, 3], [0, 2, 1]])  # counter-clockwise from outside


@dataclass(frozen=True)
class Tables:
    """Pieces with what they share; ids are 0-based.

    Attributes
    ----------
    points : (p, 3) float64
    slack : (p,) float64
        How far a point may lie from the planes of its facets.
    starts : (L + 1,) int64
        Loop l has the corners ``starts[l] .. starts[l + 1] - 1`` of `corners`.
    corners, edge, forward : (...,) int64, int64, bool
        Point, edge that leaves it, and whether that runs from its lower end.
    loops : (F + 1,) int64
        Facet f has the loops ``loops[f] .. loops[f + 1] - 1``: round it, then round its holes.
    ends : (E, 2) int64
        Lower and higher point of each edge.
    face : (F,) int64
        Face of each facet; two facets of neighbours have one.
    first : (N,) int64
        Facet that each face lies like; the other is its reverse.
    piece : (F,) int64
        Piece of each facet, an index into `kept`, ascending.
    facet : (F,) int64
        Facet of the input that each facet is, or is a part of.
    kept : (C,) int64
        Pieces of the input that have a volume.
    """

    points: FloatArray
    slack: FloatArray
    starts: LongArray
    corners: LongArray
    edge: LongArray
    forward: npt.NDArray[np.bool_]
    loops: LongArray
    ends: LongArray
    face: LongArray
    first: LongArray
    piece: LongArray
    facet: LongArray
    kept: LongArray

    def facet_of_corner(self) -> LongArray:
        """Return the facet of every corner, (...,) int64."""
        of_loop = np.repeat(np.arange(len(self.face)), np.diff(self.loops))
        return np.repeat(of_loop, np.diff(self.starts))

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


def tables(cells: ConvexCells, share: bool = False, alone: Sequence[int] = ()) -> Tables:
    """Find what pieces share, O(n log n).

    Edges shorter than OpenCascade can tell are closed; cells thinner than that, or than their
    points are exact, are left out.

    Parameters
    ----------
    cells : ConvexCells
    share : bool
        Divide facets that lie face to face, so that neighbours share whole faces, as far as
        these are not thinner than the points are exact. Without it they share what is whole.
    alone : sequence of int
        Cells that are not divided all the same.
    """
    corners, facet, flat = _closed(cells, everywhere=share)
    sizes = np.bincount(facet, minlength=len(cells.facet_offsets) - 1)
    cell = np.repeat(np.arange(len(cells)), np.diff(cells.cell_offsets))
    whole = np.bincount(cell, weights=sizes > 2, minlength=len(cells)) > 3
    whole &= ~_too_thin(cells)
    whole[flat] = False
    keep = (sizes > 2) & whole[cell]
    starts = np.concatenate([[0], np.cumsum(sizes[keep])])
    kept, facets = np.flatnonzero(whole), np.flatnonzero(keep)
    facets_whole = Facets(cells.points, starts, corners[keep[facet]], cell[keep])
    loops = np.arange(len(facets) + 1)
    if share and len(facets):
        return _divided(facets_whole, facets, kept, np.array(alone, np.int64))
    return _tables(cells.points, starts, facets_whole.corners, loops, facets_whole, facets, kept)


def _divided(whole: Facets, facets: LongArray, kept: LongArray, alone: LongArray) -> Tables:
    origin, normal, _ = _planes(whole.points, whole.corners, whole.starts)
    single = np.arange(len(facets) + 1)
    reach = _NEAR * float(_slack(whole.points, whole.corners, whole.starts, single).max())
    found = imprint.divided(whole, origin, normal, reach, alone)
    loops = [loop for _, own in found.faces for loop in own]
    starts = np.concatenate([[0], np.cumsum([len(loop) for loop in loops])])
    corners = np.fromiter((v for loop in loops for v in loop), np.int64, int(starts[-1]))
    of = np.array([facet for facet, _ in found.faces])
    counts = np.array([len(own) for _, own in found.faces])
    parts = Facets(found.points, starts, corners, whole.cell[of])
    first = np.concatenate([[0], np.cumsum(counts)])
    return _tables(found.points, starts, corners, first, parts, facets[of], kept)


def _tables(
    points: FloatArray, starts: LongArray, corners: LongArray, loops: LongArray, facets: Facets,
    facet: LongArray, kept: LongArray,
) -> Tables:  # fmt: skip
    edge, forward, ends = _edges(corners, starts)
    face, first = _faces(corners, starts, loops)
    slack = _slack(points, corners, starts, loops)
    piece = np.searchsorted(kept, facets.cell)
    return Tables(
        points, slack, starts, corners, edge, forward, loops, ends, face, first, piece, facet, kept
    )


def planes(table: Tables, facets: LongArray) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Return (origin, unit normal, unit x) of facets by Newell's rule, (n, 3) each."""
    found = _planes(table.points, table.corners, table.starts)
    outer = table.loops[facets]
    return found[0][outer], found[1][outer], found[2][outer]


def following(starts: LongArray) -> LongArray:
    """Return for every corner the index of the next in its facet."""
    step = np.arange(1, starts[-1] + 1)
    step[starts[1:] - 1] = starts[:-1]
    return step


def _closed(cells: ConvexCells, everywhere: bool) -> tuple[LongArray, LongArray, LongArray]:
    """Return all corners and their facets, with the ends of short edges made one, or all points
    of one place; and the cells that fall flat by that.

    Points of a cell that is as thin as the places are wide are left apart where that helps.
    """
    sizes = np.diff(cells.facet_offsets)
    facet = np.repeat(np.arange(len(sizes)), sizes)
    cell = np.repeat(np.arange(len(cells)), np.diff(cells.cell_offsets))[facet]
    corners = cells.facet_vertices.astype(np.int64)
    if not len(corners):
        return corners, facet, cell
    after = corners[following(cells.facet_offsets)]
    pairs = near = _short(cells.points, np.stack([corners, after], axis=1))
    if everywhere:
        found = imprint.near_segments(cells.points, cells.points, cells.points)
        other = np.stack(found, axis=1)
        other = _short(cells.points, other[other[:, 0] < other[:, 1]])
        near = np.concatenate([pairs, other])
    apart = np.zeros(len(cells.points), bool)
    while True:
        keep, merged = _merged(corners, after, near)
        flat = _flat(cell[keep], facet[keep], merged)
        touched = corners[np.isin(cell, flat)]
        if apart[touched].all():
            return merged, facet[keep], flat
        apart[touched] = True
        near = np.concatenate([pairs, near[~apart[near].any(axis=1)]])


def _too_thin(cells: ConvexCells) -> npt.NDArray[np.bool_]:
    """Return which cells are no thicker than three times the error of their points, (C,)."""
    if not len(cells):
        return np.zeros(0, bool)
    starts, corners = cells.facet_offsets, cells.facet_vertices.astype(np.int64)
    slack = _slack(cells.points, corners, starts, np.arange(len(starts)))[corners]
    error = np.maximum.reduceat(slack, starts[cells.cell_offsets[:-1]])
    triangles, facet = cells.fans()
    a, b, c = (cells.points[triangles[:, i]] for i in range(3))
    areas = np.linalg.norm(np.cross(b - a, c - a), axis=1) / 2
    cell = np.repeat(np.arange(len(cells)), np.diff(cells.cell_offsets))[facet]
    area = np.bincount(cell, weights=areas, minlength=len(cells))
    thin: npt.NDArray[np.bool_] = 2 * cells.volumes() <= 3 * error * area
    return thin


def _short(points: FloatArray, pairs: LongArray) -> LongArray:
    lengths = np.linalg.norm(points[pairs[:, 0]] - points[pairs[:, 1]], axis=1)
    return pairs[lengths < SHORT]


def _merged(
    corners: LongArray, after: LongArray, pairs: LongArray
) -> tuple[npt.NDArray[np.bool_], LongArray]:
    """Return which corners remain when pairs of points are one, and what they are then."""
    parent = np.arange(int(corners.max()) + 1)
    for a, b in pairs.tolist():
        a, b = _root(parent, a), _root(parent, b)
        parent[max(a, b)] = min(a, b)
    root = parent
    while not np.array_equal(root, root[root]):
        root = root[root]
    keep = root[corners] != root[after]
    return keep, root[corners[keep]]


def _flat(cell: LongArray, facet: LongArray, corners: LongArray) -> LongArray:
    """Return the cells in which a directed edge comes twice: two facets have become one."""
    sizes = np.bincount(facet)
    solid = sizes[facet] > 2
    cell, facet, corners = cell[solid], facet[solid], corners[solid]
    if not len(corners):
        return cell
    starts = np.concatenate([[0], np.cumsum(sizes[sizes > 2])])
    edges = np.stack([cell, corners, corners[following(starts)]], axis=1)
    _, first, count = np.unique(edges, axis=0, return_index=True, return_counts=True)
    return np.unique(cell[first[count > 1]])


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


def _faces(corners: LongArray, starts: LongArray, loops: LongArray) -> tuple[LongArray, LongArray]:
    """Number the faces by their first facet; a facet and its reverse are one face."""
    sizes = np.diff(starts)[loops[:-1]]
    sizes[np.diff(loops) > 1] = 0  # with holes it has no reverse
    leader = np.arange(len(sizes))
    for size in np.unique(sizes[sizes > 0]).tolist():
        facets = np.flatnonzero(sizes == size)
        rows = corners[starts[loops[facets]][:, None] + np.arange(size)]
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


def _slack(
    points: FloatArray, corners: LongArray, starts: LongArray, loops: LongArray
) -> FloatArray:
    slack = np.full(len(points), TOLERANCE)
    if len(corners):
        origin, normal, _ = _planes(points, corners, starts)
        outer = np.repeat(loops[:-1], np.diff(loops))  # of each loop, the one round its facet
        at = np.repeat(outer, np.diff(starts))
        off = np.abs(np.einsum("ij,ij->i", points[corners] - origin[at], normal[at]))
        worst = 1.1 * np.maximum.reduceat(off, starts[loops[:-1]])
        facet = np.repeat(np.arange(len(loops) - 1), np.diff(starts[loops]))
        np.maximum.at(slack, corners, worst[facet])
    return slack


def _planes(
    points: FloatArray, corners: LongArray, starts: LongArray
) -> tuple[FloatArray, FloatArray, FloatArray]:
    sizes = np.diff(starts)
    loop = np.repeat(np.arange(len(sizes)), sizes)
    here, there = points[corners], points[corners[following(starts)]]
    first = here[starts[:-1]][loop]
    turned = np.cross(here - first, there - first)
    sides = there - here
    lengths = np.linalg.norm(sides, axis=1)
    longest = np.lexsort((-lengths, loop))[starts[:-1]]
    size = lengths[longest][:, None]
    x = np.where(size > 0, sides[longest], [1.0, 0.0, 0.0]) / np.where(size > 0, size, 1.0)
    normal = np.add.reduceat(turned, starts[:-1], axis=0)
    # A sliver's normal is noise: it has at least to be perpendicular to its long side.
    normal = normal - np.einsum("ij,ij->i", normal, x)[:, None] * x
    flat = ~(np.linalg.norm(normal, axis=1) > 0)
    normal[flat] = np.cross(x[flat], np.eye(3)[np.argmin(np.abs(x[flat]), axis=1)])
    normal /= np.linalg.norm(normal, axis=1)[:, None]
    origin = np.add.reduceat(here, starts[:-1], axis=0) / sizes[:, None]
    return origin, normal, x
