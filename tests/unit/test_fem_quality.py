# SPDX-License-Identifier: LGPL-2.1-or-later
"""Quality figures are those of known elements, and curved elements are proven positive."""

from __future__ import annotations

import numpy as np
import pytest

from freecad_tetra.fem import jacobian
from freecad_tetra.fem.quality import dihedral_angles, histogram, quality, quality_of
from freecad_tetra.fem.second_order import second_order
from freecad_tetra.model import TetMesh

REGULAR = np.array([[1, 1, 1], [1, -1, -1], [-1, 1, -1], [-1, -1, 1]], float)[[0, 2, 1, 3]]
CORNER = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]], float)


def tet10(corners: np.ndarray) -> np.ndarray:
    middles = [(corners[i] + corners[j]) / 2 for i, j in jacobian.TET_EDGES]
    return np.concatenate([corners, middles])


@pytest.mark.parametrize("nodes", [REGULAR, tet10(REGULAR)])
def test_regular_tetrahedron_is_perfect(nodes: np.ndarray) -> None:
    found = quality_of(nodes, [range(len(nodes))])
    assert found.min_dihedral[0] == pytest.approx(np.arccos(1 / 3), rel=1e-14)
    assert found.max_dihedral[0] == pytest.approx(np.arccos(1 / 3), rel=1e-14)
    assert found.mean_ratio[0] == pytest.approx(1, rel=1e-14)
    assert found.scaled_jacobian[0] == pytest.approx(1, rel=1e-13)
    assert found.jacobian_ratio[0] == pytest.approx(1, rel=1e-13)


def test_corner_of_a_cube() -> None:
    angles = np.degrees(np.sort(dihedral_angles(CORNER[None])[0]))
    assert angles[3:] == pytest.approx([90] * 3)
    assert angles[:3] == pytest.approx([np.degrees(np.arccos(3**-0.5))] * 3)
    assert quality_of(CORNER, [range(4)]).scaled_jacobian[0] == pytest.approx(2**-0.5)


def test_angle_of_a_sliver_is_not_lost_in_rounding() -> None:
    flat = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0.3, 0.3, 1e-12]])
    found = quality_of(flat, [range(4)])
    # At the edge x = 0 the top is 0.3 away: arctan(1e-12 / 0.3); at x + y = 1 it is 0.4 / sqrt(2).
    assert found.min_dihedral[0] == pytest.approx(1e-12 / 0.3, rel=1e-6)
    assert found.nonpositive().tolist() == []
    assert quality_of(flat[[0, 2, 1, 3]], [range(4)]).nonpositive().tolist() == [0]


def test_determinants_are_those_of_the_shape_functions() -> None:
    """A bent element against derivatives by differences of its own interpolation."""
    nodes = tet10(CORNER) + 0.05 * np.random.default_rng(3).normal(size=(10, 3))

    def position(at: np.ndarray) -> np.ndarray:
        full = np.array([1 - at.sum(), *at])
        shape = [x * (2 * x - 1) for x in full]
        shape += [4 * full[i] * full[j] for i, j in jacobian.TET_EDGES]
        return np.asarray(shape) @ nodes

    found = jacobian.determinants(nodes[None])[0]
    for at, value in zip(jacobian.SAMPLES, found):
        step = 1e-6
        rows = [
            (position(at[1:] + step * e) - position(at[1:] - step * e)) / (2 * step)
            for e in np.eye(3)
        ]
        assert value == pytest.approx(np.linalg.det(rows), rel=1e-7)


def test_bernstein_bound_holds_and_is_sharp() -> None:
    rng = np.random.default_rng(5)
    dense = rng.dirichlet(np.ones(4), 3000)
    derivatives = jacobian._derivatives(dense)
    for size in (0.02, 0.1, 0.3):
        nodes = tet10(CORNER) + size * rng.normal(size=(10, 3))
        values = np.linalg.det(np.einsum("qni,nx->qix", derivatives, nodes))
        bound = jacobian.least_coefficient(jacobian.determinants(nodes[None]))[0]
        assert bound <= values.min() + 1e-12
    straight = jacobian.determinants(tet10(CORNER)[None])
    assert jacobian.least_coefficient(straight)[0] == pytest.approx(1)


def test_inverted_middle_is_found_and_never_proven() -> None:
    nodes = tet10(CORNER)
    nodes[4] = [0.1, 0, 0]  # past the quarter point: the edge folds back
    found = quality_of(nodes, [range(10)])
    assert found.nonpositive().tolist() == [0] and not found.proven[0]


def test_mesh_figures(cube_tets: TetMesh) -> None:
    first = quality(cube_tets).to_dict()
    second = quality(second_order(cube_tets)[0]).to_dict()
    for told in (first, second):
        assert told["elements"] == 6 and told["nonpositive_jacobians"] == 0
        assert told["min_dihedral_degrees"] == pytest.approx(45)
        assert sum(told["dihedral_histogram"]) == sum(told["histogram"]) == 6
        assert told["proven_positive"] == 6
    assert second["min_jacobian_ratio"] == pytest.approx(1)
    assert first["min_scaled_jacobian"] == pytest.approx(second["min_scaled_jacobian"])


def test_histogram_counts_both_ends() -> None:
    assert histogram([-1, 0, 0.5, 1, 2], (0, 1)) == [1, 2, 2]
