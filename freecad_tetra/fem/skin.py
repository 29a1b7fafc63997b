# SPDX-License-Identifier: LGPL-2.1-or-later
"""Which B-rep faces meet at the edges and points of a mesh's skin.

A set of faces is where CAD and mesh meet: one face means inside of it, two a B-rep edge, more a
vertex.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from freecad_tetra.model import LongArray

Faces = tuple[int, ...]


@dataclass(frozen=True, eq=False)
class SkinEdges:
    """The edges of a skin, each once.

    Attributes
    ----------
    ends : (e, 2) int64
        Ascending point ids, in ascending order.
    of_triangle : (s, 3) int64
        Edges 01, 12, 20 of each triangle.
    count : (e,) int64
        Triangles at each edge.
    """

    ends: LongArray
    of_triangle: LongArray
    count: LongArray


def skin_edges(triangles: Any) -> SkinEdges:
    """Gather the edges of triangles (s, 3), O(s log s)."""
    corners = np.asarray(triangles, np.int64)[:, :3]
    ends = np.sort(np.stack([corners, np.roll(corners, -1, axis=1)], axis=2), axis=2)
    size = int(corners.max()) + 1 if len(corners) else 1
    codes, index = np.unique(ends[:, :, 0] * size + ends[:, :, 1], return_inverse=True)
    pairs = np.stack([codes // size, codes % size], axis=1)
    return SkinEdges(pairs, index.reshape(-1, 3), np.bincount(index.reshape(-1)).astype(np.int64))


def faces_of_edges(edges: SkinEdges, skin_face: Any) -> dict[Faces, LongArray]:
    """Group edges by the B-rep faces that meet in them; values are ids of edges."""
    return _grouped(edges.of_triangle, skin_face)


def faces_of_points(triangles: Any, skin_face: Any) -> dict[Faces, LongArray]:
    """Group the points of a skin by the B-rep faces that meet in them."""
    return _grouped(np.asarray(triangles, np.int64)[:, :3], skin_face)


def _grouped(items: LongArray, skin_face: Any) -> dict[Faces, LongArray]:
    """Group items that stand in rows (s, 3) of triangles by the set of faces of the rows."""
    if not len(items):
        return {}
    face = np.repeat(np.asarray(skin_face, np.int64), 3)
    pairs = np.unique(np.stack([items.reshape(-1), face], axis=1), axis=0)
    item, start, count = np.unique(pairs[:, 0], return_index=True, return_counts=True)
    groups: dict[Faces, list[LongArray]] = {}
    single = count == 1
    only = pairs[start[single], 1]
    for f in np.unique(only):
        groups[(int(f),)] = [item[single][only == f]]
    for i in np.flatnonzero(~single):
        faces = tuple(int(f) for f in pairs[start[i] : start[i] + count[i], 1])
        groups.setdefault(faces, []).append(item[i : i + 1])
    return {faces: np.concatenate(parts) for faces, parts in sorted(groups.items())}


def skin_of(tets: Any, tet_solid: Any) -> tuple[LongArray, LongArray]:
    """Return outward triangles (s, 3) of all solids, and the tetrahedron of each, O(t log t).

    A triangle between two solids is in the skin of both.
    """
    corners = np.asarray(tets, np.int64)[:, :4]
    sides = corners[:, [[1, 2, 3], [0, 3, 2], [0, 1, 3], [0, 2, 1]]].reshape(-1, 3)
    owner = np.repeat(np.arange(len(corners)), 4)
    keys = np.sort(sides, axis=1)
    order = np.lexsort((keys[:, 2], keys[:, 1], keys[:, 0]))
    same = (keys[order[1:]] == keys[order[:-1]]).all(axis=1)
    solid = np.asarray(tet_solid)
    inner = same & (solid[owner[order[1:]]] == solid[owner[order[:-1]]])
    outer = np.ones(len(order), bool)
    outer[1:] &= ~inner
    outer[:-1] &= ~inner
    rows = np.sort(order[outer])
    return sides[rows], owner[rows]
