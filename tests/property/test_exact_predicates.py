# SPDX-License-Identifier: LGPL-2.1-or-later
"""Orientation signs and planes of grid points against Python's integers, degenerate cases first."""

from __future__ import annotations

import itertools
import math
import random
from fractions import Fraction

import exact_model as model
from exact_model import Vec, flat
from exact_probe import evaluate


def degenerate_fours(rng: random.Random, bits: int) -> list[list[Vec]]:
    """Coincident, collinear, coplanar, and those one grid step off."""
    reach = 2 ** (bits - 2)
    cases = []
    for _ in range(400):
        a, u, v = (
            tuple(rng.randint(-reach, reach) >> rng.randint(0, bits - 3) for _ in range(3))
            for _ in range(3)
        )
        b = tuple(a[i] + u[i] for i in range(3))
        c = tuple(a[i] + v[i] for i in range(3))
        on_line = tuple(a[i] - u[i] for i in range(3))
        on_plane = tuple(a[i] + u[i] - v[i] for i in range(3))
        cases += [
            [a, a, b, c],
            [a, b, b, c],
            [a, b, c, c],
            [a, a, a, a],
            [a, b, on_line, c],
            [a, b, c, on_line],
            [a, b, c, on_plane],
        ]
        for k, step in itertools.product(range(3), (-1, 1)):
            near = tuple(on_plane[i] + (step if i == k else 0) for i in range(3))
            cases.append([a, b, c, near])
    return cases


def four_point_cases(bits: int) -> list[list[Vec]]:
    rng = random.Random(bits)
    corners = model.extreme_points(rng, bits, slack=1)
    some = model.random_points(rng, bits, 400)
    cube = [tuple(s * 2**bits for s in signs) for signs in itertools.product((-1, 1), repeat=3)]
    cases = degenerate_fours(rng, bits)
    cases += [list(four) for four in itertools.product(cube, repeat=4) if rng.random() < 0.25]
    cases += [rng.sample(corners, 4) for _ in range(3000)]
    return cases + [rng.sample(some, 4) for _ in range(3000)]


def test_orient3d_and_its_determinant():
    for bits in (4, 20, 26, 27, 40):
        cases = four_point_cases(bits)
        operands = [flat(case) for case in cases]
        signs, values = evaluate("orient3d", operands), evaluate("det3", operands)
        for case, (sign,), (value,) in zip(cases, signs, values):
            expected = model.det_of_points(*case)
            assert value == expected, case
            assert sign == model.sign(expected), case


def test_orient3d_of_nearly_flat_slivers():
    """Determinants of a few units among products of 120 bits: the filter must not decide."""
    rng = random.Random(7)
    cases = []
    for _ in range(2000):
        a = tuple(rng.randint(-(2**39), 2**39) for _ in range(3))
        u = tuple(rng.randint(-(2**38), 2**38) for _ in range(3))
        v = tuple(c + rng.randint(-1, 1) for c in u)
        w = tuple(c + rng.randint(-1, 1) for c in u)
        cases.append([a, *(tuple(a[i] + d[i] for i in range(3)) for d in (u, v, w))])
    for case, (sign,) in zip(cases, evaluate("orient3d", [flat(c) for c in cases])):
        assert sign == model.sign(model.det_of_points(*case)), case


def test_orient2d_and_collinear():
    for bits in (4, 27, 61):
        cases = [case[:3] for case in four_point_cases(bits)]
        for (a, b, c), result in zip(cases, evaluate("orient2d", [flat(case) for case in cases])):
            normal = model.cross(model.sub(b, a), model.sub(c, a))
            xy, yz, zx = result[:3]
            assert (yz, zx, xy) == tuple(map(model.sign, normal)), (a, b, c)
            assert result[3] == int(normal == (0, 0, 0)), (a, b, c)


def plane_cases(bits: int) -> list[list[Vec]]:
    rng = random.Random(100 + bits)
    points = model.extreme_points(rng, bits) + model.random_points(rng, bits, 300)
    cube = [tuple(s * 2**bits for s in signs) for signs in itertools.product((-1, 1), repeat=3)]
    cases = [model.triangle(rng, points) for _ in range(2000)]
    return cases + [list(t) for t in itertools.permutations(cube, 3)]


