# SPDX-License-Identifier: LGPL-2.1-or-later
"""Jacobian determinants of ten-node tetrahedra: where they are taken and what they prove.

The determinant of a ten-node tetrahedron is a cubic in the barycentric coordinates: its values
at the twenty points of the cubic lattice give its Bernstein coefficients, and when those are
all positive the element is positive everywhere.
"""

from __future__ import annotations

from collections.abc import Sequence
from itertools import combinations, product
from math import factorial
from typing import Any

import numpy as np

from freecad_tetra.model import FloatArray

# Corners of the middles 4 to 9 of a ten-node tetrahedron, and of 3 to 5 of a six-node triangle.
TET_EDGES = ((0, 1), (1, 2), (2, 0), (0, 3), (1, 3), (2, 3))
TRIANGLE_EDGES = ((0, 1), (1, 2), (2, 0))

_BLOCK = 16384


def _gauss_points() -> list[list[float]]:
    """Return the four integration points of C3D10, exact for quadratics."""
    near = (5 + 3 * 5**0.5) / 20
    far = (1 - near) / 3
    return [[near if i == j else far for j in range(4)] for i in range(4)]


def _lattice() -> list[tuple[int, ...]]:
    """Return the exponents (i, j, k, l) of a cubic, whose thirds are the lattice points."""
    return [e for e in product(range(4), repeat=4) if sum(e) == 3]


def _bernstein(exponents: Sequence[int], at: Any) -> float:
    weight = 6.0
    for e, x in zip(exponents, at):
        weight *= x**e / factorial(e)
    return float(weight)


def _derivatives(points: Any) -> FloatArray:
    """Return derivatives of the shape functions by coordinates 1 to 3, (q, 10, 3)."""
    table = np.zeros((len(points), 10, 4))
    for row, at in zip(table, np.asarray(points, float)):
        for i in range(4):
            row[i, i] = 4 * at[i] - 1
        for m, (i, j) in enumerate(TET_EDGES, 4):
            row[m, i], row[m, j] = 4 * at[j], 4 * at[i]
    return table[:, :, 1:] - table[:, :, :1]


LATTICE = np.array(_lattice(), float) / 3
GAUSS = np.array(_gauss_points())
_EDGE_MIDDLES = np.array([[0.5 * (k in e) for k in range(4)] for e in combinations(range(4), 2)])
SAMPLES = np.concatenate([LATTICE, GAUSS, _EDGE_MIDDLES])
GAUSS_COLUMNS = slice(len(LATTICE), len(LATTICE) + len(GAUSS))
_SAMPLE_DERIVATIVES = _derivatives(SAMPLES)
_TO_BERNSTEIN = np.linalg.inv([[_bernstein(e, at) for e in _lattice()] for at in LATTICE])


def determinants(corners: Any) -> FloatArray:
    """Return det J at all `SAMPLES` (30 points), (t, 30) float64, O(t).

    Parameters
    ----------
    corners : (t, 10, 3) float64
        Nodes of the elements. det J is six times the volume where the element is straight.
    """
    nodes = np.asarray(corners, float)
    out = np.empty((len(nodes), len(SAMPLES)))
    for start in range(0, len(nodes), _BLOCK):
        block = nodes[start : start + _BLOCK]
        jacobian = np.einsum("qni,tnx->tqix", _SAMPLE_DERIVATIVES, block, optimize=True)
        cross = np.cross(jacobian[:, :, 1], jacobian[:, :, 2])
        out[start : start + _BLOCK] = np.einsum("tqx,tqx->tq", jacobian[:, :, 0], cross)
    return out


def least_coefficient(values: FloatArray) -> FloatArray:
    """Return the least Bernstein coefficient of det J, (t,), from `determinants`.

    It is a lower bound of det J in the whole element, attained for straight ones.
    """
    return (values[:, : len(LATTICE)] @ _TO_BERNSTEIN.T).min(axis=1)


def volumes(corners: Any) -> FloatArray:
    """Return the volume of curved elements (t,): the mean of the Bernstein coefficients by six."""
    values = determinants(corners)[:, : len(LATTICE)]
    out: FloatArray = (values @ _TO_BERNSTEIN.T).mean(axis=1) / 6
    return out


def straight_determinants(corners: Any) -> FloatArray:
    """Return six times the volume of straight tetrahedra, (t,); `corners` (t, 4 or 10, 3)."""
    p = np.asarray(corners, float)
    e = p[:, 1:4] - p[:, :1]
    a, b, c = e[:, 0], e[:, 1], e[:, 2]
    return (
        a[:, 0] * (b[:, 1] * c[:, 2] - b[:, 2] * c[:, 1])
        + a[:, 1] * (b[:, 2] * c[:, 0] - b[:, 0] * c[:, 2])
        + a[:, 2] * (b[:, 0] * c[:, 1] - b[:, 1] * c[:, 0])
    )
