# SPDX-License-Identifier: LGPL-2.1-or-later
"""A turned part proposes the directions that it was made in, the largest first, no axis."""

import numpy as np
import pytest
import shapes

from freecad_tetra.directions import candidates
from freecad_tetra.model import Solid


def test_an_upright_part_proposes_nothing() -> None:
    shape = shapes.issue_8379()
    assert candidates(Solid(shape.vertices, shape.triangles)).shape == (0, 3)


def test_a_turned_part_proposes_its_own_axes() -> None:
    turn = shapes.rotation(3)
    shape = shapes.cube(2)
    corners = shape.vertices[shape.triangles]
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    _, faces = np.unique(normals, axis=0, return_inverse=True)
    vertices = (shape.vertices * [3, 2, 1]) @ turn.T
    found = candidates(Solid(vertices, shape.triangles, faces.reshape(-1), tuple("ABCDEF")))
    assert found.shape == (3, 3)
    for k, axis in enumerate((2, 1, 0)):  # by area: 6 x 4, 6 x 2, 4 x 2
        assert abs(found[k] @ turn[:, axis]) == pytest.approx(1.0, abs=1e-12)


def test_a_round_face_proposes_its_axis() -> None:
    angles = np.arange(24) * 2 * np.pi / 24
    loops = [[(r * np.cos(a), r * np.sin(a)) for a in angles] for r in (4, 3)]
    ring = shapes.prism(loops[0], loops[1], 9).moved(shapes.rotation(5))
    # Faces as in CAD: outer wall, inner wall, bottom, top.
    faces = np.tile(np.repeat([0, 1, 2, 3], 2), 24)
    names = ("Face1", "Face2", "Face3", "Face4")
    found = candidates(Solid(ring.vertices, ring.triangles, faces, names))
    assert len(found) == 1
    assert abs(found[0] @ shapes.rotation(5)[:, 2]) == pytest.approx(1.0, abs=1e-12)
