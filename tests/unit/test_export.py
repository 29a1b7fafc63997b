# SPDX-License-Identifier: LGPL-2.1-or-later
"""Files are read back by others with every cell, tetrahedron and group, and appear whole or not."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from freecad_tetra import export
from freecad_tetra.errors import UnsupportedFormat
from freecad_tetra.export.elements import elements, sides_of_skin
from freecad_tetra.io import read_mesh
from freecad_tetra.io.results import StoredCells, StoredTets, read_result
from freecad_tetra.model import ConvexCells, Solid, TetMesh

meshio = pytest.importorskip("meshio", reason="meshio is not installed")


def test_obj_cells_are_global_and_count_from_1(tmp_path: Path, two_boxes: ConvexCells) -> None:
    text = export.write(two_boxes, tmp_path / "a.obj").read_text().splitlines()
    assert [row for row in text if row[0] == "o"] == ["o cell_0", "o cell_1"]
    assert text[:2] == ["v 0 0 0", "v 0 0 1"]
    faces = [[int(w) for w in row.split()[1:]] for row in text if row[0] == "f"]
    assert len(faces) == 12 and min(map(min, faces)) == 1 and max(map(max, faces)) == 12


@pytest.mark.parametrize("suffix", [".obj", ".vtu"])
def test_cells_come_back(tmp_path: Path, two_boxes: ConvexCells, suffix: str) -> None:
    turned = ConvexCells(
        two_boxes.points / 3, two_boxes.facet_offsets, two_boxes.facet_vertices,
        two_boxes.cell_offsets, two_boxes.facet_source, two_boxes.facet_face,
        two_boxes.cell_solid, two_boxes.point_source,
    )  # fmt: skip
    found = read_result(export.write(turned, tmp_path / f"a{suffix}"))
    assert isinstance(found, StoredCells)
    assert np.array_equal(found.points, turned.points), "17 digits are enough for every bit"
    for k, loops in enumerate(found.cells):
        wanted = [turned.facet(f).tolist() for f in turned.cell_facets(k)]
        assert [x.tolist() for x in loops] == wanted


def test_vtu_cells_in_meshio(tmp_path: Path, two_boxes: ConvexCells) -> None:
    found = meshio.read(export.write(two_boxes, tmp_path / "a.vtu"))
    assert [(b.type, len(b.data)) for b in found.cells] == [("polyhedron8", 2)]
    assert found.cell_data["cell"][0].tolist() == [0, 1]
    assert found.cell_data["solid"][0].tolist() == [0, 0]


def test_glb_has_a_solid_per_cell(tmp_path: Path, two_boxes: ConvexCells) -> None:
    trimesh = pytest.importorskip("trimesh", reason="trimesh is not installed")
    scene = trimesh.load(export.write(two_boxes, tmp_path / "a.glb"))
    volumes = {name: mesh.volume for name, mesh in scene.geometry.items()}
    assert volumes == pytest.approx({"cell_0": 1.0, "cell_1": 1.5})
    colours = {tuple(m.visual.material.baseColorFactor) for m in scene.geometry.values()}
    assert len(colours) == 2
    low, high = scene.bounds
    assert np.allclose(low, [0, 0, -1], atol=1e-6), "z of CAD is up, y of glTF is up"
    assert np.allclose(high, [2.5, 1, 0], atol=1e-6)


@pytest.mark.parametrize(("suffix", "faces"), [(".brep", 11), (".step", 12)])
def test_cells_in_opencascade(
    tmp_path: Path, two_boxes: ConvexCells, suffix: str, faces: int
) -> None:
    pytest.importorskip("OCP", reason="cadquery-ocp is not installed")
    from OCP.BRepCheck import BRepCheck_Analyzer

    from freecad_tetra import brep

    shape = brep.read_shape(export.write(two_boxes, tmp_path / f"a{suffix}"))
    assert BRepCheck_Analyzer(shape).IsValid()
    solid = brep.tessellate(shape)
    assert solid.notes["brep_volume"] == pytest.approx(2.5, rel=1e-12)
    assert solid.notes["solids"] == 2
    assert len(solid.face_names) == faces, "in .brep the boxes share their common face"
    one = brep.tessellate(shape, only=1)
    assert one.volume() == pytest.approx(1.0, rel=1e-15)


def test_brep_text_needs_no_ocp(tmp_path: Path, two_boxes: ConvexCells) -> None:
    text = export.write(two_boxes, tmp_path / "a.brep").read_text()
    assert text.startswith("DBRep_DrawableShape") and "TShapes" in text
    assert text.count("\nVe\n") == 12 and text.count("\nEd\n") == 20 and text.count("\nFa\n") == 11


@pytest.mark.parametrize("order", [1, 2])
@pytest.mark.parametrize("suffix", [".vtu", ".msh", ".msh2", ".inp", ".mesh", ".vtk"])
def test_tetrahedra_in_meshio(tmp_path: Path, cube_tets: TetMesh, suffix: str, order: int) -> None:
    if suffix == ".mesh" and order == 2:
        with pytest.raises(UnsupportedFormat):
            export.write(cube_tets, tmp_path / "a.mesh", 2)
        return
    path = export.write(cube_tets, tmp_path / f"a{suffix}", order)
    found = meshio.read(path, file_format="gmsh" if suffix == ".msh2" else None)
    tets = np.vstack([b.data for b in found.cells if b.type in ("tetra", "tetra10")])
    assert tets.shape == (6, 4 if order == 1 else 10)
    corners = found.points[tets[:, :4]]
    assert np.linalg.det(corners[:, 1:] - corners[:, :1]) == pytest.approx(1.0)
    if order == 2:
        ends = [(0, 1), (1, 2), (2, 0), (0, 3), (1, 3), (2, 3)]
        for i, (a, b) in enumerate(ends):
            middle = (found.points[tets[:, a]] + found.points[tets[:, b]]) / 2
            assert np.array_equal(found.points[tets[:, 4 + i]], middle)
    else:
        assert np.array_equal(found.points, cube_tets.points)


def test_groups_of_msh(tmp_path: Path, cube_tets: TetMesh) -> None:
    for name in ("a.msh", "a.msh2"):
        found = meshio.read(export.write(cube_tets, tmp_path / name), file_format="gmsh")
        assert {k: v.tolist() for k, v in found.field_data.items()} == {
            **{f"Face{i}": [i, 2] for i in range(1, 7)},
            "Solid1": [1, 3],
        }
        for block, groups in zip(found.cells, found.cell_data["gmsh:physical"], strict=True):
            if block.type == "triangle":
                for triangle, group in zip(block.data, groups, strict=True):
                    axis, value = divmod(int(group) - 1, 2)
                    assert (found.points[triangle][:, axis] == value).all()


def test_gmsh_reads_both_versions(tmp_path: Path, cube_tets: TetMesh) -> None:
    try:
        import gmsh
    except (ImportError, OSError) as error:
        pytest.skip(f"gmsh does not load: {error}")
    gmsh.initialize(["gmsh", "-v", "1"])
    try:
        for name, order in (("a.msh", 1), ("b.msh2", 1), ("c.msh", 2), ("d.msh2", 2)):
            gmsh.clear()
            gmsh.merge(str(export.write(cube_tets, tmp_path / name, order)))
            groups = gmsh.model.getPhysicalGroups()
            names = {gmsh.model.getPhysicalName(*g) for g in groups}
            assert names == {"Solid1", *(f"Face{i}" for i in range(1, 7))}
            kinds, tags, _ = gmsh.model.mesh.getElements(3)
            assert [(int(k), len(t)) for k, t in zip(kinds, tags, strict=True)] == [
                (4 if order == 1 else 11, 6)
            ]
            volumes = gmsh.model.mesh.getElementQualities(tags[0], "volume")
            assert np.asarray(volumes) == pytest.approx([1 / 6] * 6)
    finally:
        gmsh.finalize()


def test_sets_and_surfaces_of_inp(tmp_path: Path, cube_tets: TetMesh) -> None:
    text = export.write(cube_tets, tmp_path / "a.inp").read_text()
    for i in range(1, 7):
        assert f"*NSET, NSET=Face{i}\n" in text
        assert f"*SURFACE, NAME=Face{i}_surface, TYPE=ELEMENT\n" in text
    assert "*ELEMENT, TYPE=C3D4, ELSET=Solid1\n" in text
    grid = elements(cube_tets)
    sides = [[0, 1, 2], [0, 3, 1], [1, 3, 2], [2, 3, 0]]  # S1 to S4 of CalculiX
    element, side = sides_of_skin(grid, sides)
    for row in range(len(grid.skin)):
        corners = grid.tets[element[row]][sides[side[row]]]
        assert set(corners.tolist()) == set(grid.skin[row].tolist())
    nodes = text.split("*NSET, NSET=Face1\n")[1].split("*")[0].replace("\n", " ").split(",")
    assert sorted(int(n) - 1 for n in nodes) == [0, 1, 2, 3], "the nodes with x = 0"


def test_references_of_medit(tmp_path: Path, cube_tets: TetMesh) -> None:
    found = meshio.read(export.write(cube_tets, tmp_path / "a.mesh"))
    references = dict(zip([b.type for b in found.cells], found.cell_data["medit:ref"], strict=True))
    assert sorted(references["triangle"].tolist()) == sorted([1, 2, 3, 4, 5, 6] * 2)
    assert references["tetra"].tolist() == [1] * 6


def test_skin_obj_has_a_group_per_face(tmp_path: Path, cube_tets: TetMesh) -> None:
    path = export.write(cube_tets, tmp_path / "skin.obj")
    assert path.read_text().count("g Face") == 6
    assert read_mesh(path).volume() == pytest.approx(1.0, rel=1e-15)


def test_tets_come_back(tmp_path: Path, cube_tets: TetMesh) -> None:
    for order in (1, 2):
        found = read_result(export.write(cube_tets, tmp_path / "a.vtu", order))
        assert isinstance(found, StoredTets)
        assert np.array_equal(found.tets, cube_tets.tets)


def test_meshes_without_brep_faces_have_one_group(cube_tets: TetMesh) -> None:
    bare = TetMesh(
        cube_tets.points, cube_tets.tets, cube_tets.skin, np.arange(12), np.arange(12),
        cube_tets.tet_solid, cube_tets.point_source,
    )  # fmt: skip
    assert elements(bare).face_names == {0: "Skin"}


def test_surface_as_off_drops_unused_vertices(tmp_path: Path, cube_surface: Solid) -> None:
    padded = Solid(np.vstack([[[9, 9, 9]], cube_surface.vertices]), cube_surface.triangles + 1)
    found = read_mesh(export.write(padded, tmp_path / "a.off"))
    assert np.array_equal(found.vertices, cube_surface.vertices)
    assert np.array_equal(found.triangles, cube_surface.triangles)


def test_wrong_suffixes(tmp_path: Path, two_boxes: ConvexCells, cube_surface: Solid) -> None:
    for result, suffix in ((two_boxes, ".msh"), (two_boxes, ""), (cube_surface, ".stl")):
        with pytest.raises(UnsupportedFormat, match="use one of"):
            export.write(result, tmp_path / f"a{suffix}")
    assert not list(tmp_path.iterdir())


def test_nothing_is_left_after_a_failure(tmp_path: Path) -> None:
    kept = tmp_path / "a.obj"
    kept.write_text("old")
    with pytest.raises(RuntimeError), export.atomic(kept) as stream:
        stream.write(b"half")
        raise RuntimeError
    assert kept.read_text() == "old" and [p.name for p in tmp_path.iterdir()] == ["a.obj"]
    with pytest.raises(export.UnwritableFile), export.atomic(tmp_path / "none" / "a.obj"):
        pass


def test_equal_results_give_equal_bytes(tmp_path: Path, two_boxes: ConvexCells) -> None:
    for suffix in (".obj", ".vtu", ".glb", ".brep"):
        first = export.write(two_boxes, tmp_path / f"a{suffix}").read_bytes()
        assert first == export.write(two_boxes, tmp_path / f"b{suffix}").read_bytes()
