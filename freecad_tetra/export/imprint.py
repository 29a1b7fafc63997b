# SPDX-License-Identifier: LGPL-2.1-or-later
"""Facets of convex cells are divided where neighbours meet, so that these share whole faces.

A cell stays closed whatever the geometry says: all its facets divide an edge at the same
points, and the parts and the rest of a facet have its border as their sum. A facet whose rest
is a sliver shares nothing.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from freecad_tetra.export import overlay
from freecad_tetra.export.overlay import Corner, Facets, Part, Places
from freecad_tetra.model import FloatArray, LongArray

Loop = tuple[int, ...]


@dataclass(frozen=True)
class Divided:
    """Facets that neighbours share whole.

    Attributes
    ----------
    points : (p, 3) float64
        Those given first.
    faces : list of (facet, loops)
        The first loop runs round the face, counter-clockwise seen from outside, the others
        round its holes; in the order of the facets.
    """

    points: FloatArray
    faces: list[tuple[int, list[Loop]]]


def divided(
    facets: Facets, origin: FloatArray, normal: FloatArray, reach: float, alone: LongArray
) -> Divided:
    """Divide facets where they face each other; O(n log n) for few crossings.

    Parameters
    ----------
    facets : Facets
    origin, normal : (F, 3) float64
        Planes, normals of length 1 outward.
    reach : float
        Distance under which things coincide.
    alone : (k,) int64
        Cells that are left as they are.
    """
    places = Places(facets.points, np.unique(facets.corners), reach)
    lonely = np.isin(facets.cell, alone)
    parts = overlay.common_parts(facets, origin, normal, places, reach)
    parts = [p for p in parts if not (lonely[p.front] or lonely[p.back])]
    loops = [facets.loop(f) for f in range(len(facets.cell))]
    splits = _splits([*loops, *(p.loop for p in parts)], np.array(places.points), reach)
    _spare_slivers(loops, facets.cell.tolist(), splits)
    for facet in np.flatnonzero(lonely).tolist():
        for a, b in zip(loops[facet], [*loops[facet][1:], loops[facet][0]]):
            splits.pop((min(a, b), max(a, b)), None)
    work = _Facets(places.points, normal, loops, parts, splits, reach)
    return Divided(np.array(places.points), work.faces())


class _Facets:
    """Divides all facets, and takes parts back that leave slivers."""

    def __init__(
        self, points: list[Corner], normal: FloatArray, loops: list[list[int]],
        parts: list[Part], splits: dict[tuple[int, int], list[int]], reach: float,
    ) -> None:  # fmt: skip
        self._points = points
        self._axes = overlay.axes_of(normal)
        self._loops = loops
        self._parts = parts
        self._splits = splits
        self._reach = reach
        self._of_facet: dict[int, list[int]] = {}
        for i, part in enumerate(parts):
            for facet in (part.front, part.back):
                self._of_facet.setdefault(facet, []).append(i)

    def faces(self) -> list[tuple[int, list[Loop]]]:
        """Return the faces of all facets, in their order."""
        alive = [True] * len(self._parts)
        rest: dict[int, list[list[Loop]]] = {}
        todo = sorted(self._of_facet)
        while todo:
            again: set[int] = set()
            for facet in todo:
                mine = [i for i in self._of_facet[facet] if alive[i]]
                found = self._rest(facet, mine)
                if found is None:
                    for i in mine:
                        alive[i] = False
                        again |= {self._parts[i].front, self._parts[i].back}
                else:
                    rest[facet] = found
            todo = sorted(again)
        out: list[tuple[int, list[Loop]]] = []
        for facet, loop in enumerate(self._loops):
            shared = [self._parts[i] for i in self._of_facet.get(facet, ()) if alive[i]]
            own = rest[facet] if shared else [[self._divided(loop)]]
            out += [(facet, [self._side(part, facet)]) for part in shared]
            out += [(facet, loops) for loops in own]
        return out

    def _side(self, part: Part, facet: int) -> Loop:
        loop = self._divided(part.loop)
        return loop if facet == part.front else loop[::-1]

    def _divided(self, loop: Sequence[int]) -> Loop:
        """Return a loop with the points that lie inside its edges."""
        out: list[int] = []
        for a, b in zip(loop, [*loop[1:], loop[0]]):
            out.append(a)
            inner = self._splits.get((min(a, b), max(a, b)), ())
            out.extend(inner if a < b else reversed(inner))
        return tuple(out)

    def _rest(self, facet: int, parts: list[int]) -> list[list[Loop]] | None:
        """Return what the parts of a facet leave of it, None when that has slivers."""
        left: dict[tuple[int, int], None] = {}
        taken = [self._side(self._parts[i], facet)[::-1] for i in parts]
        if not all(_add(left, loop) for loop in (self._divided(self._loops[facet]), *taken)):
            return None
        if not left:
            return []
        axes = self._axes[facet]
        corners = {v for edge in left for v in edge}
        flat = {v: overlay.flat(self._points[v], axes) for v in corners}
        loops = _traced(list(left), flat)
        outer, holes = [], []
        for loop in loops:
            ring = [flat[v] for v in loop]
            if not overlay.is_thin(ring, self._reach):
                outer.append([loop])
            elif not overlay.is_thin(ring[::-1], self._reach):
                holes.append(loop)
            else:
                return None
        return _with_holes(outer, holes, flat)


def _add(left: dict[tuple[int, int], None], loop: Loop) -> bool:
    """Add directed edges, one and its opposite being nothing; False when one is there twice."""
    for a, b in zip(loop, [*loop[1:], loop[0]]):
        if (b, a) in left:
            del left[b, a]
        elif (a, b) in left:
            return False
        else:
            left[a, b] = None
    return True


def _traced(edges: list[tuple[int, int]], flat: dict[int, tuple[float, float]]) -> list[Loop]:
    """Return the loops of directed edges with the area on their left; where loops touch, each
    goes round its own corner of the area."""
    onward: dict[int, list[int]] = {}
    for a, b in edges:
        onward.setdefault(a, []).append(b)
    loops = []
    for a, b in edges:
        if b not in onward.get(a, ()):
            continue
        loop = [a]
        onward[a].remove(b)
        while b != loop[0]:
            before, choice = loop[-1], onward[b]
            loop.append(b)
            angles = [_clockwise(flat, b, before, c) for c in choice]
            b = choice.pop(angles.index(min(angles)))
        loops.append(tuple(loop))
    return loops


def _clockwise(flat: dict[int, tuple[float, float]], at: int, start: int, stop: int) -> float:
    """Return the angle that turns at -> start clockwise into at -> stop, above 0."""
    x, y = flat[at]
    angles = [math.atan2(flat[v][1] - y, flat[v][0] - x) for v in (start, stop)]
    return (angles[0] - angles[1]) % (2 * math.pi) or 2 * math.pi


def _with_holes(
    outer: list[list[Loop]], holes: list[Loop], flat: dict[int, tuple[float, float]]
) -> list[list[Loop]] | None:
    """Add every hole to the smallest loop around it; None when there is no such."""
    for hole in holes:
        (ax, ay), (bx, by) = flat[hole[0]], flat[hole[1]]
        middle = ((ax + bx) / 2, (ay + by) / 2)
        around = [o for o in outer if _is_inside(middle, [flat[v] for v in o[0]])]
        if not around:
            return None
        min(around, key=lambda o: _area([flat[v] for v in o[0]])).append(hole)
    return outer


def _is_inside(point: tuple[float, float], loop: Sequence[tuple[float, float]]) -> bool:
    x, y = point
    inside = False
    for (ax, ay), (bx, by) in zip(loop, [*loop[1:], loop[0]]):
        if (ay > y) != (by > y) and x < ax + (y - ay) * (bx - ax) / (by - ay):
            inside = not inside
    return inside


def _area(loop: Sequence[tuple[float, float]]) -> float:
    twice = sum(ax * by - bx * ay for (ax, ay), (bx, by) in zip(loop, [*loop[1:], loop[0]]))
    return twice / 2


def _splits(
    loops: Sequence[Sequence[int]], points: FloatArray, reach: float
) -> dict[tuple[int, int], list[int]]:
    """Return for each edge (low, high) the points inside it, in that order."""
    sizes = np.array([len(loop) for loop in loops])
    if not len(sizes):
        return {}
    flat = np.concatenate([np.asarray(loop, np.int64) for loop in loops])
    starts = np.concatenate([[0], np.cumsum(sizes)])
    after = np.arange(1, len(flat) + 1)
    after[starts[1:] - 1] = starts[:-1]
    edges = np.unique(np.sort(np.stack([flat, flat[after]], axis=1), axis=1), axis=0)
    used = np.unique(flat)
    segment, point = near_segments(points[edges[:, 0]], points[edges[:, 1]], points[used])
    start, along = points[edges[segment, 0]], points[edges[segment, 1]] - points[edges[segment, 0]]
    length = np.linalg.norm(along, axis=1)
    off = points[used[point]] - start
    t = np.einsum("ij,ij->i", off, along) / length
    distance = np.linalg.norm(off - (t / length)[:, None] * along, axis=1)
    inside = np.flatnonzero((distance <= reach) & (t > reach) & (t < length - reach))
    order = inside[np.lexsort((point[inside], t[inside], segment[inside]))]
    out: dict[tuple[int, int], list[int]] = {}
    for s, p in zip(segment[order].tolist(), used[point[order]].tolist()):
        inner = out.setdefault((int(edges[s, 0]), int(edges[s, 1])), [])
        if not inner or inner[-1] != p:
            inner.append(p)
    return out


def _spare_slivers(
    loops: Sequence[Sequence[int]], cells: Sequence[int], splits: dict[tuple[int, int], list[int]]
) -> None:
    """Divide no edge at another corner of its own cell, which would come there twice."""
    corners: dict[int, set[int]] = {}
    for loop, cell in zip(loops, cells):
        corners.setdefault(cell, set()).update(loop)
    for loop, cell in zip(loops, cells):
        own = corners[cell]
        for a, b in zip(loop, [*loop[1:], loop[0]]):
            key = (min(a, b), max(a, b))
            inner = splits.get(key)
            if inner and not own.isdisjoint(inner):
                splits[key] = [p for p in inner if p not in own]


def near_segments(
    start: FloatArray, stop: FloatArray, points: FloatArray
) -> tuple[LongArray, LongArray]:
    """Return pairs (segment, point) in which the point may lie on the segment; some twice.

    Points are sorted into cubes; along each segment lie samples not farther apart than a cube,
    and what is on the segment is in a cube around one of them.
    """
    low, high = points.min(axis=0), points.max(axis=0)
    lengths = np.linalg.norm(stop - start, axis=1)
    size = max(float(np.median(lengths)), float((high - low).max()) / 200, 1e-30)
    key = _cubes(points, low, size)
    order = np.argsort(key, kind="stable")
    key = key[order]
    samples = np.ceil(lengths / size).astype(np.int64) + 1
    segment = np.repeat(np.arange(len(start)), samples)
    step = np.arange(len(segment)) - np.repeat(np.cumsum(samples) - samples, samples)
    share = step / np.maximum(samples - 1, 1)[segment]
    places = start[segment] + share[:, None] * (stop - start)[segment]
    found = []
    for shift in np.stack(np.meshgrid(*[[-1, 0, 1]] * 3), axis=-1).reshape(-1, 3):
        wanted = _cubes(places + shift * size, low, size)
        first, last = np.searchsorted(key, wanted), np.searchsorted(key, wanted, side="right")
        many = last - first
        which = np.repeat(np.arange(len(wanted)), many)
        inner = np.arange(len(which)) - np.repeat(np.cumsum(many) - many, many)
        found.append(np.stack([segment[which], order[first[which] + inner]]))
    segments, near = np.concatenate(found, axis=1)
    return segments, near


def _cubes(places: FloatArray, low: FloatArray, size: float) -> LongArray:
    i, j, k = (np.floor((places - low) / size).astype(np.int64) + 1).T
    return (i * 1_000_003 + j) * 1_000_003 + k
