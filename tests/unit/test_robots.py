# SPDX-License-Identifier: LGPL-2.1-or-later
"""Robot models load in the real engines, weigh what the solid weighs, and hold or let through."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from xml.etree import ElementTree

import mujoco
import numpy as np
import pybullet
import pytest
import trimesh

from freecad_tetra import BadOption, ConvexCells, convex_cells, mass, tetrahedralize
from freecad_tetra.export import drake, parts

SIZE, HOLE, THICK = 60.0, 20.0, 20.0  # mm


def plate(sides: int = 48) -> tuple[np.ndarray, np.ndarray]:
    """A square plate with a round hole in its middle, as triangles."""
    turn = 2 * np.pi * np.arange(sides) / sides
    hole = HOLE / 2 * np.stack([np.cos(turn), np.sin(turn)], axis=1)
    outer = SIZE / 2 * hole / np.abs(hole).max(axis=1, keepdims=True)
    rings = [outer, hole]
    points = np.concatenate([np.c_[r, np.full(sides, z)] for z in (0, THICK) for r in rings])
    i = np.arange(sides)
    j = (i + 1) % sides
    low_out, low_in, top_out, top_in = (k * sides for k in range(4))

    def quads(a: int, b: int) -> list[np.ndarray]:
        return [np.c_[a + i, a + j, b + j], np.c_[a + i, b + j, b + i]]

    faces = [*quads(low_in, low_out), *quads(top_out, top_in)]
    faces += [*quads(low_out, top_out), *quads(top_in, low_in)]
    return points, np.concatenate(faces)


def hull_of(cells: ConvexCells) -> ConvexCells:
    """One cell: the hull of all."""
    hull = trimesh.convex.convex_hull(cells.points)
    points, triangles = np.asarray(hull.vertices), np.asarray(hull.faces)
    count = len(triangles)
    return ConvexCells(
        points, np.arange(count + 1) * 3, triangles.reshape(-1), [0, count],
        np.full(count, -1), np.full(count, -1), [0], np.full(len(points), -1),
    )  # fmt: skip


def height_after_fall(model: Path, x: float) -> float:
    """Drop a peg from above the plate at `x` (metres); return where its middle is later."""
    spec = mujoco.MjSpec.from_file(str(model))
    peg = spec.worldbody.add_body(name="peg", pos=[x, 0, 0.05])
    peg.add_freejoint()
    peg.add_geom(type=mujoco.mjtGeom.mjGEOM_CYLINDER, size=[0.0085, 0.015, 0], density=1000)
    compiled = spec.compile()
    data = mujoco.MjData(compiled)
    while data.time < 0.6:
        mujoco.mj_step(compiled, data)
    return float(data.body("peg").xpos[2])


def test_a_peg_falls_through_the_hole_and_not_through_the_wall(tmp_path: Path) -> None:
    model = convex_cells(plate()).write_mjcf(tmp_path / "plate.xml", fixed=True)
    assert height_after_fall(model, 0.0) < -0.5
    # The peg, 30 mm long, stands on the plate, 20 mm thick, or lies on it.
    assert 0.025 < height_after_fall(model, 0.02) < 0.0355


def test_the_hull_of_the_part_lets_no_peg_through(tmp_path: Path) -> None:
    model = hull_of(convex_cells(plate())).write_mjcf(tmp_path / "plate.xml", fixed=True)
    assert height_after_fall(model, 0.0) > 0.025


def test_merged_cells_keep_the_hole_within_their_error(tmp_path: Path) -> None:
    cells = convex_cells(plate(), max_cells=24)
    assert 0 < cells.report.details["limits"]["hull_error"] < HOLE / 2 - 8.5
    model = cells.write_mjcf(tmp_path / "plate.xml", fixed=True)
    assert height_after_fall(model, 0.0) < -0.5


def test_mujoco_reads_mass_and_inertia_of_the_solid(tmp_path: Path) -> None:
    points, triangles = plate()
    exact = trimesh.Trimesh(points, triangles, process=False)
    exact.density = 2700e-9
    cells = convex_cells((points, triangles), max_cells=4)
    model = mujoco.MjModel.from_xml_path(str(cells.write_mjcf(tmp_path / "p.xml", density=2700)))
    assert model.ngeom == 4
    assert model.body_mass[1] == pytest.approx(exact.mass, rel=1e-6)
    wanted = np.sort(exact.principal_inertia_components) * 1e-6
    assert np.sort(model.body_inertia[1]) == pytest.approx(wanted, rel=1e-6)
    assert model.body_ipos[1] == pytest.approx(exact.center_mass * 1e-3, abs=1e-9)


def test_pybullet_loads_every_cell_and_the_mass(tmp_path: Path) -> None:
    cells = convex_cells(plate())
    file = cells.write_urdf(tmp_path / "plate.urdf")
    client = pybullet.connect(pybullet.DIRECT)
    try:
        body = pybullet.loadURDF(str(file), flags=pybullet.URDF_USE_INERTIA_FROM_FILE)
        assert len(pybullet.getCollisionShapeData(body, -1)) == len(cells)
        found = pybullet.getDynamicsInfo(body, -1)
        wanted = mass.of_cells(cells).scaled(1e-3, 1000.0)
        assert found[2] == pytest.approx(np.linalg.eigvalsh(wanted.inertia), rel=1e-5)
        assert pybullet.getBodyInfo(body)[0] == b"plate"
        # A ray down the hole meets nothing, one beside it the top with its margin of 1 mm.
        hole, wall = pybullet.rayTestBatch([[0, 0, 1], [0.02, 0, 1]], [[0, 0, -1], [0.02, 0, -1]])
        assert hole[0] == -1
        assert wall[0] == body and wall[3][2] == pytest.approx(THICK * 1e-3, abs=1.1e-3)
    finally:
        pybullet.disconnect(client)


def test_sdf_names_every_file_and_the_inertia(tmp_path: Path) -> None:
    cells = convex_cells(plate())
    root = ElementTree.parse(cells.write_sdf(tmp_path / "plate.sdf", density=500)).getroot()
    uris = [node.text for node in root.iterfind("model/link/collision/geometry/mesh/uri")]
    assert uris == [f"plate_cells/cell_{k}.obj" for k in range(len(cells))]
    assert all((tmp_path / str(uri)).is_file() for uri in uris)
    told = float(root.findtext("model/link/inertial/mass", "0"))
    assert told == pytest.approx(cells.volumes().sum() * 1e-9 * 500, rel=1e-8)


@pytest.mark.parametrize("suffix", [".obj", ".stl"])
def test_every_cell_gets_a_file(tmp_path: Path, suffix: str) -> None:
    cells = convex_cells(plate())
    files = cells.write_parts(tmp_path / "cells", suffix)
    assert [f.name for f in files] == [f"cell_{k}{suffix}" for k in range(len(cells))]
    meshes = [trimesh.load(f) for f in files]
    assert all(m.is_watertight and m.is_convex for m in meshes)
    rel = 1e-12 if suffix == ".obj" else 1e-5
    assert sum(m.volume for m in meshes) == pytest.approx(cells.volumes().sum(), rel=rel)


def test_flat_cells_are_left_out(two_boxes: ConvexCells, tmp_path: Path) -> None:
    thin = two_boxes.points * [1, 1, 1]
    thin[thin[:, 0] == 1.0, 0] = 1e-7
    files = parts.write_parts(replace(two_boxes, points=thin), tmp_path)
    assert [f.name for f in files] == ["cell_1.obj"]
    assert parts.thick(two_boxes) == [0, 1]


def test_mass_properties_of_a_box_are_the_textbook_ones() -> None:
    box = trimesh.creation.box([1.0, 2.0, 3.0])
    box.apply_translation([4.0, 5.0, 6.0])
    found = mass.of_surface(np.asarray(box.vertices), np.asarray(box.faces))
    assert found.volume == pytest.approx(6.0, rel=1e-14)
    assert found.centre == pytest.approx([4, 5, 6], rel=1e-14)
    wanted = np.diag([6 / 12 * (4 + 9), 6 / 12 * (1 + 9), 6 / 12 * (1 + 4)])
    assert found.inertia == pytest.approx(wanted, abs=1e-12)


def test_drake_gets_a_corner_inside_every_tetrahedron(tmp_path: Path) -> None:
    mesh = tetrahedralize(plate(12))
    full = drake.with_inner_points(mesh)
    assert not np.isin(full.tets, np.unique(full.skin)).all(axis=1).any()
    assert (full.volumes() > 0).all()
    assert full.volumes().sum() == pytest.approx(mesh.volumes().sum(), rel=1e-12)
    root = ElementTree.parse(mesh.write_drake(tmp_path / "soft.sdf")).getroot()
    assert root.findtext("model/link/collision/geometry/mesh/uri") == "soft.vtk"
    assert (tmp_path / "soft.vtk").read_text().startswith("# vtk DataFile Version 3.0")


@pytest.mark.parametrize("wrong", [{"density": 0.0}, {"scale": -1.0}])
def test_wrong_numbers_are_refused(tmp_path: Path, wrong: dict[str, float]) -> None:
    with pytest.raises(BadOption, match=next(iter(wrong))):
        convex_cells(plate(8)).write_mjcf(tmp_path / "p.xml", **wrong)
    assert not list(tmp_path.iterdir())
