# SPDX-License-Identifier: LGPL-2.1-or-later
"""Named solids through the whole library: exact volumes, piece counts, turned and shuffled."""

from __future__ import annotations

from fractions import Fraction

import numpy as np
import pytest
import shapes

from freecad_tetra import convex_cells, tetrahedralize, validate
from freecad_tetra.model import ConvexCells, TetMesh
from freecad_tetra.verify import check_cells, check_tets

# Cells by default; more is a loss, fewer a gain to be noted here.
PIECES = {
    "cube": 1,
    "l_prism": 2,
    "boss_on_a_plate": 2,
    "cubes_touching_in_an_edge": 2,
    "cubes_touching_in_a_vertex": 2,
    "vertex_on_a_face": 2,
    "square_frame": 4,
    "nut": 6,
    "nut_turned": 6,
    "schoenhardt": 4,
}


def exact_cells_volume(cells: ConvexCells) -> Fraction:
    triangles, _ = cells.fans()
    return shapes.exact_volume(cells.points, triangles)


def exact_tets_volume(mesh: TetMesh) -> Fraction:
    sides = mesh.tets[:, [[1, 2, 3], [0, 3, 2], [0, 1, 3], [0, 2, 1]]].reshape(-1, 3)
    return shapes.exact_volume(mesh.points, sides)


@pytest.mark.parametrize("name", sorted(shapes.NAMED))
def test_validation_counts(name: str) -> None:
    shape = shapes.NAMED[name]()
    found = validate((shape.vertices, shape.triangles))
    assert not found.defects
    assert found.counts["genus"] == shape.genus
    assert not found.turned
    kinds = {
        "vertex_on_a_face": "type1_contacts",
        "cubes_touching_in_an_edge": "type2_edges",
        "cubes_touching_in_a_vertex": "type3_vertices",
    }
    for kind in ("type1_contacts", "type2_edges", "type3_vertices"):
        if name != "staircase":
            assert found.counts[kind] == (1 if kinds.get(name) == kind else 0), kind


@pytest.mark.parametrize("name", sorted(shapes.NAMED))
def test_cells(name: str) -> None:
    shape = shapes.NAMED[name]()
    cells = convex_cells((shape.vertices, shape.triangles))
    surface = validate((shape.vertices, shape.triangles)).surface()
    loops = [[cells.facet(f) for f in cells.cell_facets(k)] for k in range(len(cells))]
    check_cells(surface, cells.points, loops)
    turned = name.endswith("turned") or name == "nut"
    if turned:
        assert float(exact_cells_volume(cells)) == pytest.approx(float(shape.volume), rel=1e-12)
    else:
        assert exact_cells_volume(cells) == shape.volume
    if name in PIECES:
        assert len(cells) == PIECES[name]
    kept = cells.point_source >= 0
    assert np.array_equal(cells.points[kept], shape.vertices[cells.point_source[kept]])
    assert cells.report.verdict == "verified"


@pytest.mark.parametrize("name", sorted(shapes.NAMED))
def test_tets(name: str) -> None:
    shape = shapes.NAMED[name]()
    mesh = tetrahedralize((shape.vertices, shape.triangles))
    surface = validate((shape.vertices, shape.triangles)).surface()
    check_tets(surface, mesh.points, mesh.tets)
    wanted = shapes.exact_volume(shape.vertices, shape.triangles)
    if name.endswith("turned") or name == "nut":  # facets that are planar in CAD, not in doubles
        assert float(exact_tets_volume(mesh)) == pytest.approx(float(wanted), rel=1e-14)
    else:
        assert exact_tets_volume(mesh) == wanted
    kept = mesh.point_source[mesh.point_source >= 0]
    assert set(kept.tolist()) == set(range(len(shape.vertices))), "no input vertex is lost"
    known = mesh.point_source >= 0
    assert np.array_equal(mesh.points[known], shape.vertices[kept])
    normals = np.cross(
        *(
            shape.vertices[shape.triangles[mesh.skin_source, i]]
            - shape.vertices[shape.triangles[mesh.skin_source, 0]]
            for i in (1, 2)
        )
    )
    own = np.cross(*(mesh.points[mesh.skin[:, i]] - mesh.points[mesh.skin[:, 0]] for i in (1, 2)))
    assert (np.einsum("ij,ij->i", normals, own) > 0).all(), "skin faces as its source does"


@pytest.mark.parametrize("name", ["issue_8379", "staircase", "cube_with_cavity"])
def test_equal_input_gives_equal_output(name: str) -> None:
    shape = shapes.NAMED[name]()
    runs = [convex_cells((shape.vertices, shape.triangles)) for _ in range(2)]
    assert runs[0].points.tobytes() == runs[1].points.tobytes()
    assert runs[0].facet_vertices.tobytes() == runs[1].facet_vertices.tobytes()
    meshes = [tetrahedralize((shape.vertices, shape.triangles)) for _ in range(2)]
    assert meshes[0].points.tobytes() == meshes[1].points.tobytes()
    assert meshes[0].tets.tobytes() == meshes[1].tets.tobytes()


@pytest.mark.parametrize("seed", range(5))
def test_rotations(seed: int) -> None:
    shape = shapes.issue_8379().moved(shapes.rotation(seed))
    assert convex_cells((shape.vertices, shape.triangles)).volumes().sum() == pytest.approx(
        720, rel=1e-12
    )
    assert tetrahedralize((shape.vertices, shape.triangles)).volumes().sum() == pytest.approx(
        720, rel=1e-12
    )


def test_progress_and_cancel() -> None:
    shape = shapes.issue_8379()
    stages: list[str] = []

    def told(stage: str, fraction: float) -> None:
        assert 0 <= fraction <= 1
        stages.append(stage)

    convex_cells((shape.vertices, shape.triangles), progress=told)
    assert stages[0] == "read"
