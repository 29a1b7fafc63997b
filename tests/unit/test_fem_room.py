# SPDX-License-Identifier: LGPL-2.1-or-later
"""A flat tetrahedron below two triangles of one curved face gets room, and nothing else changes."""

from __future__ import annotations

import numpy as np
import pytest

from freecad_tetra.fem import jacobian, skin
from freecad_tetra.fem.prepare import FemOptions, prepare
from freecad_tetra.fem.remesh import Sizes
from freecad_tetra.fem.room import make_room
from freecad_tetra.fem.second_order import second_order
from freecad_tetra.model import TetMesh

from .test_fem_refine import assert_same_solid

ROOF = 0


@pytest.fixture
def roof() -> TetMesh:
    """A roof 0.02 high in one tetrahedron, on two that share the edge across below its ridge."""
    points = np.array([(-1, 0, 0.02), (1, 0, 0.02), (0, -1, 0), (0, 1, 0), (0, 0, -1)], float)
    tets = np.array([(0, 1, 2, 3), (0, 3, 2, 4), (1, 2, 3, 4)])
    rows, _ = skin.skin_of(tets, np.zeros(3))
    under = (rows == 4).any(axis=1)
    face = np.where(under, under.cumsum(), ROOF)
    assert (jacobian.straight_determinants(points[tets]) > 0).all() and under.sum() == 4
    return TetMesh(
        points, tets, rows, face, np.arange(6), np.zeros(3), np.arange(5),
        tuple(f"Face{i}" for i in range(1, 6)),
    )  # fmt: skip


def to_vault(faces: tuple[int, ...], points: np.ndarray) -> np.ndarray:
    """Lift the middles of the eaves, so that the roof has no fold at its ridge any more."""
    out = np.array(points)
    out[:, 2] += 0.05 * ((ROOF in faces) & (len(faces) > 1))
    return out


def test_edge_across_the_ridge_is_divided(roof: TetMesh) -> None:
    _, before = second_order(roof, to_vault)
    assert before.straightened > 0 and before.unbearing == (0,)
    made = make_room(roof, before.unbearing)
    assert_same_solid(roof, made)
    assert np.array_equal(made.skin, roof.skin) and len(made) == 6
    assert made.points[5, 2] < -0.1, "the middle of the edge went down"
    fine, after = second_order(made, to_vault)
    assert (after.straightened, after.curved, after.unbearing) == (0, 4, ())
    assert (jacobian.determinants(fine.points[fine.tets]) > 0).all()


def test_preparing_makes_room_and_tells_it(roof: TetMesh) -> None:
    made = prepare(roof, FemOptions(sizes=Sizes(size=0)), to_vault)
    told = made.report.details["fem"]
    assert (told["rounds_for_room"], told["straightened_middles"]) == (1, 0)


def test_what_has_no_inner_edge_stays(roof: TetMesh) -> None:
    alone = TetMesh(
        roof.points[:4], roof.tets[:1], [(0, 1, 3), (0, 2, 1), (0, 3, 2), (1, 2, 3)],
        [0, 0, 1, 1], np.arange(4), [0], np.arange(4), ("Face1", "Face2"),
    )  # fmt: skip
    assert make_room(alone, [0]) is alone
    assert make_room(roof, []) is roof


def test_of_two_that_share_an_edge_the_first_is_served(roof: TetMesh) -> None:
    assert len(make_room(roof, [0, 1, 2]).points) == 6