def test_planes_are_primitive_and_within_their_bits():
    for bits in (3, 20, 26, 27, 30):
        cases = plane_cases(bits)
        operands = [flat(case) for case in cases]
        turned = evaluate("opposite", operands)
        for case, plane, back in zip(cases, evaluate("plane", operands), turned):
            assert tuple(plane) == model.plane_through(*case), case
            assert math.gcd(*plane[:3]) == 1
            assert [-c for c in plane] == back
            assert max(map(abs, plane[:3])) < 2 ** (2 * bits + 3)
            assert abs(plane[3]) < 2 ** (3 * bits + 3)


def test_plane_values():
    rng = random.Random(8)
    for bits in (4, 26, 27, 30):
        cases = [[*case, p] for case, p in zip(plane_cases(bits), model.extreme_points(rng, bits))]
        cases += [[*case, case[0]] for case in plane_cases(bits)[:200]]
        for case, (value,) in zip(cases, evaluate("plane_value", [flat(c) for c in cases])):
            assert value == model.value(model.plane_through(*case[:3]), case[3]), case
            assert abs(value) < 2 ** (3 * bits + 5)


def test_plane_table_gives_each_plane_one_id():
    rng = random.Random(9)
    few = [
        model.triangle(rng, [(x, y, z) for x in (0, 1, 2) for y in (0, 1) for z in (0, 1)])
        for _ in range(400)
    ]
    big = [[tuple(2**24 * c for c in p) for p in t] for t in few]
    cases = few + [t[::-1] for t in few] + big + plane_cases(26)[:300]
    (result,) = evaluate("intern", [[len(cases), *(c for t in cases for c in flat(t))]])
    ids: dict[model.Plane, int] = {}
    for t, key, side, restored in zip(cases, result[::3], result[1::3], result[2::3]):
        plane = model.plane_through(*t)
        lead = next(c for c in plane if c)
        unsigned = plane if lead > 0 else tuple(-c for c in plane)
        assert key == ids.setdefault(unsigned, len(ids))
        assert side == model.sign(lead)
        assert restored == 1
    assert result[-1] == len(ids)


def grid_cases() -> list[tuple[int, list[tuple[float, float, float]]]]:
    rng = random.Random(10)
    cases: list[tuple[int, list[tuple[float, float, float]]]] = [
        (20, [(0.0, 0.0, 0.0)]),
        (26, [(5.5, -1e300, 3.0), (7.25, 1e300, 3.0)]),
        (26, [(1e-310, 0.0, 0.0), (3e-310, 0.0, 0.0)]),
        (27, [(1e10, 0.0, 0.0), (1e10 + 1e-3, 1e-3, 0.0)]),
        (22, [(-1.0, 0.0, 0.0), (1.0, 1.0, 1.0)]),
        (22, [(0.0, 0.0, 0.0), (8.0, 8.0, 8.0)]),
        (22, [(math.nextafter(-1.0, 0), 0.0, 0.0), (math.nextafter(1.0, 0), 1.0, 1.0)]),
    ]
    for _ in range(300):
        size, shift = 10 ** rng.uniform(-6, 6), 10 ** rng.uniform(-3, 8)
        points = [
            (shift + rng.uniform(-size, size), rng.uniform(-size, size), rng.gauss(0, size))
            for _ in range(rng.randint(1, 9))
        ]
        cases.append((rng.choice((20, 22, 26, 27)), points))
    return cases


def test_grid_holds_all_points_within_half_a_step():
    cases = grid_cases()
    operands = [[bits, len(points), *flat(points)] for bits, points in cases]
    for (bits, points), result in zip(cases, evaluate("grid", operands)):
        step, origin = Fraction(result[0]), result[1:4]
        assert math.frexp(result[0])[0] == 0.5, "a power of two"
        half = max(max(c) - min(c) for c in zip(*[[*map(Fraction, p)] for p in points])) / 2
        finest = 2 * half * (1 + Fraction(1, 2**50)) >= step * 2**bits
        assert finest or half == 0 or step == Fraction(2) ** -1000
        for p, (x, y, z, bx, by, bz) in zip(points, [result[4 + 6 * i :][:6] for i in range(99)]):
            for k, (snapped, back) in enumerate(((x, bx), (y, by), (z, bz))):
                assert abs(snapped) <= 2**bits
                exact = (Fraction(p[k]) - Fraction(origin[k])) / step
                assert abs(exact - snapped) <= Fraction(1, 2) + abs(exact) * Fraction(1, 2**50)
                if exact.denominator == 1:
                    assert back == p[k], "a caller's grid point comes back as it was"
