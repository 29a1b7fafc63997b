# SPDX-License-Identifier: LGPL-2.1-or-later
"""Solids in contact get one face-to-face mesh, whatever their triangulations and sizes are."""

from __future__ import annotations

from itertools import permutations

import numpy as np
import pytest
from assemblies import around_an_edge, assembly, box, contact_area, shared_voxels

from freecad_tetra import kernel

TOUCHING = {
    "side_by_side": ([[box((0, 0, 0), (1, 1, 1))], [box((1, 0, 0), (2, 1, 1), 1)]], 1),
    "small_on_large": ([[box((0, 0, 0), (3, 3, 1))], [box((1, 1, 1), (2, 2, 2), 1)]], 1),
    "overlapping_sides": (
        [[box((0, 0, 0), (1, 1, 1))], [box((0.3, 0.4, 1), (1.7, 1.9, 2), 1)]],
        0.7 * 0.6,
    ),
    "odd_coordinates": (
        [[box((0.1, 0.2, 0.3), (1.37, 1.1, 1.77))], [box((0.33, 0.41, 1.77), (1.7, 1.9, 2.2), 1)]],
        (1.37 - 0.33) * (1.1 - 0.41),
    ),
    "filled_cavity": (
        [
            [box((0, 0, 0), (3, 3, 3)), box((1, 1, 1), (2, 2, 2), 0, True)],
            [box((1, 1, 1), (2, 2, 2), 1)],
        ],
        6,
    ),
    "three_at_an_edge": (
        [
            [box((0, 0, 0), (2, 1, 1))],
            [box((0, 1, 0), (0.7, 2, 1), 1)],
            [box((0.7, 1, 0), (2, 2, 1.5))],
        ],
        3,
    ),
    "apart": ([[box((0, 0, 0), (1, 1, 1))], [box((2, 0, 0), (3, 1, 1), 1)]], 0),
}


@pytest.mark.parametrize("method", ["chazelle-palios", "bajaj-dey"])
@pytest.mark.parametrize("name", TOUCHING)
def test_contact_is_face_to_face(name, method):
    solids, area = TOUCHING[name]
    surface = assembly(*solids)
    mesh = kernel.tetrahedralize(surface, {"method": method})
    assert contact_area(mesh) == pytest.approx(area, rel=1e-14)
    assert mesh.report.volume_error < 1e-14
    lost = set(map(tuple, surface.vertices)) - set(map(tuple, mesh.points))
    assert not lost, "every vertex comes back bit for bit"
    for face in range(len(surface.face_names)):  # groups stay complete on both sides
        wanted = area_of(surface.vertices[surface.triangles[surface.face_ids == face]])
        found = area_of(mesh.points[mesh.skin[mesh.skin_face == face]])
        assert found == pytest.approx(wanted, rel=1e-12)


def area_of(corners):
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    return np.linalg.norm(normals, axis=1).sum() / 2


@pytest.mark.parametrize("slanted", [False, True])
@pytest.mark.parametrize("method", ["chazelle-palios", "bajaj-dey"])
def test_random_assemblies(method, slanted):
    for seed in range(25):
        surface, area = shared_voxels(seed, slanted)
        mesh = kernel.tetrahedralize(surface, {"method": method})
        assert contact_area(mesh) == pytest.approx(area, rel=1e-9)


NOTHING_REMOVED = {"compact": "off", "pull_off": "off"}


@pytest.mark.parametrize("seed", [38, 41, 75, 80, 109])
@pytest.mark.parametrize("direction", ["auto", "x", "y", "z"])
def test_steiner_points_of_a_contact_go_into_both_meshes(seed, direction):
    """Without compaction each solid needs points on contacts that the other doesn't."""
    surface, area = shared_voxels(seed, slanted=True)
    mesh = kernel.tetrahedralize(surface, NOTHING_REMOVED | {"direction": direction})
    assert contact_area(mesh) == pytest.approx(area, rel=1e-9)
    assert mesh.report.repairs["contact_points"] > 0
    assert (mesh.volumes() > 0).all()
    assert mesh.report.volume_error < 1e-14


@pytest.mark.parametrize("numbers", list(permutations(range(3))))
def test_steiner_points_of_an_edge_go_round_it(numbers):
    """The first and the last solid share only this edge; the one between has to fit both."""
    put = 0
    for seed in range(3):
        surface, area = around_an_edge(seed, numbers)
        mesh = kernel.tetrahedralize(surface, NOTHING_REMOVED | {"direction": "x"})
        assert contact_area(mesh) == pytest.approx(area, rel=1e-9)
        assert mesh.report.volume_error < 1e-14
        put += mesh.report.repairs["contact_points"]
    assert put > 0


@pytest.mark.parametrize("seed", [99, 112])
def test_a_contact_too_fine_for_the_later_solid_is_made_by_it(seed):
    """Steiner points of the first solid lie closer to each other than the finest grid."""
    surface, area = shared_voxels(seed, slanted=True)
    mesh = kernel.tetrahedralize(surface, NOTHING_REMOVED | {"direction": "x"})
    assert contact_area(mesh) == pytest.approx(area, rel=1e-9)
    assert (np.diff(mesh.tet_solid) >= 0).all(), "in the order of the solids all the same"
    attempts = [a for solid in mesh.report.details["solids"] for a in solid["failed_attempts"]]
    assert any("goes first" in attempt for attempt in attempts)


def test_repetition_gives_equal_bytes():
    surface = assembly(*TOUCHING["three_at_an_edge"][0])
    a, b = (kernel.tetrahedralize(surface) for _ in range(2))
    assert a.points.tobytes() == b.points.tobytes() and a.tets.tobytes() == b.tets.tobytes()
