# SPDX-License-Identifier: LGPL-2.1-or-later
"""The common parts of facets that lie face to face, of cells that need not meet face to face.

For output only, in doubles: points nearer than a reach are one. Whatever is found or missed
here, cells stay closed (see `freecad_tetra.export.imprint`); what is missed is not shared.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np

from freecad_tetra.model import FloatArray, LongArray

_TILT = 1e-5  # between normals that count as opposite
_BLOCK = 1_000_000  # pairs of boxes looked at together

Corner = tuple[float, float, float]
Axes = tuple[Corner, Corner]


@dataclass(frozen=True)
class Facets:
    """Plane facets as loops, and the cells they belong to.

    Attributes
    ----------
    points : (p, 3) float64
    starts : (F + 1,) int64
    corners : (...,) int64
    cell : (F,) int64
    """

    points: FloatArray
    starts: LongArray
    corners: LongArray
    cell: LongArray

    def loop(self, facet: int) -> list[int]:
        """Return the corners of one facet, counter-clockwise seen from outside."""
        loop: list[int] = self.corners[self.starts[facet] : self.starts[facet + 1]].tolist()
        return loop


@dataclass(frozen=True)
class Part:
    """What two facets have in common, counter-clockwise seen from outside the front one."""

    front: int
    back: int
    loop: tuple[int, ...]


class Places:
    """Points by place: those nearer than the reach are one; found are those in use."""

    def __init__(self, points: FloatArray, used: LongArray, reach: float) -> None:
        self._reach = reach
        self._size = 2 * reach
        self.points: list[Corner] = [tuple(p) for p in points.tolist()]
        self._known: dict[tuple[int, int, int], list[int]] = {}
        for i in used.tolist():
            self._known.setdefault(self._key(self.points[i]), []).append(i)

    def _key(self, point: Corner) -> tuple[int, int, int]:
        x, y, z = (int(v // self._size) for v in point)
        return x, y, z

    def at(self, point: Corner) -> int:
        """Return the nearest point within reach, a new one when there is none."""
        low = self._key((point[0] - self._reach, point[1] - self._reach, point[2] - self._reach))
        high = self._key((point[0] + self._reach, point[1] + self._reach, point[2] + self._reach))
        best, least = -1, self._reach**2
        for x in range(low[0], high[0] + 1):
            for y in range(low[1], high[1] + 1):
                for z in range(low[2], high[2] + 1):
                    for i in self._known.get((x, y, z), ()):
                        q = self.points[i]
                        off = sum((a - b) ** 2 for a, b in zip(point, q))
                        if off <= least:
                            best, least = i, off
        if best < 0:
            best = len(self.points)
            self.points.append(point)
            self._known.setdefault(self._key(point), []).append(best)
        return best


def common_parts(
    facets: Facets, origin: FloatArray, normal: FloatArray, places: Places, reach: float
) -> list[Part]:
    """Return the common parts of all pairs of facets that face each other.

    Parameters
    ----------
    facets : Facets
        Convex ones.
    origin, normal : (F, 3) float64
        Planes, normals of length 1 outward.
    places : Places
        Holds the points of the facets; crossings of edges are added.
    reach : float
        Distance under which things coincide.
    """
    found = []
    axes = axes_of(normal)
    for front, back in facing_pairs(facets, origin, normal, reach):
        loop = _clipped(facets, axes[front], front, back, places, reach)
        if loop:
            found.append(Part(front, back, loop))
    return found


def facing_pairs(
    facets: Facets, origin: FloatArray, normal: FloatArray, reach: float
) -> Iterator[tuple[int, int]]:
    """Yield pairs (lower, higher) of coplanar facets of two cells with opposite normals whose
    boxes overlap, in order."""
    low = np.minimum.reduceat(facets.points[facets.corners], facets.starts[:-1], axis=0) - reach
    high = np.maximum.reduceat(facets.points[facets.corners], facets.starts[:-1], axis=0) + reach
    pairs = [np.zeros((0, 2), np.int64)]
    for front, back in _opposites(origin, normal, reach):
        step = max(1, _BLOCK // len(back))
        for start in range(0, len(front), step):
            some = front[start : start + step, None]
            apart = (low[some] > high[back]) | (high[some] < low[back])
            near = ~apart.any(axis=2) & (facets.cell[some] != facets.cell[back]) & (some < back)
            off = np.abs(np.einsum("ijk,ijk->ij", origin[back] - origin[some], normal[some]))
            i, j = np.nonzero(near & (off <= 4 * reach))
            pairs.append(np.stack([some[i, 0], back[j]], axis=1))
    rows = np.concatenate(pairs)
    order = np.lexsort((rows[:, 1], rows[:, 0]))
    for front, back in rows[order].tolist():
        yield front, back


def _opposites(
    origin: FloatArray, normal: FloatArray, reach: float
) -> Iterator[tuple[LongArray, LongArray]]:
    """Yield groups of facets (front, back) whose planes are one and whose normals are opposite.

    Values that differ by less than a gap are never parted, wherever they lie.
    """
    count = len(normal)
    offset = np.einsum("ij,ij->i", origin, normal)
    keys = np.column_stack([normal, offset])
    keys = np.concatenate([keys, -keys])  # every facet, and every facet turned over
    group = np.zeros(2 * count, np.int64)
    reaches = float(np.abs(origin).max(initial=0.0))
    gaps = (_TILT, _TILT, _TILT, 8 * reach + 2 * _TILT * reaches)
    for column, gap in enumerate(gaps):
        order = np.lexsort((keys[:, column], group))
        step = np.diff(keys[order, column]) > gap
        step |= np.diff(group[order]) > 0
        group[order] = np.concatenate([[0], np.cumsum(step)])
    order = np.argsort(group, kind="stable")
    for members in np.split(order, np.flatnonzero(np.diff(group[order])) + 1):
        front, back = members[members < count], members[members >= count] - count
        if len(front) and len(back):
            yield front, back


def _clipped(
    facets: Facets, axes: Axes, front: int, back: int, places: Places, reach: float
) -> tuple[int, ...]:
    """Return the loop of what two convex facets have in common, () for nothing with an area."""
    polygon = [places.points[i] for i in facets.loop(front)]
    other = [places.points[i] for i in reversed(facets.loop(back))]
    outline = [flat(p, axes) for p in other]
    for (ax, ay), (bx, by) in zip(outline, [*outline[1:], outline[0]]):
        length = ((bx - ax) ** 2 + (by - ay) ** 2) ** 0.5
        if length <= reach:
            continue
        nx, ny = (ay - by) / length, (bx - ax) / length
        polygon = _cut(polygon, axes, nx, ny, nx * ax + ny * ay, reach)
        if len(polygon) < 3:
            return ()
    if is_thin([flat(p, axes) for p in polygon], reach):
        return ()
    loop = [places.at(p) for p in polygon]
    loop = [i for i, before in zip(loop, [loop[-1], *loop[:-1]]) if i != before]
    return tuple(loop) if len(set(loop)) == len(loop) > 2 else ()


def axes_of(normal: FloatArray) -> list[Axes]:
    """Return for each unit normal two unit vectors (u, v) with u x v along it."""
    u = np.cross(normal, np.eye(3)[np.argmin(np.abs(normal), axis=1)])
    u /= np.linalg.norm(u, axis=1)[:, None]
    rows = np.concatenate([u, np.cross(normal, u)], axis=1).tolist()
    return [((a, b, c), (d, e, f)) for a, b, c, d, e, f in rows]


def flat(point: Corner, axes: Axes) -> tuple[float, float]:
    (ux, uy, uz), (vx, vy, vz) = axes
    x, y, z = point
    return ux * x + uy * y + uz * z, vx * x + vy * y + vz * z


def _cut(
    polygon: Sequence[Corner], axes: Axes, nx: float, ny: float, level: float,
    reach: float,
) -> list[Corner]:  # fmt: skip
    """Return the part of a convex polygon with nx u + ny v >= level; near points are on it."""
    heights = []
    for p in polygon:
        u, v = flat(p, axes)
        height = nx * u + ny * v - level
        heights.append(0.0 if abs(height) <= reach else height)
    out = []
    for i, p in enumerate(polygon):
        q, here, there = polygon[i - 1], heights[i], heights[i - 1]
        if here * there < 0:
            t = there / (there - here)
            x, y, z = (a + t * (b - a) for a, b in zip(q, p))
            out.append((x, y, z))
        if here >= 0:
            out.append(p)
    return out


def is_thin(loop: Sequence[tuple[float, float]], reach: float) -> bool:
    """Whether a loop is nowhere wider than the reach, or so."""
    area = border = 0.0
    for (ax, ay), (bx, by) in zip(loop, [*loop[1:], loop[0]]):
        area += (ax - loop[0][0]) * (by - loop[0][1]) - (bx - loop[0][0]) * (ay - loop[0][1])
        border += ((bx - ax) ** 2 + (by - ay) ** 2) ** 0.5
    return area <= 2 * reach * border
