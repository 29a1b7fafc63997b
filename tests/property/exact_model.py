# SPDX-License-Identifier: LGPL-2.1-or-later
"""What the exact layer has to compute, restated in Python's integers and fractions."""

from __future__ import annotations

import math
import random
from fractions import Fraction

Vec = tuple[int, int, int]
Plane = tuple[int, int, int, int]


def sign(value: int | Fraction) -> int:
    return (value > 0) - (value < 0)


def sub(p: Vec, q: Vec) -> Vec:
    return (p[0] - q[0], p[1] - q[1], p[2] - q[2])


def cross(u: Vec, v: Vec) -> Vec:
    return (u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0])


def dot(u: Vec, v: Vec) -> int:
    return u[0] * v[0] + u[1] * v[1] + u[2] * v[2]


def det_of_points(a: Vec, b: Vec, c: Vec, d: Vec) -> int:
    return dot(cross(sub(b, a), sub(c, a)), sub(d, a))


def plane_through(p: Vec, q: Vec, r: Vec) -> Plane:
    """The primitive plane (a, b, c, d); its four numbers have no common divisor."""
    n = cross(sub(q, p), sub(r, p))
    d = -dot(n, p)
    g = math.gcd(*n, d)
    return (n[0] // g, n[1] // g, n[2] // g, d // g)


def normal(plane: Plane) -> Vec:
    return plane[:3]


def meet(p: Plane, q: Plane, r: Plane) -> tuple[Fraction, Fraction, Fraction]:
    """Cramer's rule; the normals must be independent."""
    n, m, k = normal(p), normal(q), normal(r)
    w = dot(n, cross(m, k))
    sums = [
        -(cross(m, k)[i] * p[3] + cross(k, n)[i] * q[3] + cross(n, m)[i] * r[3]) for i in range(3)
    ]
    return (Fraction(sums[0], w), Fraction(sums[1], w), Fraction(sums[2], w))


def value(plane: Plane, point: tuple[Fraction, ...] | Vec) -> Fraction:
    return Fraction(sum(plane[i] * point[i] for i in range(3)) + plane[3])


def extreme_points(rng: random.Random, bits: int, slack: int = 3) -> list[Vec]:
    """Grid points within `slack` of the corners of the cube |x| <= 2^bits.

    Corners give the largest determinants (Hadamard), the slack keeps them primitive.
    """
    top = 2**bits

    def coordinate() -> int:
        return rng.choice((-1, 1)) * (top - rng.randint(0, slack))

    return [(coordinate(), coordinate(), coordinate()) for _ in range(200)]


def random_points(rng: random.Random, bits: int, count: int) -> list[Vec]:
    """Points of every size up to 2^bits."""

    def coordinate(limit: int) -> int:
        return rng.randint(-limit, limit)

    result = []
    for _ in range(count):
        limit = 2 ** rng.randint(1, bits)
        result.append((coordinate(limit), coordinate(limit), coordinate(limit)))
    return result


def triangle(rng: random.Random, points: list[Vec]) -> list[Vec]:
    """Three of the points that are not collinear."""
    while True:
        p, q, r = rng.sample(points, 3)
        if cross(sub(q, p), sub(r, p)) != (0, 0, 0):
            return [p, q, r]


def flat(points: list[Vec] | tuple[Vec, ...]) -> list[int]:
    return [c for p in points for c in p]
