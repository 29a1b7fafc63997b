# SPDX-License-Identifier: LGPL-2.1-or-later
"""Middles lie on the CAD or on the chord, and no element is bent past what it bears."""

from __future__ import annotations

import numpy as np
import pytest

from freecad_tetra.fem import jacobian, skin
from freecad_tetra.fem.project import project_points
from freecad_tetra.fem.quality import quality
from freecad_tetra.fem.second_order import LEAST_INTEGRATED, LEAST_SHARE, second_order, straightened
from freecad_tetra.model import TetMesh

SIDE, BOTTOM, TOP = 0, 1, 2


def prism(count: int, radius: float = 5.0, height: float = 20.0) -> TetMesh:
    """A cylinder of `count` facets in tetrahedra that fan out from one edge; no inner points."""
    angles = 2 * np.pi * np.arange(count) / count
    ring = radius * np.stack([np.cos(angles), np.sin(angles)], axis=1)
    points = np.concatenate([np.insert(ring, 2, z, axis=1) for z in (0.0, height)])
    tets = []
    for i in range(1, count - 1):
        a, b, c = 0, i, i + 1
        tets += [(a, b, c, c + count), (a, c + count, b, b + count)]
        tets += [(a, b + count, c + count, a + count)]
    det = jacobian.straight_determinants(points[np.array(tets)])
    tets = [t if d > 0 else (t[0], t[2], t[1], t[3]) for t, d in zip(tets, det)]
    rows, _ = skin.skin_of(tets, np.zeros(len(tets)))
    z = points[rows][:, :, 2]
    face = np.where((z == 0).all(axis=1), BOTTOM, np.where((z == height).all(axis=1), TOP, SIDE))
    names = ("Face1", "Face2", "Face3")
    return TetMesh(
        points, tets, rows, face, np.arange(len(rows)), np.zeros(len(tets)),
        np.arange(len(points)), names,
    )  # fmt: skip


def to_cylinder(faces: tuple[int, ...], points: np.ndarray, radius: float = 5.0) -> np.ndarray:
    out = np.array(points)
    if SIDE in faces:
        out[:, :2] *= radius / np.linalg.norm(out[:, :2], axis=1)[:, None]
    for face, z in ((BOTTOM, 0.0), (TOP, 20.0)):
        if face in faces:
            out[:, 2] = z
    return out


def test_straight_middles_are_means(cube_tets: TetMesh) -> None:
    made, curving = second_order(cube_tets)
    assert curving.curved == curving.straightened == 0
    p = made.points
    for k, (i, j) in enumerate(jacobian.TET_EDGES, 4):
        assert np.array_equal(p[made.tets[:, k]], (p[made.tets[:, i]] + p[made.tets[:, j]]) / 2)
    for k, (i, j) in enumerate(jacobian.TRIANGLE_EDGES, 3):
        assert np.array_equal(p[made.skin[:, k]], (p[made.skin[:, i]] + p[made.skin[:, j]]) / 2)
    assert len(made.points) == 8 + 19, "the cube has 12 edges, 6 of faces and one inside"
    back = straightened(made)
    assert np.array_equal(back.tets, cube_tets.tets) and np.array_equal(
        back.points, cube_tets.points
    )


def test_cylinder_is_curved_on_its_rims_and_side_only() -> None:
    mesh = prism(24)
    made, curving = second_order(mesh, to_cylinder)
    assert curving.straightened == 0 and curving.unprojected == 0
    side = made.points[np.unique(made.skin[made.skin_face == SIDE])]
    assert np.abs(np.linalg.norm(side[:, :2], axis=1) - 5).max() < 1e-14
    caps = made.points[np.unique(made.skin[made.skin_face == BOTTOM])]
    assert (caps[:, 2] == 0).all()
    exact = np.pi * 25 * 20
    assert jacobian.volumes(made.points[made.tets]).sum() == pytest.approx(exact, rel=2e-5)
    assert abs(mesh.volumes().sum() / exact - 1) > 0.01, "the chords alone lose a hundredth"
    assert quality(made).proven.all()


def test_what_an_element_cannot_bear_goes_back_to_the_chord() -> None:
    """Eight facets bend inwards, through the thin tetrahedra at the outside of the fan."""
    mesh = prism(8)

    def inwards(faces: tuple[int, ...], points: np.ndarray) -> np.ndarray:
        return 4 * np.asarray(points) - 3 * to_cylinder(faces, points)

    made, curving = second_order(mesh, inwards)
    assert curving.straightened > 0 and curving.faces
    values = jacobian.determinants(made.points[made.tets])
    straight = jacobian.straight_determinants(made.points[made.tets])
    assert (values.min(axis=1) >= LEAST_SHARE * straight).all()
    gauss = values[:, jacobian.GAUSS_COLUMNS].min(axis=1)
    assert (gauss >= LEAST_INTEGRATED * straight * (1 - 1e-12)).all()


def test_lost_and_far_projections_leave_the_chord(cube_tets: TetMesh) -> None:
    lost, curving = second_order(cube_tets, lambda faces, points: np.full(points.shape, np.nan))
    straight, _ = second_order(cube_tets)
    assert np.array_equal(lost.points, straight.points) and curving.curved == 0
    far, curving = second_order(cube_tets, lambda faces, points: points + 3)
    assert np.array_equal(far.points, straight.points) and curving.unprojected == 18


def test_faces_of_edges_and_points_of_a_cube(cube_tets: TetMesh) -> None:
    edges = skin.skin_edges(cube_tets.skin)
    assert len(edges.ends) == 18 and (edges.count == 2).all()
    groups = skin.faces_of_edges(edges, cube_tets.skin_face)
    assert sorted(len(f) for f in groups) == [1] * 6 + [2] * 12
    corners = skin.faces_of_points(cube_tets.skin, cube_tets.skin_face)
    assert len(corners) == 8 and all(len(f) == 3 for f in corners)


def test_boundary_steiner_points_move_and_nothing_inverts() -> None:
    mesh = prism(16)
    # The vertices of the rim are declared to be Steiner points and pushed in a little.
    points = np.array(mesh.points)
    points[[3, 7, 11], :2] *= 0.99
    source = np.array(mesh.point_source)
    source[[3, 7, 11]] = -1
    pushed = TetMesh(
        points, mesh.tets, mesh.skin, mesh.skin_face, mesh.skin_source, mesh.tet_solid, source,
        mesh.face_names,
    )  # fmt: skip
    moved, count, left = project_points(pushed, to_cylinder)
    assert (count, left) == (3, 0)
    assert np.linalg.norm(moved.points[:, :2], axis=1) == pytest.approx(5, rel=1e-14)
    far, count, left = project_points(
        pushed, lambda faces, points: points * np.array([-1.0, -1.0, 1.0])
    )
    assert (count, left) == (0, 3) and (far.volumes() > 0).all()


def test_skin_between_two_solids_is_in_both(cube_tets: TetMesh) -> None:
    rows, owner = skin.skin_of(cube_tets.tets, [0, 0, 0, 1, 1, 1])
    assert len(rows) == 12 + 2 * 2
    assert np.bincount(owner).sum() == 16
    plain, _ = skin.skin_of(cube_tets.tets, np.zeros(6))
    assert {tuple(np.roll(t, -int(np.argmin(t)))) for t in plain.tolist()} == {
        tuple(np.roll(t, -int(np.argmin(t)))) for t in cube_tets.skin.tolist()
    }
