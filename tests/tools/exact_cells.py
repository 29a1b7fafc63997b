# SPDX-License-Identifier: LGPL-2.1-or-later
"""Proves in exact integers that convex cells partition a solid.

The proof. Every cell is a closed convex polyhedron of positive volume. Write the boundaries of
all cells, minus the solid's, as oriented polygons: the cells cover the solid exactly once (up to
sets without volume) if and only if these polygons cancel in every plane, for a function of compact
support that is constant where it has no boundary is zero. Polygons in a plane cancel if and only
if their directed edges do on every line, and these if and only if their ends do at every point.
So it suffices to count the signed flags (plane, line, point); no facet needs to match another.
"""

from __future__ import annotations

import itertools
import math
from collections.abc import Iterable, Sequence
from fractions import Fraction

import numpy as np
import numpy.typing as npt

# Homogeneous (x, y, z, w) with w > 0.
Point = tuple[int, int, int, int]
Plane = tuple[int, int, int, int]
Key = tuple[int, ...]


class NotAPartition(AssertionError):
    """What is wrong with the cells, in words."""


def require(holds: bool, message: str) -> None:
    if not holds:
        raise NotAPartition(message)


def primitive(values: Iterable[int]) -> Key:
    """Divide by the greatest common divisor."""
    row = tuple(values)
    divisor = math.gcd(*row)
    return tuple(v // divisor for v in row) if divisor > 1 else row


def unsigned(values: Iterable[int]) -> Key:
    """Primitive with the first non-zero number positive: one key for both orientations."""
    row = primitive(values)
    lead = next((v for v in row if v), 0)
    return tuple(-v for v in row) if lead < 0 else row


def canonical(point: Sequence[int]) -> Point:
    x, y, z, w = primitive(point)
    return (x, y, z, w) if w > 0 else (-x, -y, -z, -w)


def from_fractions(point: Iterable[Fraction | int]) -> Point:
    row = [Fraction(c) for c in point]
    w = math.lcm(*(c.denominator for c in row))
    return canonical([*(int(c * w) for c in row), w])


def line_key(p: Point, q: Point) -> Key:
    """The line through two points, by its Plücker coordinates."""
    return unsigned(p[i] * q[j] - p[j] * q[i] for i in range(4) for j in range(i))


def plane_through(p: Point, q: Point, r: Point) -> Plane:
    """Primitive plane whose normal is (q - p) x (r - p); all zero for collinear points."""
    xy, xz, xw = (q[0] * r[j] - q[j] * r[0] for j in (1, 2, 3))
    yz, yw, zw = q[1] * r[2] - q[2] * r[1], q[1] * r[3] - q[3] * r[1], q[2] * r[3] - q[3] * r[2]
    return primitive(  # type: ignore[return-value]
        (
            p[1] * zw - p[2] * yw + p[3] * yz,
            -(p[0] * zw - p[2] * xw + p[3] * xz),
            p[0] * yw - p[1] * xw + p[3] * xy,
            -(p[0] * yz - p[1] * xz + p[2] * xy),
        )
    )


def value(plane: Plane, point: Point) -> int:
    """Of the sign of the side: positive in front of the plane."""
    return sum(a * b for a, b in zip(plane, point))


class FlagSum:
    """The signed count of (plane, line, point) over the edges of oriented facets."""

    def __init__(self) -> None:
        self.counts: dict[tuple[Key, Key, Point], int] = {}
        self.lines: dict[tuple[Point, Point], Key] = {}

    def add(self, plane: Plane, cycle: Sequence[Point], weight: int) -> None:
        key = unsigned(plane)
        for p, q in zip(cycle, [*cycle[1:], cycle[0]]):
            pair = (p, q) if p < q else (q, p)
            line = self.lines.get(pair)
            if line is None:
                line = self.lines[pair] = line_key(*pair)
            for point, sign in ((q, weight), (p, -weight)):
                flag = (key, line, point)
                count = self.counts.get(flag, 0) + sign
                if count:
                    self.counts[flag] = count
                else:
                    del self.counts[flag]


def facet_plane(cycle: Sequence[Point]) -> Plane:
    """The plane of a convex polygon, from its first corner that is one."""
    count = len(cycle)
    for i in range(count):
        plane = plane_through(cycle[i], cycle[(i + 1) % count], cycle[(i + 2) % count])
        if any(plane[:3]):
            return plane
    raise NotAPartition("a facet has no area")


def check_cell(name: str, facets: Sequence[Sequence[Point]]) -> list[Plane]:
    """Prove one cell closed and convex with volume; returns the planes of its facets.

    Facets in supporting planes of the hull of the vertices lie on its boundary, facing outward;
    where no two share a plane (check_one_facet_per_plane) they cover it evenly, so just once.
    """
    require(len(facets) >= 4, f"{name} has {len(facets)} facets")
    edges: set[tuple[Point, Point]] = set()
    for cycle in facets:
        require(len(cycle) >= 3, f"{name}: a facet has {len(cycle)} vertices")
        require(len(set(cycle)) == len(cycle), f"{name}: a facet repeats a vertex")
        for edge in zip(cycle, [*cycle[1:], cycle[0]]):
            require(edge not in edges, f"{name}: a directed edge occurs twice")
            edges.add(edge)
    require(all((q, p) in edges for p, q in edges), f"{name} is not closed")
    vertices = {p for cycle in facets for p in cycle}
    euler = len(vertices) - len(edges) // 2 + len(facets)
    require(euler == 2, f"{name} has Euler number {euler}")
    planes = [facet_plane(cycle) for cycle in facets]
    for plane, cycle in zip(planes, facets):
        on = set(cycle)
        for p in vertices:
            side = value(plane, p)
            require(side <= 0, f"{name} is not convex: a vertex is in front of a facet")
            require(side == 0 or p not in on, f"{name}: a facet is not planar")
        require(any(value(plane, p) < 0 for p in vertices), f"{name} is flat")
    return planes


def check_one_facet_per_plane(name: str, planes: Sequence[Plane]) -> None:
    require(len(set(planes)) == len(planes), f"{name} has two facets in one plane")


def volume6(facets: Sequence[Sequence[Point]]) -> Fraction:
    """Six times the volume of a closed cell."""
    total = Fraction(0)
    for cycle in facets:
        a = cycle[0]
        for b, c in itertools.pairwise(cycle[1:]):
            det = (
                a[0] * (b[1] * c[2] - b[2] * c[1])
                + a[1] * (b[2] * c[0] - b[0] * c[2])
                + a[2] * (b[0] * c[1] - b[1] * c[0])
            )
            total += Fraction(det, a[3] * b[3] * c[3])
    return total


def verify_partition(
    vertices: npt.ArrayLike,
    triangles: npt.ArrayLike,
    points: Sequence[Point],
    cells: Sequence[Sequence[Sequence[int]]],
) -> None:
    """Prove that the cells are convex and partition the solid.

    Parameters
    ----------
    vertices : (n, 3) int or float
        Of the solid; floats are taken as the exact binary fractions they are.
    triangles : (m, 3) int
    points : sequence of (x, y, z, w)
        Exact points of the cells, in the same coordinates.
    cells : sequence of cells
        Each a list of facets, each a cycle of indices into `points`, outward.

    Raises
    ------
    NotAPartition
        Naming the first cell or plane that fails.
    """
    places = [canonical(p) for p in points]
    corners = [from_fractions(map(Fraction, row)) for row in np.asarray(vertices).tolist()]
    flags = FlagSum()
    enclosed = Fraction(0)
    total = Fraction(0)
    for a, b, c in np.asarray(triangles).tolist():
        triangle = (corners[a], corners[b], corners[c])
        flags.add(plane_through(*triangle), triangle, -1)
        enclosed += volume6([triangle])
    for i, cell in enumerate(cells):
        facets = [[places[v] for v in cycle] for cycle in cell]
        planes = check_cell(f"cell {i}", facets)
        check_one_facet_per_plane(f"cell {i}", planes)
        for plane, cycle in zip(planes, facets):
            flags.add(plane, cycle, 1)
        total += volume6(facets)
    require(total == enclosed, f"volumes: cells {float(total) / 6}, solid {float(enclosed) / 6}")
    if flags.counts:
        plane = next(iter(flags.counts))[0]
        raise NotAPartition(f"facets in the plane {plane} do not cancel")
