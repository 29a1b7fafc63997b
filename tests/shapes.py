# SPDX-License-Identifier: LGPL-2.1-or-later
"""Named solids with exact volumes, built from boxes on a grid and from prisms.

Every builder returns a Shape; coordinates are small integers unless the shape is turned.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction

import numpy as np

Box = tuple[tuple[int, int, int], tuple[int, int, int]]


@dataclass(frozen=True)
class Shape:
    """A closed surface, outward, with what is known about it.

    `volume` is exact for the coordinates as built; `pieces` is the least number of convex
    cells, None when it is not known.
    """

    vertices: np.ndarray
    triangles: np.ndarray
    volume: Fraction
    genus: int = 0
    pieces: int | None = None

    def moved(self, matrix: np.ndarray) -> Shape:
        """Return the shape turned by a rotation matrix (rounded to doubles)."""
        return replace(self, vertices=self.vertices @ matrix.T)


def exact_volume(vertices: np.ndarray, triangles: np.ndarray) -> Fraction:
    """Return the enclosed volume of the doubles as they are, exactly."""
    points = [[Fraction(float(x)) for x in row] for row in vertices]
    total = Fraction(0)
    for i, j, k in triangles.tolist():
        (a, b, c), (d, e, f), (g, h, m) = points[i], points[j], points[k]
        total += a * (e * m - f * h) - b * (d * m - f * g) + c * (d * h - e * g)
    return total / 6


def rotation(seed: int) -> np.ndarray:
    """Return a rotation by odd angles, (3, 3)."""
    quaternion = np.random.default_rng(seed).normal(size=4)
    w, x, y, z = quaternion / np.linalg.norm(quaternion)
    return np.array(
        [
            [1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
            [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
            [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)],
        ]
    )


def boxes(
    inside: Callable[[float, float, float], bool], cuts: Sequence[Iterable[int]]
) -> tuple[np.ndarray, np.ndarray]:
    """Return the boundary of all grid boxes whose centre is `inside`.

    Parameters
    ----------
    inside : callable
        ``inside(x, y, z)`` of a centre.
    cuts : three sequences of int
        Grid planes per axis.
    """
    xs, ys, zs = (sorted(set(c)) for c in cuts)
    shape = (len(xs) - 1, len(ys) - 1, len(zs) - 1)
    full = np.zeros(tuple(n + 2 for n in shape), bool)
    for i, j, k in np.ndindex(shape):
        centre = [(c[n] + c[n + 1]) / 2 for c, n in ((xs, i), (ys, j), (zs, k))]
        full[i + 1, j + 1, k + 1] = inside(*centre)
    ids: dict[tuple[int, ...], int] = {}
    rows: list[tuple[int, ...]] = []

    def vertex(grid: Sequence[int]) -> int:
        return ids.setdefault(tuple(int(g) for g in grid), len(ids))

    for cell in np.argwhere(full):
        for axis in range(3):
            for side in (0, 1):
                beside = cell.copy()
                beside[axis] += 2 * side - 1
                if full[tuple(beside)]:
                    continue
                quad = []
                for du, dv in ((0, 0), (1, 0), (1, 1), (0, 1)):
                    corner = cell - 1
                    corner[axis] += side
                    corner[(axis + 1) % 3] += du
                    corner[(axis + 2) % 3] += dv
                    quad.append(vertex(corner))
                if side == 0:
                    quad.reverse()
                rows += [(quad[0], quad[1], quad[2]), (quad[0], quad[2], quad[3])]
    points = [(xs[i], ys[j], zs[k]) for i, j, k in ids]
    return np.array(points, float), np.array(rows, np.int32)


def _solid(
    inside: Callable[[float, float, float], bool],
    cuts: Sequence[Iterable[int]],
    volume: int,
    genus: int = 0,
    pieces: int | None = None,
) -> Shape:
    vertices, triangles = boxes(inside, cuts)
    return Shape(vertices, triangles, Fraction(volume), genus, pieces)


def cube(size: int = 2) -> Shape:
    """A cube at the origin."""
    return _solid(lambda *_: True, [(0, size)] * 3, size**3, pieces=1)


def l_prism() -> Shape:
    """One notch: two pieces."""
    return _solid(lambda x, y, z: x < 1 or y < 1, [(0, 1, 3), (0, 1, 3), (0, 2)], 10, pieces=2)


def boss_on_a_plate() -> Shape:
    """A ring of four notches in one plane: two pieces."""
    return _solid(
        lambda x, y, z: z < 1 or (2 < x < 4 and 2 < y < 4),
        [(0, 2, 4, 6), (0, 2, 4, 6), (0, 1, 3)],
        36 + 8,
        pieces=2,
    )


def cube_with_cavity() -> Shape:
    """A cubic hole that does not reach the surface."""
    return _solid(
        lambda x, y, z: not (1 < x < 2 and 1 < y < 2 and 1 < z < 2), [(0, 1, 2, 3)] * 3, 26
    )


def square_frame() -> Shape:
    """A square ring, genus 1."""
    return _solid(
        lambda x, y, z: not (1 < x < 3 and 1 < y < 3),
        [(0, 1, 3, 4), (0, 1, 3, 4), (0, 1)],
        12,
        genus=1,
    )


def cubes_touching_in_an_edge() -> Shape:
    """Bajaj-Dey type 2: an edge with four facets."""
    return _solid(lambda x, y, z: (x < 1) == (y < 1), [(0, 1, 2), (0, 1, 2), (0, 1)], 2, pieces=2)


def cubes_touching_in_a_vertex() -> Shape:
    """Bajaj-Dey type 3: a vertex where two cones meet."""
    return _solid(lambda x, y, z: (x < 1) == (y < 1) == (z < 1), [(0, 1, 2)] * 3, 2, pieces=2)


def vertex_on_a_face() -> Shape:
    """Bajaj-Dey type 1: the tip of a tetrahedron stands inside a face of a cube."""
    base = cube(4)
    tip = np.array([[1, 1, 4], [1, 3, 6], [3, 1, 6], [1, 1, 7]], float)
    rows = np.array([[0, 1, 2], [0, 3, 1], [0, 2, 3], [1, 3, 2]])
    if exact_volume(tip, rows) < 0:
        rows = rows[:, ::-1]
    vertices = np.vstack([base.vertices, tip])
    triangles = np.vstack([base.triangles, rows + len(base.vertices)]).astype(np.int32)
    return Shape(vertices, triangles, exact_volume(vertices, triangles), pieces=2)


def staircase(steps: int = 8) -> Shape:
    """Steps around a square column, each one higher than the last."""
    ring = [(0, 0), (1, 0), (2, 0), (2, 1), (2, 2), (1, 2), (0, 2), (0, 1)][:steps]

    def inside(x: float, y: float, z: float) -> bool:
        place = (int(x), int(y))
        if place == (1, 1):
            return True
        return place in ring and ring.index(place) <= z < ring.index(place) + 2

    return _solid(inside, [range(4), range(4), range(steps + 2)], 3 * steps + 1)


def issue_8379() -> Shape:
    """The solid of CGAL issue 8379: CGAL returns a broken piece."""

    def within(p: tuple[float, ...], size: tuple[int, ...]) -> bool:
        return all(abs(a) < s / 2 for a, s in zip(p, size, strict=True))

    def inside(*p: float) -> bool:
        return within(p, (12, 12, 4)) or (within(p, (10, 10, 8)) and not within(p, (8, 8, 10)))

    cut = (-6, -5, -4, 4, 5, 6)
    height = (-4, -2, 2, 4)
    return _solid(inside, [cut, cut, height], 12 * 12 * 4 + 2 * 2 * (100 - 64))


def prism(
    outer: Sequence[Sequence[float]], inner: Sequence[Sequence[float]], height: float
) -> Shape:
    """A ring between two loops of equal length, counter-clockwise, genus 1."""
    n = len(outer)
    flat = [*outer, *inner]
    vertices = np.array([(x, y, z) for z in (0.0, height) for x, y in flat], float)
    rows = []

    def quad(a: int, b: int, c: int, d: int) -> None:
        rows.extend([(a, b, c), (a, c, d)])

    for i in range(n):
        j = (i + 1) % n
        low, top = 0, 2 * n
        quad(low + i, low + j, top + j, top + i)
        quad(low + n + j, low + n + i, top + n + i, top + n + j)
        quad(low + j, low + i, low + n + i, low + n + j)
        quad(top + i, top + j, top + n + j, top + n + i)
    triangles = np.array(rows, np.int32)
    return Shape(vertices, triangles, exact_volume(vertices, triangles), genus=1)


def nut() -> Shape:
    """A hexagonal ring with rounded coordinates: its planes are planar in no grid."""

    def loop(radius: float, turn: float) -> list[tuple[float, float]]:
        angles = [turn + i * np.pi / 3 for i in range(6)]
        return [(radius * np.cos(a), radius * np.sin(a)) for a in angles]

    return prism(loop(10, 0.3), loop(6, 0.3), 5)


def schoenhardt() -> Shape:
    """A twisted prism that no tetrahedra fill without a Steiner point."""
    low = [(10, 0, 0), (-5, 9, 0), (-5, -9, 0)]
    top = [(9, 5, 10), (-9, 5, 10), (0, -10, 10)]
    vertices = np.array(low + top, float)
    rows = [(2, 1, 0), (3, 4, 5)]
    for i in range(3):
        j = (i + 1) % 3
        rows += [(i, j, 3 + j), (i, 3 + j, 3 + i)]
    triangles = np.array(rows, np.int32)
    return Shape(vertices, triangles, exact_volume(vertices, triangles))


NAMED: dict[str, Callable[[], Shape]] = {
    "cube": cube,
    "l_prism": l_prism,
    "boss_on_a_plate": boss_on_a_plate,
    "cube_with_cavity": cube_with_cavity,
    "square_frame": square_frame,
    "cubes_touching_in_an_edge": cubes_touching_in_an_edge,
    "cubes_touching_in_a_vertex": cubes_touching_in_a_vertex,
    "vertex_on_a_face": vertex_on_a_face,
    "staircase": staircase,
    "issue_8379": issue_8379,
    "nut": nut,
    "nut_turned": lambda: nut().moved(rotation(7)),
    "issue_8379_turned": lambda: issue_8379().moved(rotation(3)),
    "schoenhardt": schoenhardt,
}
