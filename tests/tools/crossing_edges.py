# SPDX-License-Identifier: LGPL-2.1-or-later
"""Finds edges that cross in their middles: contacts beyond types 1 to 3, which may be refused."""

from __future__ import annotations

import itertools
from fractions import Fraction

from random_solids import Surface

Vector = tuple[Fraction, Fraction, Fraction]


def edges_cross(surface: Surface) -> bool:
    """Whether two edges without a common vertex share one inner point; exact, O(edges^2)."""
    places: list[Vector] = [tuple(map(Fraction, row)) for row in surface[0].tolist()]
    corners = surface[1].tolist()
    edges = {tuple(sorted((t[k], t[k - 1]))) for t in corners for k in range(3)}
    return any(
        cross_inside(places[a], places[b], places[c], places[d])
        for (a, b), (c, d) in itertools.combinations(sorted(edges), 2)
        if not {a, b} & {c, d}
    )


def cross_inside(a: Vector, b: Vector, c: Vector, d: Vector) -> bool:
    """Whether the segments ab and cd, not parallel, meet in a point inside both."""
    u, v, w = _minus(b, a), _minus(d, c), _minus(c, a)
    normal = _cross(u, v)
    square = _dot(normal, normal)
    if square == 0 or _dot(normal, w) != 0:
        return False
    along, across = _dot(_cross(w, v), normal), _dot(_cross(w, u), normal)
    return 0 < along < square and 0 < across < square


def _minus(p: Vector, q: Vector) -> Vector:
    return (p[0] - q[0], p[1] - q[1], p[2] - q[2])


def _cross(p: Vector, q: Vector) -> Vector:
    return (
        p[1] * q[2] - p[2] * q[1],
        p[2] * q[0] - p[0] * q[2],
        p[0] * q[1] - p[1] * q[0],
    )


def _dot(p: Vector, q: Vector) -> Fraction:
    return p[0] * q[0] + p[1] * q[1] + p[2] * q[2]
