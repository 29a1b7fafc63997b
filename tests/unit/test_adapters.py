# SPDX-License-Identifier: LGPL-2.1-or-later
"""Shapes come in with their names, and results go out and back with volume and labels."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import build123d
import cadquery as cq
import gmsh
import meshio
import numpy as np
import pytest
import shapes
import trimesh

import freecad_tetra.cq
from freecad_tetra import (
    ConvexCells,
    InvalidSolid,
    Labels,
    TetMesh,
    TetraError,
    as_solid,
    convex_cells,
    tetrahedralize,
)
from freecad_tetra.labels import distinct, group_name

EXACT = 1e-9


def plate() -> cq.Workplane:
    """A plate with a square pocket; tags on the solid and on faces, one made before the cut."""
    block = cq.Workplane().box(40, 30, 10).faces("<X").tag("clamped").end().faces(">Z").tag("top")
    cut = block.workplane().rect(20, 10).cutBlind(-5)
    return cut.faces("|Z").tag("flat").end().solids().tag("plate").end()


def assembly() -> cq.Assembly:
    """Two placed parts that share a face's place, and a third away from them."""
    whole = cq.Assembly(name="whole")
    whole.add(cq.Workplane().box(10, 10, 10), name="base")
    whole.add(plate(), name="lid", loc=cq.Location((0.0, 0.0, 10.0)))
    whole.add(cq.Workplane().box(2, 2, 2), name="base_pin", loc=cq.Location((50.0, 0.0, 0.0)))
    return whole


VOLUME_OF_PLATE = 40 * 30 * 10 - 20 * 10 * 5
VOLUME_OF_ASSEMBLY = 1000 + VOLUME_OF_PLATE + 8


def faces_at(result: TetMesh | ConvexCells, name: str) -> tuple[int, ...]:
    return result.labels.faces[name]


def test_tags_name_solids_and_groups_of_faces() -> None:
    mesh = tetrahedralize(plate())
    assert mesh.labels.solids == ("plate",)
    assert set(mesh.labels.faces) == {"clamped", "top", "flat"}
    skin = mesh.points[mesh.skin]
    clamped = skin[np.isin(mesh.skin_face, faces_at(mesh, "clamped"))]
    assert (clamped[:, :, 0] == -20).all()
    top = np.isin(mesh.skin_face, faces_at(mesh, "top"))
    # What the pocket left of the face that was tagged before it.
    assert (skin[top][:, :, 2] == 5).all()
    a, b = skin[top][:, 1] - skin[top][:, 0], skin[top][:, 2] - skin[top][:, 0]
    assert np.linalg.norm(np.cross(a, b), axis=1).sum() / 2 == pytest.approx(40 * 30 - 20 * 10)
    assert len(faces_at(mesh, "flat")) == 3


def test_a_tag_of_what_is_gone_names_nothing() -> None:
    cut = cq.Workplane().box(10, 10, 10).faces(">X").tag("end").end()
    short = cut.intersect(cq.Workplane().box(4, 10, 10))
    short.ctx.tags = dict(cut.ctx.tags)
    assert as_solid(short).labels == Labels()


def test_assembly_parts_are_placed_and_keep_their_names() -> None:
    mesh = tetrahedralize(assembly())
    assert mesh.labels.solids == ("base", "lid", "base_pin")
    sums = np.bincount(mesh.tet_solid, mesh.volumes())
    assert sums == pytest.approx([1000, VOLUME_OF_PLATE, 8], rel=EXACT)
    assert mesh.points[mesh.tets[mesh.tet_solid == 2]][:, :, 0].min() == 49
    # Groups are named after their part first.
    assert set(mesh.labels.faces) == {"lid_clamped", "lid_top", "lid_flat"}


def test_subshape_names_of_an_assembly_become_groups() -> None:
    box = cq.Workplane().box(1, 1, 1)
    whole = cq.Assembly(name="whole").add(box, name="box", loc=cq.Location((5.0, 0.0, 0.0)))
    whole.children[0].addSubshape(box.faces(">Z").val(), name="lid")
    solid = as_solid(whole)
    ((name, faces),) = solid.labels.faces.items()
    assert name == "box_lid"
    rows = solid.vertices[solid.triangles[np.isin(solid.face_ids, faces)]]
    assert (rows[:, :, 2] == 0.5).all() and rows[:, :, 0].min() == 4.5


def test_a_selection_on_a_solid_stands_for_the_solid() -> None:
    assert as_solid(plate().faces(">Z").edges()).volume() == pytest.approx(VOLUME_OF_PLATE)


def test_a_solid_of_a_sketch() -> None:
    sketch = cq.Sketch().rect(4, 3).push([(0, 0)]).rect(1, 1, mode="s")
    assert as_solid(cq.Workplane().placeSketch(sketch).extrude(2)).volume() == pytest.approx(22)


