# SPDX-License-Identifier: LGPL-2.1-or-later
"""Triangulation and guards of planar polygons, judged by Python's fractions."""

from __future__ import annotations

from collections import Counter
from fractions import Fraction
from importlib import import_module
from itertools import combinations
from typing import Any

import numpy as np
import pytest

kernel: Any = import_module("_tetra_kernel")

Exact = list[tuple[Fraction, Fraction]]


def ids(*loops: Any) -> list[np.ndarray]:
    """Return loops as the kernel wants them."""
    return [np.ascontiguousarray(loop, np.int32) for loop in loops]


def exactly(points: Any) -> Exact:
    """Return the very numbers that the doubles are."""
    return [(Fraction(float(x)), Fraction(float(y))) for x, y in points]


def doubled_area(p: Exact, a: int, b: int, c: int) -> Fraction:
    """Return twice the signed area of a triangle."""
    left = (p[b][0] - p[a][0]) * (p[c][1] - p[a][1])
    return left - (p[b][1] - p[a][1]) * (p[c][0] - p[a][0])


def sign(value: Fraction) -> int:
    """Return -1, 0 or 1."""
    return (value > 0) - (value < 0)


def edges_of(loops: list[np.ndarray]) -> list[tuple[int, int]]:
    """Return the edges of the loops in their order."""
    return [(int(a), int(b)) for loop in loops for a, b in zip(loop, np.roll(loop, -1))]


def clash(p: Exact, first: tuple[int, int], second: tuple[int, int]) -> bool:
    """Return whether two edges have more in common than one corner."""
    if set(first) == set(second):
        return True

    def inside(x: int, edge: tuple[int, int]) -> bool:
        a, b = edge
        if x in edge or doubled_area(p, a, b, x) != 0:
            return False
        return min(p[a], p[b]) <= p[x] <= max(p[a], p[b])

    ends = [(x, second) for x in first] + [(x, first) for x in second]
    if any(inside(x, edge) for x, edge in ends):
        return True
    sides = [sign(doubled_area(p, *first, x)) for x in second]
    back = [sign(doubled_area(p, *second, x)) for x in first]
    return sides[0] * sides[1] < 0 and back[0] * back[1] < 0


def judge(points: Any, loops: list[np.ndarray]) -> np.ndarray:
    """Triangulate, check against the boundary, return the triangles.

    Positive triangles that leave exactly the edges of the loops open cover the region once.
    """
    exact = exactly(points)
    triangles = kernel.triangulate_polygon(points, loops)
    assert triangles.dtype == np.int32
    assert all(doubled_area(exact, *t) > 0 for t in triangles.tolist())
    sides = Counter((t[k], t[(k + 1) % 3]) for t in triangles.tolist() for k in range(3))
    assert max(sides.values()) == 1
    open_sides = {frozenset(s) for s in sides if s[::-1] not in sides}
    assert open_sides == {frozenset(e) for e in edges_of(loops)}
    return np.asarray(triangles)


def assert_guarded(points: Any, loops: list[np.ndarray], holes: int) -> None:
    """Every triangle has a guard, and there are no more than the bound allows."""
    triangles = judge(points, loops)
    guards = kernel.place_guards(points, loops)
    assert guards.dtype == np.int32
    assert np.isin(triangles, guards).any(axis=1).all()
    assert 3 * len(guards) <= sum(map(len, loops)) + 2 * holes


def test_square_with_a_hole_in_any_direction() -> None:
    points = np.array(
        [[0, 0], [3, 0], [3, 3], [0, 3], [1, 1], [2, 1], [2, 2], [1, 2]], dtype=np.float64
    )
    for outer in ([0, 1, 2, 3], [3, 2, 1, 0]):
        for hole in ([4, 5, 6, 7], [7, 6, 5, 4]):
            loops = ids(outer, hole)
            assert len(judge(points, loops)) == 8
            assert_guarded(points, loops, 1)


@pytest.mark.parametrize("seed", range(40))
def test_stars_of_doubles(seed: int) -> None:
    random = np.random.default_rng(seed)
    n = int(random.integers(3, 120))
    angles = np.sort(random.uniform(0, 2 * np.pi, n))
    angles[:3] = [0.1, 2.2, 4.3]
    angles = np.unique(angles)
    radius = np.exp(random.uniform(-3, 3, len(angles)))
    scale = 2.0 ** random.integers(-300, 300)
    points = np.stack([np.cos(angles), np.sin(angles)], axis=1) * radius[:, None] * scale
    loops = ids(np.arange(len(points)))
    assert len(judge(points, loops)) == len(points) - 2
    assert_guarded(points, loops, 0)


@pytest.mark.parametrize("seed", range(40))
def test_points_that_are_nearly_on_a_line(seed: int) -> None:
    """The lower side is a line rounded to doubles: some turns are left, some right, some none."""
    random = np.random.default_rng(seed)
    n = 60
    x = np.sort(random.uniform(0.1, 1.0, n))
    x = np.unique(np.concatenate([x, np.linspace(0.2, 0.9, 8)]))
    points = np.concatenate([np.stack([x, x / 3.0 + 0.1], axis=1), [[0.5, 2.0]]])
    loops = ids(np.arange(len(points)))
    assert len(judge(points, loops)) == len(points) - 2


@pytest.mark.parametrize("seed", range(150))
def test_random_loops_are_refused_exactly_when_edges_clash(seed: int) -> None:
    random = np.random.default_rng(seed)
    n = int(random.integers(3, 8))
    grid = random.permutation(36)[:n]
    points = np.stack([grid % 6, grid // 6], axis=1) * 0.1  # collinear only as far as 0.1 k is
    loops = ids(random.permutation(n))
    exact = exactly(points)
    edges = edges_of(loops)
    bad = {pair for pair in combinations(range(n), 2) if clash(exact, *(edges[k] for k in pair))}
    if not bad:
        assert len(judge(points, loops)) == n - 2
        return
    with pytest.raises(kernel.InvalidPolygon) as caught:
        kernel.triangulate_polygon(points, loops)
    assert isinstance(caught.value, ValueError)
    assert tuple(corner for _, corner in caught.value.edges) in bad


def test_errors_name_what_is_at_fault() -> None:
    points = np.array([[0, 0], [1, 0], [1, 1], [0, 1], [np.nan, 0], [1, 0]], dtype=np.float64)

    def fault(*loops: Any, rows: int = 4) -> Any:
        with pytest.raises(kernel.InvalidPolygon) as caught:
            kernel.triangulate_polygon(np.ascontiguousarray(points[:rows]), ids(*loops))
        return caught.value

    assert fault([0, 1, 4]).points == [4]  # no such point
    assert fault([0, 1, -1]).points == [-1]
    assert fault([0, 1, 2, 3], rows=5).points == [4]  # not finite
    assert fault([0, 1]).points == [0, 1]
    assert fault([0, 1, 3, 2]).edges == [(0, 1), (0, 3)]
    assert fault([0, 1, 1, 2]).edges == [(0, 1)]
    points[4] = [2, 2]
    assert sorted(fault([0, 1, 5, 2], rows=6).points) == [1, 5]


def test_no_loops_give_no_triangles() -> None:
    points = np.zeros((0, 2))
    assert kernel.triangulate_polygon(points, []).shape == (0, 3)
    assert kernel.place_guards(points, []).shape == (0,)
