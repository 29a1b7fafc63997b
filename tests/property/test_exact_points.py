# SPDX-License-Identifier: LGPL-2.1-or-later
"""Points of three planes and of edge and plane against fractions; the bit table at its extremes."""

from __future__ import annotations

import random
from fractions import Fraction

import exact_model as model
import pytest
from exact_model import Vec, flat
from exact_probe import evaluate

PRIME = 2**61 - 1
BITS = (3, 20, 26, 27)


def independent(planes: list[model.Plane]) -> bool:
    return model.dot(planes[0][:3], model.cross(planes[1][:3], planes[2][:3])) != 0


def three_plane_cases(bits: int, count: int) -> list[list[Vec]]:
    """Nine points each: three triangles whose planes meet in one point."""
    rng = random.Random(200 + bits)
    corners = model.extreme_points(rng, bits)
    some = model.random_points(rng, bits, 300)
    close = [tuple(c + rng.randint(-2, 2) for c in corners[i % 5]) for i in range(60)]
    close = [tuple(max(-(2**bits), min(2**bits, c)) for c in p) for p in close]
    cases: list[list[Vec]] = []
    while len(cases) < count:
        pool = rng.choice((corners, corners, some, close + some))
        triangles = [model.triangle(rng, pool) for _ in range(3)]
        if independent([model.plane_through(*t) for t in triangles]):
            cases.append([p for t in triangles for p in t])
    return cases


def planes_of(case: list[Vec]) -> list[model.Plane]:
    return [model.plane_through(*case[i : i + 3]) for i in range(0, len(case), 3)]


@pytest.mark.parametrize("bits", BITS)
def test_meeting_point_of_three_planes(bits):
    cases = three_plane_cases(bits, 2000)
    operands = [flat(case) for case in cases]
    dets = evaluate("det_normals", operands)
    for case, (x, y, z, w), (det,) in zip(cases, evaluate("meet", operands), dets):
        planes = planes_of(case)
        assert w > 0
        assert (Fraction(x, w), Fraction(y, w), Fraction(z, w)) == model.meet(*planes), case
        assert abs(det) == w
        assert det == model.dot(planes[0][:3], model.cross(planes[1][:3], planes[2][:3]))
        assert w < 2 ** (6 * bits + 9)
        assert max(abs(x), abs(y), abs(z)) < 2 ** (7 * bits + 9)


@pytest.mark.parametrize("bits", BITS)
def test_side_of_plane(bits):
    """Any fourth plane, the point's own planes, and planes through it by construction."""
    rng = random.Random(300 + bits)
    corners = model.extreme_points(rng, bits)
    cases = []
    for case in three_plane_cases(bits, 2000):
        fourth = case[:3] if rng.random() < 0.2 else model.triangle(rng, corners)
        cases.append([*case, *fourth])
    largest = 0
    for case, (side,) in zip(cases, evaluate("side", [flat(case) for case in cases])):
        *three, fourth = planes_of(case)
        value = model.value(fourth, model.meet(*three))
        assert side == model.sign(value), case
        w = model.dot(three[0][:3], model.cross(three[1][:3], three[2][:3]))
        largest = max(largest, abs(int(value * w)))
    assert 2 ** (9 * bits + 3) < largest < 2**255, "the extremes were met, and they fit"


@pytest.mark.parametrize("bits", BITS)
def test_point_of_edge_and_plane(bits):
    rng = random.Random(400 + bits)
    corners = model.extreme_points(rng, bits) + model.random_points(rng, bits, 50)
    cases = []
    while len(cases) < 2000:
        plane = model.plane_through(*(t := model.triangle(rng, corners)))
        u, v = rng.sample(corners, 2) if rng.random() < 0.9 else (t[0], rng.choice(corners))
        if model.value(plane, u) != model.value(plane, v):
            cases.append([*t, u, v])
    others = [model.triangle(rng, corners) for _ in cases]
    operands = [flat(case) for case in cases]
    sides = evaluate("side_edge", [[*o, *flat(t)] for o, t in zip(operands, others)])
    for case, (x, y, z, w), other, side in zip(
        cases, evaluate("meet_edge", operands), others, sides
    ):
        plane, (u, v) = model.plane_through(*case[:3]), case[3:]
        su, sv = model.value(plane, u), model.value(plane, v)
        point = tuple((sv * u[k] - su * v[k]) / (sv - su) for k in range(3))
        assert w > 0
        assert (Fraction(x, w), Fraction(y, w), Fraction(z, w)) == point, case
        assert side == [model.sign(model.value(model.plane_through(*other), point)), 0]


def test_side_of_plane_at_grid_points():
    rng = random.Random(11)
    points = model.extreme_points(rng, 26)
    cases = [[rng.choice(points), *model.triangle(rng, points)] for _ in range(1000)]
    cases += [[t[0], *t] for t in (model.triangle(rng, points) for _ in range(200))]
    for case, (side,) in zip(cases, evaluate("side_point", [flat(case) for case in cases])):
        assert side == model.sign(model.value(model.plane_through(*case[1:]), case[0]))


def small_points(rng: random.Random, scale: int, count: int) -> list[Vec]:
    return [tuple(scale * rng.randint(-3, 3) for _ in range(3)) for _ in range(count)]


def coinciding_cases(rng: random.Random, count: int) -> list[list[Vec]]:
    """Two triples of planes through one grid point, and pairs of unrelated meeting points."""
    cases: list[list[Vec]] = []
    while len(cases) < count:
        scale = rng.choice((1, 2**20, 2**24))
        pool = small_points(rng, scale, 12)
        common = pool[0]
        triangles = []
        for _ in range(6):
            q, r = rng.sample(pool, 2)
            if rng.random() < 0.95 and model.cross(model.sub(q, common), model.sub(r, common)) != (
                0, 0, 0,
            ):  # fmt: skip
                triangles.append([common, q, r])
            else:
                triangles.append(model.triangle(rng, pool))
        case = [p for t in triangles for p in t]
        planes = planes_of(case)
        if independent(planes[:3]) and independent(planes[3:]):
            cases.append(case)
    return cases


def test_same_point_and_residues():
    rng = random.Random(12)
    cases = coinciding_cases(rng, 1500)
    cases += [[*p, *q] for p, q in zip(three_plane_cases(26, 200), three_plane_cases(27, 200))]
    operands = [flat(case) for case in cases]
    first = evaluate("residues", [o[:27] for o in operands])
    second = evaluate("residues", [o[27:] for o in operands])
    equal = 0
    for case, (same,), r, s in zip(cases, evaluate("same", operands), first, second):
        planes = planes_of(case)
        p, q = model.meet(*planes[:3]), model.meet(*planes[3:])
        assert same == int(p == q), case
        assert (r == s) == (p == q), case
        assert r == [c.numerator * pow(c.denominator, -1, PRIME) % PRIME for c in p], case
        equal += same
    assert equal > 500


def test_to_doubles_rounds_closely():
    for bits in BITS:
        cases = three_plane_cases(bits, 500)
        for case, rounded in zip(cases, evaluate("doubles", [flat(case) for case in cases])):
            for exact, double in zip(model.meet(*planes_of(case)), rounded):
                assert abs(Fraction(double) - exact) <= abs(exact) * Fraction(1, 2**50), case
