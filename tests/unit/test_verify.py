# SPDX-License-Identifier: LGPL-2.1-or-later
"""The verifier accepts true partitions and rejects every single fault put into them."""

from __future__ import annotations

from fractions import Fraction

import numpy as np
import pytest
import shapes

from freecad_tetra.errors import Cancelled, VerificationFailed
from freecad_tetra.model import ConvexCells, Solid, TetMesh
from freecad_tetra.verify import check_cells, check_tets, orientations


def loops(cells: ConvexCells) -> list[list[np.ndarray]]:
    return [[cells.facet(f) for f in cells.cell_facets(k)] for k in range(len(cells))]


@pytest.fixture
def block() -> Solid:
    """The surface around both boxes of `two_boxes`."""
    cube = shapes.cube(1)
    return Solid(cube.vertices * [2.5, 1, 1], cube.triangles)


def test_true_cells_pass(two_boxes: ConvexCells, block: Solid) -> None:
    found = check_cells(block, two_boxes.points, loops(two_boxes))
    assert found["cells"] == 2 and found["volume"] == pytest.approx(2.5)


def test_a_missing_cell_fails(two_boxes: ConvexCells, block: Solid) -> None:
    with pytest.raises(VerificationFailed, match="volume"):
        check_cells(block, two_boxes.points, loops(two_boxes)[:1])


def test_an_open_cell_fails(two_boxes: ConvexCells, block: Solid) -> None:
    cells = loops(two_boxes)
    cells[1].pop()
    with pytest.raises(VerificationFailed) as caught:
        check_cells(block, two_boxes.points, cells)
    assert caught.value.cells == (1,)


def test_an_inverted_cell_fails(two_boxes: ConvexCells, block: Solid) -> None:
    cells = loops(two_boxes)
    cells[0] = [loop[::-1] for loop in cells[0]]
    with pytest.raises(VerificationFailed):
        check_cells(block, two_boxes.points, cells)


def test_a_concave_cell_fails() -> None:
    shape = shapes.l_prism()
    with pytest.raises(VerificationFailed, match="convex"):
        check_cells(Solid(shape.vertices, shape.triangles), shape.vertices, [list(shape.triangles)])


def test_overlap_and_gap_of_equal_volume_fail(two_boxes: ConvexCells) -> None:
    left = shapes.cube(1)
    two = Solid(
        np.vstack([left.vertices, left.vertices + np.array([5, 0, 0])]),
        np.vstack([left.triangles, left.triangles + 8]),
    )
    cell = list(left.triangles)
    with pytest.raises(VerificationFailed, match="in two cells"):
        check_cells(two, left.vertices, [cell, cell])


def test_true_tets_pass(cube_tets: TetMesh, cube_surface: Solid) -> None:
    found = check_tets(cube_surface, cube_tets.points, cube_tets.tets)
    assert found == {
        "tetrahedra": 6, "points": 8, "volume": pytest.approx(1.0),
        "volume_error": pytest.approx(0.0, abs=1e-15), "boundary_triangles": 12,
    }  # fmt: skip


def test_faults_in_tets(cube_tets: TetMesh, cube_surface: Solid) -> None:
    points, tets = cube_tets.points, cube_tets.tets.astype(np.int64)
    inverted = tets.copy()
    inverted[2, [0, 1]] = inverted[2, [1, 0]]
    with pytest.raises(VerificationFailed, match="inverted") as caught:
        check_tets(cube_surface, points, inverted)
    assert caught.value.cells == (2,)
    with pytest.raises(VerificationFailed):
        check_tets(cube_surface, points, tets[:-1])
    with pytest.raises(VerificationFailed, match="face to face"):
        check_tets(cube_surface, points, np.vstack([tets, tets[:1]]))
    moved = points.copy()
    moved[7] += 0.1
    with pytest.raises(VerificationFailed, match="volume"):
        check_tets(cube_surface, moved, tets)


def test_orientation_is_exact() -> None:
    tiny = 2.0**-60
    base = [[0.1, 0.2, 0.3], [1.1, 0.2, 0.3], [0.1, 1.2, 0.3]]
    heights = [0.3, np.nextafter(0.3, 1), np.nextafter(0.3, 0), 0.3 + tiny]
    corners = np.array([[*base, [0.7, 0.7, z]] for z in heights])
    assert orientations(corners).tolist() == [0, 1, -1, 0]
    random = np.random.default_rng(4).integers(-3, 4, (300, 4, 3)).astype(float)
    for corner, sign in zip(random, orientations(random), strict=True):
        m = [[Fraction(float(x)) for x in row - corner[0]] for row in corner[1:]]
        value = sum(
            m[0][i]
            * (m[1][(i + 1) % 3] * m[2][(i + 2) % 3] - m[1][(i + 2) % 3] * m[2][(i + 1) % 3])
            for i in range(3)
        )
        assert sign == (value > 0) - (value < 0)


def test_it_can_be_cancelled(cube_tets: TetMesh, cube_surface: Solid) -> None:
    with pytest.raises(Cancelled):
        check_tets(cube_surface, cube_tets.points, cube_tets.tets, lambda *_: False)