def builder() -> Any:
    with build123d.BuildPart() as made:
        build123d.Box(4, 3, 2)
        with build123d.Locations((0, 0, 1)):
            build123d.Box(2, 1, 2, mode=build123d.Mode.SUBTRACT)
    made.part.label = "block"
    return made


def test_build123d_builders_parts_and_labels() -> None:
    assert as_solid(builder()).volume() == pytest.approx(24 - 2)
    assert as_solid(builder()).labels.solids == ("block",)
    assert as_solid(builder().part.solid()).volume() == pytest.approx(22)
    moved = build123d.Pos(9, 0, 0) * build123d.Box(1, 1, 1)
    moved.label = "pin"
    nested = build123d.Compound(
        label="inner", children=[moved, build123d.Pos(0, 9, 0) * build123d.Box(1, 1, 1)]
    )
    whole = build123d.Compound(label="whole", children=[builder().part, nested])
    cells = convex_cells(build123d.Pos(100, 0, 0) * whole)
    assert cells.labels.solids == ("block", "pin", "inner")
    assert cells.points[:, 0].min() == pytest.approx(98)
    assert convex_cells([builder(), moved]).labels.solids == ("block", "pin")


@pytest.mark.parametrize("what", ["sketch", "rectangle", "nothing", "number"])
def test_what_holds_no_solid_is_refused(what: str) -> None:
    with build123d.BuildSketch() as flat:
        build123d.Rectangle(1, 1)
    given = {
        "sketch": flat,
        "rectangle": cq.Workplane().rect(1, 1),
        "nothing": cq.Workplane(),
        "number": 5,
    }[what]
    with pytest.raises(TetraError):
        as_solid(given)


@pytest.mark.parametrize("function", [tetrahedralize, convex_cells])
def test_cadquery_round_trip(function: Any) -> None:
    result = function(assembly())
    back = result.to_cadquery()
    assert isinstance(back, cq.Compound) and back.isValid()
    assert back.Volume() == pytest.approx(VOLUME_OF_ASSEMBLY, rel=EXACT)
    solids = list(back)
    assert [s.Volume() for s in solids] == pytest.approx(result.volumes().tolist(), rel=1e-7)


def test_neighbours_share_their_faces() -> None:
    mesh = tetrahedralize(cq.Workplane().box(60, 40, 10).faces(">Z").workplane().hole(12))
    one, other = mesh.to_cadquery(), mesh.to_build123d()
    assert one.isValid()
    # Face to face: every side inside belongs to two tetrahedra.
    assert len(one.Faces()) == len(other.faces()) == (4 * len(mesh) + len(mesh.skin)) // 2


def test_convex_cells_of_cadquery_chain_on() -> None:
    found = plate().convexCells()
    assert isinstance(found, cq.Workplane)
    assert all(s.label.startswith("plate_cell_") for s in found.vals())
    assert found.size() == len(convex_cells(plate()))
    assert plate().invoke(freecad_tetra.cq.convex_cells).size() == found.size()
    again = tetrahedralize(found)
    assert again.volumes().sum() == pytest.approx(VOLUME_OF_PLATE, rel=EXACT)
    assert again.labels.solids[: found.size()]
    assert assembly().tetrahedralize().labels.solids == ("base", "lid", "base_pin")
    assert sum(s.Volume() for s in assembly().convexCells().vals()) == pytest.approx(
        VOLUME_OF_ASSEMBLY
    )


@pytest.mark.parametrize("function", [tetrahedralize, convex_cells])
def test_build123d_round_trip(function: Any) -> None:
    result = function(assembly())
    back = result.to_build123d()
    assert sum(s.volume for s in back.children) == pytest.approx(VOLUME_OF_ASSEMBLY, rel=EXACT)
    assert len(back.children) == len(result)
    # The pieces come in again under the labels that they went out with.
    again = convex_cells(back)
    assert again.labels.solids == tuple(s.label for s in back.children)
    assert again.volumes().sum() == pytest.approx(VOLUME_OF_ASSEMBLY, rel=EXACT)


def test_cells_are_the_list_that_trimesh_users_expect() -> None:
    cells = convex_cells(assembly())
    meshes = cells.to_trimesh()
    assert all(isinstance(m, trimesh.Trimesh) and m.is_watertight and m.is_convex for m in meshes)
    assert [m.volume for m in meshes] == pytest.approx(cells.volumes().tolist(), rel=1e-9)
    assert {m.metadata["solid"] for m in meshes} == {"base", "lid", "base_pin"}


