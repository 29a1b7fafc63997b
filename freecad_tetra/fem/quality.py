# SPDX-License-Identifier: LGPL-2.1-or-later
"""How good the elements of a mesh are: dihedral angles, mean ratio, scaled Jacobian.

Positive is not good: a solver accepts slivers without a word and gives poor stresses. Mean
ratio is 12 (3 V)^(2/3) / (sum of the squared edges), 1 for the regular tetrahedron (Liu and Joe,
BIT 34, 1994). The scaled Jacobian of a straight tetrahedron is sqrt(2) det / (largest product
of the three edges at a corner); of a ten-node one the same with the least det of its samples.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from freecad_tetra.fem import jacobian
from freecad_tetra.model import FloatArray, LongArray, Tet10Mesh, TetMesh

DIHEDRAL_BOUNDS = (0.1, 1.0, 5.0, 8.0, 12.0, 20.0, 30.0, 40.0, 50.0, 60.0)  # degrees
RATIO_BOUNDS = (1e-6, 1e-4, 1e-3, 1e-2, 0.05, 0.1, 0.2, 0.4, 0.7)
JACOBIAN_BOUNDS = (0.0, 1e-3, 1e-2, 0.05, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9)
GOOD_DIHEDRAL = 8.0  # degrees; below it stresses beside the element are not to be trusted

_SIDES = np.array([(1, 2, 3), (0, 3, 2), (0, 1, 3), (0, 2, 1)])
# Edges that the sides i and j share, in the order of `dihedral_angles`.
_PAIRS = np.array([(0, 1), (0, 2), (0, 3), (1, 2), (1, 3), (2, 3)])
_AT_CORNER = ((0, 1, 2), (0, 3, 4), (1, 3, 5), (2, 4, 5))  # pairs that hold each corner


@dataclass(frozen=True, eq=False)
class Quality:
    """Figures of every element of a mesh.

    Attributes
    ----------
    order : int
        1 for tet4, 2 for tet10.
    min_dihedral, max_dihedral : (t,) float64
        Least and largest angle between two straight sides, radians.
    mean_ratio : (t,) float64
        Of the straight corners, in 0..1; negative when inverted.
    scaled_jacobian : (t,) float64
        Least over integration points, corners and the cubic lattice; at most 1.
    jacobian_ratio : (t,) float64
        Least det J by the largest; 1 when straight.
    proven : (t,) bool
        det J is positive everywhere in the element, by its Bernstein coefficients.
    """

    order: int
    min_dihedral: FloatArray
    max_dihedral: FloatArray
    mean_ratio: FloatArray
    scaled_jacobian: FloatArray
    jacobian_ratio: FloatArray
    proven: Any

    def nonpositive(self) -> LongArray:
        """Return the elements that a solver refuses, (k,) int64."""
        return np.flatnonzero(~(self.scaled_jacobian > 0))

    def worst(self, count: int = 20) -> LongArray:
        """Return the elements of the least angle, worst first; non-positive ones lead."""
        lead = np.where(self.scaled_jacobian > 0, self.min_dihedral, self.scaled_jacobian - 1)
        return np.argsort(lead, kind="stable")[:count].astype(np.int64)

    def to_dict(self) -> dict[str, Any]:
        """Return extremes and histograms as plain types; angles of extremes in radians."""
        if not len(self.min_dihedral):
            return {"elements": 0, "order": self.order}
        degrees = np.degrees(self.min_dihedral)
        return {
            "elements": len(degrees),
            "order": self.order,
            "min_dihedral": float(self.min_dihedral.min()),
            "max_dihedral": float(self.max_dihedral.max()),
            "min_dihedral_degrees": float(degrees.min()),
            "below_good_dihedral": int((degrees < GOOD_DIHEDRAL).sum()),
            "dihedral_histogram": histogram(degrees, DIHEDRAL_BOUNDS),
            "dihedral_histogram_bounds": list(DIHEDRAL_BOUNDS),
            "min_mean_ratio": float(self.mean_ratio.min()),
            "mean_ratio": float(self.mean_ratio.mean()),
            "histogram": histogram(self.mean_ratio, RATIO_BOUNDS),
            "histogram_bounds": list(RATIO_BOUNDS),
            "min_scaled_jacobian": float(self.scaled_jacobian.min()),
            "scaled_jacobian_histogram": histogram(self.scaled_jacobian, JACOBIAN_BOUNDS),
            "scaled_jacobian_histogram_bounds": list(JACOBIAN_BOUNDS),
            "min_jacobian_ratio": float(self.jacobian_ratio.min()),
            "nonpositive_jacobians": len(self.nonpositive()),
            "proven_positive": int(np.count_nonzero(self.proven)),
            "worst_elements": self.worst().tolist(),
        }


def histogram(values: Any, bounds: Any) -> list[int]:
    """Count values below the first bound, between neighbours, from the last on; O(n log k)."""
    place = np.searchsorted(np.asarray(bounds, float), np.asarray(values, float), side="right")
    return np.bincount(place, minlength=len(bounds) + 1).tolist()


def quality(mesh: TetMesh | Tet10Mesh) -> Quality:
    """Measure all elements of a mesh, O(t)."""
    return quality_of(mesh.points, mesh.tets)


def quality_of(points: Any, tets: Any) -> Quality:
    """Measure elements given as arrays, O(t).

    Parameters
    ----------
    points : (p, 3) float64
    tets : (t, 4) or (t, 10) int
        Middles as in `Tet10Mesh`.
    """
    nodes = np.asarray(points, float)[np.asarray(tets)]
    corners = nodes[:, :4]
    least, largest = _extreme_angles(corners)
    straight = jacobian.straight_determinants(corners)
    length = np.sqrt(_longest_product(corners))
    scale = np.sqrt(2.0) / np.where(length > 0, length, np.inf)
    if nodes.shape[1] == 4:
        ones = np.sign(straight)
        return Quality(1, least, largest, mean_ratio(corners), straight * scale, ones, straight > 0)
    values = jacobian.determinants(nodes)
    low, high = values.min(axis=1), values.max(axis=1)
    ratio = low / np.where(high > 0, high, np.inf)
    proven = jacobian.least_coefficient(values) > 0
    return Quality(2, least, largest, mean_ratio(corners), low * scale, ratio, proven)


def dihedral_angles(corners: Any) -> FloatArray:
    """Return the six dihedral angles of straight tetrahedra, (t, 6) radians.

    Column k is the angle at the edge opposite to that of the k-th pair of 01 02 03 12 13 23.
    """
    p = np.asarray(corners, float)
    first = p[:, _SIDES[:, 0]]
    normals = cross(p[:, _SIDES[:, 1]] - first, p[:, _SIDES[:, 2]] - first)
    a, b = normals[:, _PAIRS[:, 0]], normals[:, _PAIRS[:, 1]]
    # The arctangent keeps small angles, which an arccosine of a rounded product loses.
    sine = np.sqrt(np.square(cross(a, b)).sum(axis=2))
    angles: FloatArray = np.arctan2(sine, -(a * b).sum(axis=2))
    return angles


def cross(a: FloatArray, b: FloatArray) -> FloatArray:
    """Return the vector products along the last axis; numpy's own costs more on short arrays."""
    out = np.empty_like(a)
    for i, j, k in ((0, 1, 2), (1, 2, 0), (2, 0, 1)):
        out[..., i] = a[..., j] * b[..., k] - a[..., k] * b[..., j]
    return out


def _extreme_angles(corners: Any) -> tuple[FloatArray, FloatArray]:
    angles = dihedral_angles(corners)
    return angles.min(axis=1), angles.max(axis=1)


def mean_ratio(corners: Any) -> FloatArray:
    """Return 12 (3 V)^(2/3) / sum of squared edges with the sign of V, (t,)."""
    six = jacobian.straight_determinants(corners)
    squares = np.square(corners[:, _PAIRS[:, 1]] - corners[:, _PAIRS[:, 0]]).sum(axis=(1, 2))
    root = np.cbrt(np.abs(six) / 2)
    ratio: FloatArray = np.sign(six) * 12 * root**2 / np.where(squares > 0, squares, np.inf)
    return ratio


def _longest_product(corners: Any) -> FloatArray:
    """Return the largest product of the three squared edges at a corner, (t,)."""
    squares = np.square(corners[:, _PAIRS[:, 1]] - corners[:, _PAIRS[:, 0]]).sum(axis=2)
    products = [squares[:, own].prod(axis=1) for own in _AT_CORNER]
    longest: FloatArray = np.max(products, axis=0)
    return longest
