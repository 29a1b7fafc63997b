# SPDX-License-Identifier: LGPL-2.1-or-later
"""Touching solids of a B-rep share faces before they are tessellated, curved ones too."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from freecad_tetra.api import as_solid, tetrahedralize, validate
from freecad_tetra.brep import read_shape
from freecad_tetra.cli import main

pytest.importorskip("OCP", reason="cadquery-ocp is not installed")

from OCP.Bnd import Bnd_Box
from OCP.BRep import BRep_Builder
from OCP.BRepAlgoAPI import BRepAlgoAPI_Cut
from OCP.BRepBndLib import BRepBndLib
from OCP.BRepBuilderAPI import BRepBuilderAPI_Transform
from OCP.BRepPrimAPI import BRepPrimAPI_MakeBox, BRepPrimAPI_MakeCylinder
from OCP.gp import gp_Ax1, gp_Ax2, gp_Dir, gp_Pnt, gp_Trsf
from OCP.STEPControl import STEPControl_StepModelType, STEPControl_Writer
from OCP.TopoDS import TopoDS_Compound

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "tools"))
from assemblies import contact_area

RADIUS = 5.0


def box(low: tuple[float, float, float], high: tuple[float, float, float]) -> Any:
    return BRepPrimAPI_MakeBox(gp_Pnt(*low), gp_Pnt(*high)).Solid()


def pin(bottom: float, height: float) -> Any:
    axis = gp_Ax2(gp_Pnt(20, 20, bottom), gp_Dir(0, 0, 1))
    return BRepPrimAPI_MakeCylinder(axis, RADIUS, height).Solid()


def compound(*shapes: Any) -> Any:
    builder, out = BRep_Builder(), TopoDS_Compound()
    builder.MakeCompound(out)
    for shape in shapes:
        builder.Add(out, shape)
    return out


def turned(shape: Any) -> Any:
    move = gp_Trsf()
    move.SetRotation(gp_Ax1(gp_Pnt(1, 2, 3), gp_Dir(1, 2, 3)), 0.7)
    return BRepBuilderAPI_Transform(shape, move, True).Shape()


def plate() -> Any:
    return box((0, 0, 0), (30, 30, 10))


def boss_on_plate() -> Any:
    return compound(plate(), box((5, 6, 10), (15, 16, 20)))


def pin_in_plate() -> Any:
    return compound(BRepAlgoAPI_Cut(plate(), pin(0, 10)).Shape(), pin(-5, 25))


def three_blocks() -> Any:
    low, left = box((0, 0, 0), (20, 10, 10)), box((0, 10, 0), (7, 20, 10))
    return compound(low, left, box((7, 10, 0), (20, 20, 15)))


ASSEMBLIES = {
    "boss_on_plate": (boss_on_plate, 100.0, 1e-12),
    "pin_in_plate": (pin_in_plate, 2 * np.pi * RADIUS * 10, 0.01),
    "three_blocks": (three_blocks, 200.0 + 100.0, 1e-12),
}


@pytest.mark.parametrize("name", ASSEMBLIES)
@pytest.mark.parametrize("turn", [False, True], ids=["straight", "turned"])
def test_step_assemblies_are_face_to_face(tmp_path: Path, name: str, turn: bool) -> None:
    make, area, error = ASSEMBLIES[name]
    path = tmp_path / "assembly.step"
    writer = STEPControl_Writer()
    writer.Transfer(turned(make()) if turn else make(), STEPControl_StepModelType.STEPControl_AsIs)
    writer.Write(str(path))
    mesh = tetrahedralize(path)
    assert contact_area(mesh) == pytest.approx(area, rel=max(error, 1e-9))
    assert mesh.report.repairs["vertices_on_grid"] == 0
    assert mesh.report.details["surface"]["shared_faces"] >= 1


SHARED = Path(__file__).parents[3] / "shared"
PART, JUDGE = SHARED / "corpus" / "brep" / "page68_bybejant.brep", SHARED / "check" / "verify.py"


@pytest.mark.skipif(not PART.is_file(), reason=f"{PART} is not here")
def test_a_part_in_its_mould() -> None:
    """Every face of a real part, curved ones too, is a contact with the block around it."""
    part = read_shape(PART)
    bounds = Bnd_Box()
    BRepBndLib.Add_s(part, bounds, False)
    bounds.Enlarge(5.0)
    low, high = bounds.CornerMin(), bounds.CornerMax()
    block = BRepPrimAPI_MakeBox(low, high).Solid()
    mesh = tetrahedralize(compound(part, BRepAlgoAPI_Cut(block, part).Shape()))
    assert (mesh.skin_twin >= 0).sum() == 2 * mesh.report.counts["contact_triangles"]
    alone = tetrahedralize(part)
    assert contact_area(mesh) == pytest.approx(area_of_skin(alone), rel=1e-3)
    size = (high.X() - low.X()) * (high.Y() - low.Y()) * (high.Z() - low.Z())
    assert mesh.report.volume == pytest.approx(size, rel=1e-12)


def area_of_skin(mesh: Any) -> float:
    corners = mesh.points[mesh.skin]
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    return float(np.linalg.norm(normals, axis=1).sum() / 2)


def test_files_are_checked_against_the_common_surface(tmp_path: Path) -> None:
    """The tetrahedra of touching solids are bounded by what bounds all of them together."""
    step, out, off = (tmp_path / name for name in ("in.step", "out.vtu", "surface.off"))
    writer = STEPControl_Writer()
    writer.Transfer(pin_in_plate(), STEPControl_StepModelType.STEPControl_AsIs)
    writer.Write(str(step))
    assert main(["tets", str(step), "-o", str(out), "--surface", str(off)]) == 0
    assert main(["check", str(step), str(out)]) == 0
    if JUDGE.is_file():
        judge = [sys.executable, str(JUDGE), "tets", str(off), str(out)]
        done = subprocess.run(judge, capture_output=True, text=True, timeout=300)
        assert done.returncode == 0, done.stdout + done.stderr


def test_faces_keep_their_numbers() -> None:
    """The plate's top is divided by the boss, its parts are one face; both sides have a name."""
    apart = compound(plate(), box((5, 6, 30), (15, 16, 40)))
    whole, solid = as_solid(apart), as_solid(boss_on_plate())
    assert solid.face_names == whole.face_names
    for face in range(12):
        area = [area_of(s, s.face_ids == face) for s in (whole, solid)]
        assert area[0] == pytest.approx(area[1], rel=1e-12)
    assert solid.notes["shared_faces"] == 1 and whole.notes["shared_faces"] == 0


def area_of(solid: Any, rows: Any) -> float:
    corners = solid.vertices[solid.triangles[rows]]
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    return float(np.linalg.norm(normals, axis=1).sum() / 2)


def test_overlapping_solids_are_told() -> None:
    found = validate(compound(plate(), box((5, 6, 5), (15, 16, 20))))
    assert {d.kind for d in found.defects} == {"self_crossing"}
    assert found.solid.notes["shared_faces"] == 0