def test_trimesh_and_scene_round_trips() -> None:
    mesh = tetrahedralize(assembly())
    skin = mesh.to_trimesh()
    assert skin.volume == pytest.approx(VOLUME_OF_ASSEMBLY, rel=EXACT)
    assert (skin.face_attributes["face"] == mesh.skin_face).all()
    scene = mesh.to_scene()
    assert {n: g.volume for n, g in scene.geometry.items()} == pytest.approx(
        {"base": 1000, "lid": VOLUME_OF_PLATE, "base_pin": 8}, rel=EXACT
    )
    again = tetrahedralize(scene)
    assert again.labels.solids == ("base", "lid", "base_pin")
    assert np.bincount(again.tet_solid, again.volumes()) == pytest.approx(
        [1000, VOLUME_OF_PLATE, 8], rel=EXACT
    )
    cells = convex_cells(assembly())
    assert as_solid(cells.to_scene()).labels.solids == tuple(cells.to_scene().geometry)


def test_a_scene_places_and_mirrors_its_meshes() -> None:
    scene = trimesh.Scene()
    box = trimesh.creation.box([1, 1, 1])
    scene.add_geometry(box, node_name="here", geom_name="box")
    mirror = np.diag([-1.0, 1, 1, 1])
    mirror[0, 3] = 5
    scene.graph.update("there", geometry="box", matrix=mirror)
    scene.add_geometry(trimesh.load_path([[0, 0, 0], [1, 1, 1]]), node_name="line")
    solid = as_solid(scene)
    assert solid.labels.solids == ("here", "there")
    assert solid.volume() == pytest.approx(2)
    with pytest.raises(InvalidSolid, match="empty"):
        as_solid(trimesh.Scene())


def test_touching_solids_find_their_own_skin() -> None:
    mesh = tetrahedralize(assembly())
    for name, skin in mesh.to_scene().geometry.items():
        assert skin.is_watertight, name


def test_meshio_gets_sets_and_survives_a_file(tmp_path: Path) -> None:
    mesh = tetrahedralize(plate())
    found = mesh.to_meshio()
    points = found.points[found.cells_dict["tetra"]]
    assert np.linalg.det(points[:, 1:] - points[:, :1]).sum() / 6 == pytest.approx(VOLUME_OF_PLATE)
    rows = found.cell_sets["top"][1]
    assert (
        np.isin(mesh.skin_face[rows], faces_at(mesh, "top")).all()
        and len(rows) == np.isin(mesh.skin_face, faces_at(mesh, "top")).sum()
    )
    assert len(found.cell_sets["plate"][0]) == len(mesh)
    cells = convex_cells(plate()).to_meshio()
    cells.write(tmp_path / "cells.vtu")
    back = meshio.read(tmp_path / "cells.vtu")
    assert sum(len(block) for block in back.cells) == len(convex_cells(plate()))


@pytest.mark.parametrize("function", [tetrahedralize, convex_cells])
def test_pyvista_grid_has_the_volume_and_the_names(function: Any) -> None:
    result = function(assembly())
    grid = result.to_pyvista()
    sizes = np.asarray(grid.compute_cell_sizes(length=False, area=False)["Volume"])
    assert sizes == pytest.approx(result.volumes(), rel=1e-7)
    assert (grid.cell_data["piece"] == np.arange(len(result))).all()
    assert list(grid.field_data["solid_names"]) == ["base", "lid", "base_pin"]


def test_plot_draws_the_pieces(tmp_path: Path) -> None:
    picture = tmp_path / "plot.png"
    convex_cells(plate()).plot(explode=0.3, off_screen=True, screenshot=picture)
    pixels = np.asarray(__import__("PIL.Image", fromlist=["open"]).open(picture).convert("RGB"))
    assert len(np.unique(pixels.reshape(-1, 3), axis=0)) > 5


def test_gmsh_finds_overlapping_groups(tmp_path: Path) -> None:
    file = tetrahedralize(plate()).write(tmp_path / "plate.msh")
    gmsh.initialize()
    try:
        gmsh.option.setNumber("General.Terminal", 0)
        gmsh.open(str(file))
        groups = {
            gmsh.model.getPhysicalName(d, t): (d, t) for d, t in gmsh.model.getPhysicalGroups()
        }
        top = gmsh.model.getEntitiesForPhysicalGroup(*groups["top"])
        flat = gmsh.model.getEntitiesForPhysicalGroup(*groups["flat"])
        assert len(top) == 1 and set(top) < set(flat) and len(flat) == 3
        assert groups["plate"][0] == 3
    finally:
        gmsh.finalize()


def test_names_are_made_distinct_and_plain() -> None:
    assert distinct(["a", "", "a", "b", "", "a"]) == ("a", "", "a_2", "b", "", "a_3")
    assert group_name(" left / upper side ") == "left_upper_side"


def test_a_mesh_without_faces_has_no_groups() -> None:
    shape = shapes.l_prism()
    found = tetrahedralize((shape.vertices, shape.triangles)).to_meshio()
    assert list(found.cell_sets) == ["Solid1"]
