# SPDX-License-Identifier: LGPL-2.1-or-later
"""Cells are divided so that neighbours share whole faces, and stay closed."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest
import shapes

from freecad_tetra import convex_cells, export
from freecad_tetra.export import brep_tables
from freecad_tetra.export.brep_tables import Tables
from freecad_tetra.model import ConvexCells, Solid, TetMesh

pytest.importorskip("_tetra_kernel", reason="the kernel is not built")


def facet_areas(table: Tables) -> Any:
    """Return the area vectors of all facets, holes taken off, (F, 3)."""
    points, corners = table.points, table.corners
    after = corners[brep_tables.following(table.starts)]
    loops = np.add.reduceat(np.cross(points[corners], points[after]), table.starts[:-1], axis=0)
    return np.add.reduceat(loops, table.loops[:-1], axis=0) / 2


def assert_closed(table: Tables) -> None:
    """Every piece uses each of its directed edges once, and the opposite once."""
    after = table.corners[brep_tables.following(table.starts)]
    piece = table.piece[table.facet_of_corner()]
    there = np.stack([piece, table.corners, after], axis=1)
    assert len(np.unique(there, axis=0)) == len(there)
    back = there[:, [0, 2, 1]]
    np.testing.assert_array_equal(np.unique(there, axis=0), np.unique(back, axis=0))


def assert_shared(cells: ConvexCells, table: Tables) -> None:
    """The faces inside are those of two pieces, and they are all that lies inside."""
    inside = (table.sides() >= 0).all(axis=1)
    areas = np.linalg.norm(facet_areas(table), axis=1)
    inner = cells.facet_source[table.facet] < 0
    assert areas[inner & ~inside[table.face]].sum() == pytest.approx(0.0, abs=1e-9 * areas.sum())
    both = np.flatnonzero(inside)
    front, back = (np.zeros((len(both), 3)) for _ in range(2))
    order = np.searchsorted(both, table.face)
    own = inside[table.face]
    other = table.reversed_facets()
    front[order[own & ~other]] = facet_areas(table)[own & ~other]
    back[order[own & other]] = facet_areas(table)[own & other]
    np.testing.assert_allclose(front, -back, atol=1e-9)


def whole_areas(cells: ConvexCells) -> Any:
    """Return the area vector of every facet as it was given, (F, 3)."""
    return facet_areas(brep_tables.tables(cells))


NAMED = (
    shapes.cube, shapes.l_prism, shapes.boss_on_a_plate, shapes.cube_with_cavity,
    shapes.square_frame, shapes.cubes_touching_in_an_edge, shapes.vertex_on_a_face,
    shapes.staircase, shapes.issue_8379, shapes.nut, shapes.schoenhardt,
)  # fmt: skip


@pytest.mark.parametrize("shape", NAMED, ids=lambda shape: shape.__name__)
@pytest.mark.parametrize("plain", [False, True])
def test_named_solids(shape: Any, plain: bool) -> None:
    made = shape()
    cells = convex_cells(Solid(made.vertices, made.triangles), plain=plain, merge=not plain)
    table = brep_tables.tables(cells, share=True)
    assert_closed(table)
    assert_shared(cells, table)
    totals = np.zeros((len(cells.facet_source), 3))
    np.add.at(totals, table.facet, facet_areas(table))
    np.testing.assert_allclose(totals, whole_areas(cells), atol=1e-9)


@pytest.mark.parametrize("seed", range(6))
def test_thin_cells_stay_closed(seed: int) -> None:
    """A turned solid has no exact planes: its cells are partly thinner than points are exact."""
    made = shapes.issue_8379().moved(shapes.rotation(seed))
    cells = convex_cells(Solid(made.vertices, made.triangles), plain=True, merge=False)
    table = brep_tables.tables(cells, share=True)
    assert_closed(table)
    inside = (table.sides() >= 0).all(axis=1)
    areas = np.linalg.norm(facet_areas(table), axis=1)
    inner = cells.facet_source[table.facet] < 0
    assert areas[inner & inside[table.face]].sum() > 0.9 * areas[inner].sum()


def test_cells_left_alone_are_not_divided(two_boxes: ConvexCells) -> None:
    table = brep_tables.tables(two_boxes, share=True)
    assert len(table.first) == 11
    alone = brep_tables.tables(two_boxes, True, [0])
    assert len(alone.first) == 11, "whole faces are shared all the same"


def test_tetrahedra_as_cells(cube_tets: TetMesh, tmp_path: Path) -> None:
    cells = brep_tables.cells_of_tets(cube_tets)
    np.testing.assert_allclose(cells.volumes(), cube_tets.volumes())
    assert sorted(cells.facet_face[cells.facet_face >= 0].tolist()) == sorted(
        cube_tets.skin_face.tolist()
    )
    table = brep_tables.tables(cells)
    assert_closed(table)
    assert len(table.first) == 18 and (table.sides() >= 0).all(axis=1).sum() == 6
    text = export.write(cube_tets, tmp_path / "cube.brep").read_text()
    assert text.count("\nSo\n") == 6
