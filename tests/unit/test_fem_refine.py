# SPDX-License-Identifier: LGPL-2.1-or-later
"""Refined and bisected meshes fill the same solid face to face and keep faces and solids."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest

from freecad_tetra.errors import TetraError
from freecad_tetra.fem import bisect as bisecting
from freecad_tetra.fem import skin
from freecad_tetra.fem.bisect import bisect
from freecad_tetra.fem.quality import quality
from freecad_tetra.fem.refine import refine, refined
from freecad_tetra.fem.triangles import face_areas
from freecad_tetra.model import TetMesh

from .test_fem_second_order import SIDE, prism, to_cylinder


def assert_same_solid(before: TetMesh, after: TetMesh) -> None:
    """Positive, face to face, bounded by the skin it tells, with volumes and areas unchanged."""
    assert (after.volumes() > 0).all()
    assert after.volumes().sum() == pytest.approx(before.volumes().sum(), rel=1e-13)
    rows, _ = skin.skin_of(after.tets, after.tet_solid)
    assert turned(rows) == turned(after.skin)
    assert face_areas(after) == pytest.approx(face_areas(before), rel=1e-12)
    assert np.array_equal(after.points[: len(before.points)], before.points)


def turned(triangles: np.ndarray) -> list[tuple[int, ...]]:
    return sorted(tuple(np.roll(t, -int(np.argmin(t)))) for t in triangles.tolist())


@pytest.mark.parametrize("make", [lambda mesh: refine(mesh), lambda mesh: bisect(mesh, 0.3)])
def test_cube(cube_tets: TetMesh, make: Callable[[TetMesh], TetMesh]) -> None:
    assert_same_solid(cube_tets, make(cube_tets))


def test_refinement_makes_eight_of_one_and_keeps_angles(cube_tets: TetMesh) -> None:
    fine = refined(cube_tets, 2)
    assert len(fine) == 6 * 64 and len(fine.skin) == 12 * 16
    assert np.bincount(fine.skin_face).tolist() == [32] * 6
    # Octahedra of Kuhn's tetrahedra have a square section: their quarters have this angle.
    assert quality(fine).min_dihedral.min() == pytest.approx(np.arctan(0.5**0.5))
    assert len(fine.points) == 5**3, "nodes are shared, none is double"


def test_two_solids_stay_bonded(cube_tets: TetMesh) -> None:
    solid = np.array([0, 0, 0, 1, 1, 1])
    rows, _ = skin.skin_of(cube_tets.tets, solid)
    names = (*cube_tets.face_names, "Face7")
    outer = {tuple(sorted(t)): f for t, f in zip(cube_tets.skin.tolist(), cube_tets.skin_face)}
    face = [outer.get(tuple(sorted(t)), 6) for t in rows.tolist()]
    pair = TetMesh(
        cube_tets.points, cube_tets.tets, rows, face, np.arange(len(rows)), solid,
        cube_tets.point_source, names,
    )  # fmt: skip
    for fine in (refine(pair), bisect(pair, 0.4)):
        assert_same_solid(pair, fine)
        inner = np.sort(fine.skin[fine.skin_face == 6], axis=1)
        _, count = np.unique(inner, axis=0, return_counts=True)
        assert (count == 2).all() and len(count) > 2


def test_new_boundary_points_go_to_the_cad() -> None:
    mesh = prism(12)
    for fine in (refine(mesh, to_cylinder), bisect(mesh, 2.0, to_cylinder)):
        assert (fine.volumes() > 0).all()
        side = fine.points[np.unique(fine.skin[fine.skin_face == SIDE])]
        radius = np.linalg.norm(side[:, :2], axis=1)
        # The thinnest tetrahedra of the fan do not bear it: a few points stay inside.
        assert radius.max() <= 5 * (1 + 1e-15)
        assert np.mean(np.abs(radius / 5 - 1) < 1e-14) > 0.95
        assert mesh.volumes().sum() < fine.volumes().sum() < np.pi * 25 * 20


def test_bisection_ends_below_the_size(cube_tets: TetMesh) -> None:
    fine = bisect(cube_tets, 0.25)
    ends = skin.skin_edges(fine.skin).ends
    length = np.linalg.norm(fine.points[ends[:, 0]] - fine.points[ends[:, 1]], axis=1)
    assert length.max() <= 0.25
    # Longest-edge bisection of Kuhn's tetrahedra has few shapes, none worse than 45 degrees halved.
    assert np.degrees(quality(fine).min_dihedral.min()) > 22
    same = bisect(cube_tets, 2.0)
    assert np.array_equal(same.tets, cube_tets.tets)
    assert np.array_equal(bisect(cube_tets, 0.25).tets, fine.tets), "equal input, equal output"


def test_absurd_size_is_refused(cube_tets: TetMesh, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(bisecting, "MOST_ELEMENTS", 1000)
    with pytest.raises(TetraError, match="choose a larger size"):
        bisect(cube_tets, 1e-3)
