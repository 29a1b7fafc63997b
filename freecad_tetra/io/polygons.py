# SPDX-License-Identifier: LGPL-2.1-or-later
"""Polygons of a mesh file become triangles without new points.

A convex polygon becomes a fan. A polygon that is not convex goes to the triangulator that
the caller hands in (the kernel's), in the coordinate plane where it is largest.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from fractions import Fraction
from typing import Any

import numpy as np
import numpy.typing as npt

from freecad_tetra.errors import Defect, InvalidPolygon, InvalidSolid, KernelMissing
from freecad_tetra.model import FloatArray, IntArray

LongArray = npt.NDArray[np.int64]
Split = Callable[[Any, Any], IntArray]


class BadFile(ValueError):
    """A reader cannot go on; the message is for people."""


@dataclass(frozen=True)
class Mesh:
    """Points (n, 3) float64, and polygons as consecutive runs of `corners`."""

    points: FloatArray
    corners: LongArray
    sizes: LongArray

    @property
    def count(self) -> int:
        """Number of polygons."""
        return len(self.sizes)


def mesh(points: FloatArray, corners: Any, sizes: Any = None) -> Mesh:
    """Return a checked Mesh; `corners` is (m, 3), or flat together with `sizes`."""
    flat = np.asarray(corners, np.int64).reshape(-1)
    runs = np.full(len(flat) // 3, 3, np.int64) if sizes is None else np.asarray(sizes, np.int64)
    if len(flat) and (flat.min() < 0 or flat.max() >= len(points)):
        raise BadFile(f"a polygon names a vertex that does not exist ({len(points)} vertices)")
    if len(runs) and runs.min() < 3:
        raise BadFile("a polygon has fewer than three corners")
    return Mesh(np.ascontiguousarray(points, np.float64).reshape(-1, 3), flat, runs)


def welded(mesh: Mesh, leader: LongArray) -> Mesh:
    """Return the mesh with each corner replaced by its `leader`; repeats in a row go.

    A triangle stays a triangle, so that the caller can count what collapsed.
    """
    corners = leader[mesh.corners]
    if (mesh.sizes == 3).all():
        return Mesh(mesh.points, corners, mesh.sizes)
    loops: list[LongArray] = []
    for end, size in zip(np.cumsum(mesh.sizes), mesh.sizes):
        loop = corners[end - size : end]
        short = loop[loop != np.roll(loop, 1)] if size > 3 else loop
        loops.append(short if len(short) >= 3 else loop[[0, 0, 0]])
    sizes = np.array([len(x) for x in loops], np.int64)
    return Mesh(mesh.points, np.concatenate(loops), sizes)


def triangulate(mesh: Mesh, split: Split | None) -> tuple[LongArray, LongArray]:
    """Return triangles (t, 3) and the polygon of each (t,), in the order of the polygons.

    Raises
    ------
    InvalidSolid
        ``bad_polygon`` when a polygon crosses itself or has no area.
    KernelMissing
        A polygon is not convex and there is no `split`.
    """
    ids = np.arange(mesh.count, dtype=np.int64)
    if (mesh.sizes == 3).all():
        return mesh.corners.reshape(-1, 3), ids
    ends = np.cumsum(mesh.sizes)
    rows: list[LongArray] = []
    for end, size in zip(ends, mesh.sizes):
        loop = mesh.corners[end - size : end]
        rows.append(loop.reshape(1, 3) if size == 3 else _split_one(mesh.points, loop, split))
    counts = np.array([len(r) for r in rows])
    return np.concatenate(rows), np.repeat(ids, counts)


def _split_one(points: FloatArray, loop: LongArray, split: Split | None) -> LongArray:
    corners = points[loop]
    start = _fan_start(_flattened(corners))
    if start is not None:
        turned = np.roll(loop, -start)
        first = np.full(len(loop) - 2, turned[0])
        return np.stack([first, turned[1:-1], turned[2:]], axis=1)
    if split is None:
        raise KernelMissing("a polygon that is not convex needs the kernel's triangulation")
    local = np.arange(len(loop), dtype=np.int32)
    try:
        triangles = split(_flattened(corners), local)
    except InvalidPolygon as error:
        text = f"a polygon of {len(loop)} corners cannot be triangulated: {error}"
        raise InvalidSolid([_bad(text, loop)]) from error
    if len(triangles) != len(loop) - 2:
        raise InvalidSolid([_bad(f"a polygon of {len(loop)} corners is not simple", loop)])
    return loop[np.asarray(triangles, np.int64)]


def _bad(text: str, loop: LongArray) -> Defect:
    return Defect("bad_polygon", text, vertices=tuple(int(i) for i in loop[:100]))


def _flattened(corners: FloatArray) -> FloatArray:
    """Return the corners (k, 2) in the coordinate plane where the loop is largest, turning left."""
    shifted = corners - corners[0]
    normal = np.cross(shifted, np.roll(shifted, -1, axis=0)).sum(axis=0)
    axis = int(np.argmax(np.abs(normal)))
    pair = [(1, 2), (2, 0), (0, 1)][axis]
    flat = corners[:, pair]
    return np.ascontiguousarray(flat if normal[axis] >= 0 else flat[:, ::-1])


def _fan_start(flat: FloatArray) -> int | None:
    """Return a corner whose fan has only triangles that turn left, None when not convex."""
    size = len(flat)
    turns = [_turn(flat[i - 1], flat[i], flat[(i + 1) % size]) for i in range(size)]
    if min(turns) < 0 or sum(t > 0 for t in turns) < 3:
        return None
    for start in range(size):
        loop = np.roll(flat, -start, axis=0)
        if all(_turn(loop[0], loop[i], loop[i + 1]) > 0 for i in range(1, size - 1)):
            return start
    return None


def _turn(a: FloatArray, b: FloatArray, c: FloatArray) -> int:
    """Return the exact sign of the turn a, b, c in the plane."""
    left = float((b[0] - a[0]) * (c[1] - a[1]))
    right = float((b[1] - a[1]) * (c[0] - a[0]))
    value = left - right
    if abs(value) > 1e-14 * (abs(left) + abs(right)):
        return 1 if value > 0 else -1
    ax, ay, bx, by, cx, cy = (Fraction(float(x)) for x in (*a, *b, *c))
    exact = (bx - ax) * (cy - ay) - (by - ay) * (cx - ax)
    return (exact > 0) - (exact < 0)
