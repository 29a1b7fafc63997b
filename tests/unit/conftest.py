# SPDX-License-Identifier: LGPL-2.1-or-later
"""What the unit tests share: named shapes, two adjacent boxes as cells, a cube of tetrahedra."""

from __future__ import annotations

import sys
from pathlib import Path

import numpy as np
import pytest

sys.path.insert(0, str(Path(__file__).parents[1]))

from freecad_tetra.model import ConvexCells, Solid, TetMesh


@pytest.fixture
def two_boxes() -> ConvexCells:
    """Two boxes along x with a common face: volumes 1 and 1.5."""
    points = [(x, y, z) for x in (0, 1, 2.5) for y in (0, 1) for z in (0, 1)]
    loops = []
    for i in (0, 4):
        loops += [
            [i, i + 1, i + 3, i + 2], [i + 4, i + 6, i + 7, i + 5], [i, i + 4, i + 5, i + 1],
            [i + 2, i + 3, i + 7, i + 6], [i, i + 2, i + 6, i + 4], [i + 1, i + 5, i + 7, i + 3],
        ]  # fmt: skip
    return ConvexCells(
        points=np.array(points, float),
        facet_offsets=np.arange(13) * 4,
        facet_vertices=np.concatenate(loops),
        cell_offsets=[0, 6, 12],
        facet_source=np.full(12, -1),
        facet_face=np.full(12, -1),
        cell_solid=[0, 0],
        point_source=np.full(12, -1),
    )


@pytest.fixture
def cube_tets() -> TetMesh:
    """The unit cube in Kuhn's six tetrahedra, with six named faces."""
    points = np.array([(x, y, z) for x in (0, 1) for y in (0, 1) for z in (0, 1)], float)
    tets = np.array(
        [(0, 4, 6, 7), (0, 6, 2, 7), (0, 2, 3, 7), (0, 3, 1, 7), (0, 1, 5, 7), (0, 5, 4, 7)]
    )
    sides = tets[:, [[1, 2, 3], [0, 3, 2], [0, 1, 3], [0, 2, 1]]].reshape(-1, 3)
    skin, face = [], []
    for side in sides:
        for axis in range(3):
            for value in (0, 1):
                if (points[side][:, axis] == value).all():
                    skin.append(side)
                    face.append(2 * axis + value)
    names = tuple(f"Face{i + 1}" for i in range(6))
    return TetMesh(
        points, tets, skin, face, np.arange(12), np.zeros(6), np.arange(8), names
    )  # fmt: skip


@pytest.fixture
def cube_surface(cube_tets: TetMesh) -> Solid:
    """The surface that `cube_tets` fills."""
    return Solid(cube_tets.points, cube_tets.skin, cube_tets.skin_face, cube_tets.face_names)
