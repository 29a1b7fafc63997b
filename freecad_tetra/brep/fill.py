# SPDX-License-Identifier: LGPL-2.1-or-later
"""Fills slits that OpenCascade's mesher leaves beside slender corners of a face."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace
from typing import Any

import numpy as np
import numpy.typing as npt

from freecad_tetra.errors import TetraError
from freecad_tetra.model import FloatArray, IntArray, Solid

MOST_EDGES = 64  # of a slit
SLIT = 0.01  # of the chord height: what is wider is open in the B-rep, too, and told
Split = Callable[[FloatArray, Sequence[Any]], IntArray]


def filled(solid: Solid, split: Split, height: float) -> Solid:
    """Return the solid with its slits closed by triangles; ``notes["filled_holes"]`` counts.

    Parameters
    ----------
    solid : Solid
    split : callable
        ``split(points, loops)`` triangulates a polygon, see `kernel.triangulate_polygon`.
    height : float
        That of chords, mm; a hundredth of it is the most for a slit's width and depth.

    A new triangle belongs to the face with most of the hole's rim. O(m log m).
    """
    solid_ids = solid.solid_ids
    if solid_ids is None:
        solid_ids = np.zeros(len(solid.triangles), np.int32)
    triangles, faces, owners, holes = [solid.triangles], [solid.face_ids], [solid_ids], 0
    for number in np.unique(solid_ids):
        own = solid_ids == number
        for loop, face in _holes(solid.vertices, solid.triangles[own], solid.face_ids[own]):
            new = _flat(solid.vertices, loop, split, SLIT * height)
            if new is None:
                continue
            holes += 1
            triangles.append(new)
            faces.append(np.full(len(new), face, np.int32))
            owners.append(np.full(len(new), number, np.int32))
    if holes == 0:
        return solid
    return replace(
        solid,
        triangles=np.concatenate(triangles),
        face_ids=np.concatenate(faces),
        solid_ids=None if solid.solid_ids is None else np.concatenate(owners),
        notes={**solid.notes, "filled_holes": holes},
    )


def _holes(points: FloatArray, triangles: IntArray, faces: IntArray) -> list[tuple[list[int], int]]:
    """Return (loop, face) of holes: the loop turns as the triangles do that are missing."""
    tails = triangles.reshape(-1).astype(np.int64)
    heads = np.roll(triangles, -1, axis=1).reshape(-1).astype(np.int64)
    size = len(points)
    there, back = tails * size + heads, heads * size + tails
    open_ = np.flatnonzero(~np.isin(there, back))
    following = dict(zip(heads[open_].tolist(), tails[open_].tolist()))
    if len(following) != len(open_) or len(set(following.values())) != len(open_):
        return []  # holes meet in a vertex: which edges go together is not clear
    face_of = dict(zip(heads[open_].tolist(), np.repeat(faces, 3)[open_].tolist()))
    found = []
    while following:
        loop = [next(iter(following))]
        while (after := following.pop(loop[-1], None)) is not None and after != loop[0]:
            loop.append(after)
        if after is None or not 3 <= len(loop) <= MOST_EDGES:
            continue
        rim: dict[int, float] = {}
        for u, v in zip(loop, loop[1:] + loop[:1]):
            length = float(np.linalg.norm(points[v] - points[u]))
            rim[face_of[u]] = rim.get(face_of[u], 0.0) + length
        found.append((loop, min(rim, key=lambda f: (-rim[f], f))))
    return found


def _flat(
    points: FloatArray, loop: list[int], split: Split, most: float
) -> npt.NDArray[np.int32] | None:
    """Return the triangles of a hole, None when it is no slit or its rim crosses itself."""
    rim = points[loop] - points[loop].mean(axis=0)
    normal = np.cross(rim, np.roll(rim, -1, axis=0)).sum(axis=0)
    area = float(np.linalg.norm(normal))
    longest = float(np.linalg.norm(np.ptp(rim, axis=0)))
    if area == 0 or max(area / longest, np.abs(rim @ (normal / area)).max()) > most:
        return None
    across = np.eye(3)[np.argmin(np.abs(normal))]
    right = np.cross(across, normal)
    up = np.cross(normal, right)
    flat = rim @ np.stack([right / np.linalg.norm(right), up / np.linalg.norm(up)], axis=1)
    try:
        rows = split(flat, [np.arange(len(loop), dtype=np.int32)])
    except TetraError:
        return None
    return np.array(loop, np.int32)[rows]
