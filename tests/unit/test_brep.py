# SPDX-License-Identifier: LGPL-2.1-or-later
"""B-rep models become closed surfaces that are welded by topology and know their faces."""

from __future__ import annotations

import math
import zipfile
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from freecad_tetra import brep
from freecad_tetra.api import as_solid
from freecad_tetra.brep import Deflection
from freecad_tetra.errors import InvalidSolid, TetraError, UnreadableFile, UnsupportedFormat
from freecad_tetra.model import Solid

pytest.importorskip("OCP", reason="cadquery-ocp is not installed")

from OCP.BRep import BRep_Builder
from OCP.BRepAlgoAPI import BRepAlgoAPI_Cut, BRepAlgoAPI_Fuse
from OCP.BRepPrimAPI import (
    BRepPrimAPI_MakeBox,
    BRepPrimAPI_MakeCone,
    BRepPrimAPI_MakeCylinder,
    BRepPrimAPI_MakeSphere,
    BRepPrimAPI_MakeTorus,
)
from OCP.BRepTools import BRepTools
from OCP.gp import gp_Pnt
from OCP.IGESControl import IGESControl_Writer
from OCP.STEPControl import STEPControl_StepModelType, STEPControl_Writer
from OCP.TopoDS import TopoDS_Compound


def box(x: float, y: float, z: float, at: tuple[float, float, float] = (0, 0, 0)) -> Any:
    return BRepPrimAPI_MakeBox(gp_Pnt(*at), x, y, z).Solid()


def compound(*shapes: Any) -> Any:
    builder, out = BRep_Builder(), TopoDS_Compound()
    builder.MakeCompound(out)
    for shape in shapes:
        builder.Add(out, shape)
    return out


def hollow_box() -> Any:
    return BRepAlgoAPI_Cut(box(10, 10, 10), box(4, 4, 4, (3, 3, 3))).Shape()


def drilled_box() -> Any:
    hole = BRepPrimAPI_MakeCylinder(2, 10).Solid()
    return BRepAlgoAPI_Cut(box(10, 10, 10, (-5, -5, 0)), hole).Shape()


SHAPES = {
    "box": (lambda: box(2, 3, 4), 24.0, 2),
    "sphere": (lambda: BRepPrimAPI_MakeSphere(5).Solid(), 4 / 3 * math.pi * 125, 2),
    "cone": (lambda: BRepPrimAPI_MakeCone(4, 0, 9).Solid(), math.pi * 16 * 9 / 3, 2),
    "frustum": (lambda: BRepPrimAPI_MakeCone(4, 2, 9).Solid(), math.pi * 9 / 3 * 28, 2),
    "cylinder": (lambda: BRepPrimAPI_MakeCylinder(3, 7).Solid(), math.pi * 63, 2),
    "torus": (lambda: BRepPrimAPI_MakeTorus(6, 2).Solid(), 2 * math.pi**2 * 24, 0),
    "hollow_box": (hollow_box, 1000.0 - 64.0, 4),
    "drilled_box": (drilled_box, 1000 - math.pi * 40, 0),
}


def directed_edges(solid: Solid) -> tuple[np.ndarray, np.ndarray]:
    t = solid.triangles.astype(np.int64)
    ends = np.concatenate([t[:, [0, 1]], t[:, [1, 2]], t[:, [2, 0]]])
    n = len(solid.vertices)
    return np.sort(ends[:, 0] * n + ends[:, 1]), np.sort(ends[:, 1] * n + ends[:, 0])


def assert_closed(solid: Solid, type_2_edges: int = 0) -> None:
    there, back = directed_edges(solid)
    assert np.array_equal(there, back), "every edge has its opposite"
    assert int((np.diff(there) == 0).sum()) == 2 * type_2_edges
    corners = solid.triangles
    assert (corners != np.roll(corners, 1, axis=1)).all()


@pytest.mark.parametrize("name", sorted(SHAPES))
def test_primitives_are_closed_outward_and_true(name: str) -> None:
    make, volume, euler = SHAPES[name]
    solid = brep.tessellate(make(), Deflection(relative=0.0005, angular=math.radians(5)))
    assert_closed(solid)
    assert solid.volume() == pytest.approx(volume, rel=0.01)
    assert solid.notes["brep_volume"] == pytest.approx(volume, rel=1e-9)
    used = len(np.unique(solid.triangles))
    assert used - len(solid.triangles) * 3 // 2 + len(solid.triangles) == euler
    assert used == len(solid.vertices) == len(np.unique(solid.vertices, axis=0))


def test_reversed_faces_are_turned() -> None:
    solid = brep.tessellate(drilled_box())
    assert solid.volume() == pytest.approx(1000 - math.pi * 40, rel=0.01)
    assert brep.tessellate(drilled_box().Reversed()).volume() == pytest.approx(-solid.volume())


def test_faces_are_numbered_as_freecad_does() -> None:
    solid = brep.tessellate(box(2, 3, 4))
    assert solid.face_names == tuple(f"Face{i}" for i in range(1, 7))
    # FreeCAD's box: Face1 is x min, Face2 x max, then y min, y max, z min, z max.
    for face, (axis, value) in enumerate([(0, 0), (0, 2), (1, 0), (1, 3), (2, 0), (2, 4)]):
        corners = solid.vertices[solid.triangles[solid.face_ids == face]]
        assert (corners[:, :, axis] == value).all()


def test_solids_of_a_compound_keep_their_numbers() -> None:
    shape = compound(box(1, 1, 1), box(1, 1, 1, (3, 0, 0)))
    solid = brep.tessellate(shape)
    assert_closed(solid)
    assert solid.solid_ids is not None and np.bincount(solid.solid_ids).tolist() == [12, 12]
    second = brep.tessellate(shape, only=2)
    assert second.volume() == 1.0 and second.vertices[:, 0].min() == 3
    assert second.face_names[second.face_ids.min()] == "Face7"
    with pytest.raises(InvalidSolid, match="no solid 3"):
        try:
            brep.tessellate(shape, only=3)
        except InvalidSolid as error:
            raise InvalidSolid(error.defects, error.defects[0].message) from error


def test_solids_that_touch_share_nodes() -> None:
    shape = compound(box(1, 1, 1), box(1, 1, 1, (1, 0, 0)))
    assert len(brep.tessellate(shape).vertices) == 12


def test_a_moved_shape_is_where_it_was_put() -> None:
    from OCP.gp import gp_Trsf, gp_Vec
    from OCP.TopLoc import TopLoc_Location

    move = gp_Trsf()
    move.SetTranslation(gp_Vec(10, 20, 30))
    moved = compound(drilled_box().Moved(TopLoc_Location(move)), drilled_box())
    solid = brep.tessellate(moved)
    assert_closed(solid)
    assert solid.solid_ids is not None
    first = solid.vertices[np.unique(solid.triangles[solid.solid_ids == 0])]
    assert first.min(axis=0).tolist() == [5, 15, 30]


def test_the_callers_shape_gets_no_mesh() -> None:
    from OCP.BRep import BRep_Tool
    from OCP.TopAbs import TopAbs_ShapeEnum
    from OCP.TopExp import TopExp_Explorer
    from OCP.TopLoc import TopLoc_Location
    from OCP.TopoDS import TopoDS

    shape = drilled_box()
    brep.tessellate(shape)
    face = TopoDS.Face_s(TopExp_Explorer(shape, TopAbs_ShapeEnum.TopAbs_FACE).Current())
    assert BRep_Tool.Triangulation_s(face, TopLoc_Location()) is None


def test_equal_input_gives_equal_output() -> None:
    first, second = (brep.tessellate(drilled_box()) for _ in range(2))
    assert first.vertices.tobytes() == second.vertices.tobytes()
    assert first.triangles.tobytes() == second.triangles.tobytes()


def test_a_finer_deflection_gives_more_triangles() -> None:
    shape = drilled_box()
    coarse = brep.tessellate(shape, Deflection(relative=0.01, angular=1.0))
    fine = brep.tessellate(shape, Deflection(linear=0.001, angular=1.0))
    assert len(fine.triangles) > 2 * len(coarse.triangles)
    assert fine.notes["linear_deflection"] == 0.001


def write_step(shape: Any, path: Path) -> Path:
    writer = STEPControl_Writer()
    writer.Transfer(shape, STEPControl_StepModelType.STEPControl_AsIs)
    writer.Write(str(path))
    return path


def write_iges(shape: Any, path: Path, mode: int) -> Path:
    writer = IGESControl_Writer("MM", mode)
    writer.AddShape(shape)
    writer.ComputeModel()
    writer.Write(str(path))
    return path


def test_step_brep_and_iges_round_trips(tmp_path: Path, capfd: pytest.CaptureFixture[str]) -> None:
    shape = drilled_box()
    files = [
        write_step(shape, tmp_path / "a.step"),
        write_iges(shape, tmp_path / "a.igs", 1),
        write_iges(shape, tmp_path / "b.iges", 0),
        tmp_path / "a.brep",
    ]
    BRepTools.Write_s(shape, str(files[-1]))
    capfd.readouterr()
    for path in files:
        solid = as_solid(path)
        assert_closed(solid)
        assert solid.volume() == pytest.approx(1000 - math.pi * 40, rel=0.01), path
        assert len(solid.face_names) == 7
        assert solid.name == path.stem
    assert capfd.readouterr().out == "", "OpenCascade is kept from writing to stdout"


def test_step_in_inches_comes_in_millimetres(tmp_path: Path) -> None:
    from OCP.Interface import Interface_Static

    Interface_Static.SetCVal_s("write.step.unit", "INCH")
    try:
        path = write_step(box(25.4, 25.4, 25.4), tmp_path / "inch.step")
    finally:
        Interface_Static.SetCVal_s("write.step.unit", "MM")
    assert as_solid(path).volume() == pytest.approx(25.4**3, rel=1e-9)


def fcstd(path: Path, visible: str) -> Path:
    """A document with a hidden cutter and a visible part."""
    shapes = {"Part": box(3, 3, 3), "Cutter": box(1, 1, 1)}
    rows, views = "", ""
    with zipfile.ZipFile(path, "w") as archive:
        for name, shape in shapes.items():
            BRepTools.Write_s(shape, str(path.with_suffix(".tmp")))
            archive.writestr(f"{name}.brp", path.with_suffix(".tmp").read_bytes())
            rows += f'<Object name="{name}"><Properties><Property name="Shape">'
            rows += f'<Part file="{name}.brp"/></Property></Properties></Object>'
            shown = "true" if name == visible else "false"
            views += f'<ViewProvider name="{name}"><Properties><Property name="Visibility">'
            views += f'<Bool value="{shown}"/></Property></Properties></ViewProvider>'
        archive.writestr("Document.xml", f"<Document><ObjectData>{rows}</ObjectData></Document>")
        if visible:
            archive.writestr("GuiDocument.xml", f"<Document>{views}</Document>")
    return path


def test_fcstd_takes_what_is_visible(tmp_path: Path) -> None:
    assert as_solid(fcstd(tmp_path / "a.FCStd", "Part")).volume() == 27
    assert as_solid(fcstd(tmp_path / "b.FCStd", "Cutter")).volume() == 1
    assert as_solid(fcstd(tmp_path / "c.FCStd", "")).volume() == 28


def test_objects_that_wrap_a_shape() -> None:
    class Wrapped:
        def __init__(self, shape: Any) -> None:
            self.wrapped = shape

    class Workplane:
        def vals(self) -> list[Wrapped]:
            return [Wrapped(box(1, 1, 1)), Wrapped(box(1, 1, 1, (5, 0, 0)))]

    class Assembly:
        def toCompound(self) -> Wrapped:
            return Wrapped(compound(box(1, 1, 1)))

    assert as_solid(Wrapped(box(2, 2, 2))).volume() == 8
    assert as_solid(Wrapped(Wrapped(box(2, 2, 2)))).volume() == 8
    assert as_solid(Workplane()).volume() == 2
    assert as_solid(Assembly()).volume() == 1
    assert as_solid(box(2, 2, 1)).volume() == 4
    with pytest.raises(UnsupportedFormat):
        as_solid(object())


def test_a_model_without_a_solid(tmp_path: Path) -> None:
    from OCP.BRepBuilderAPI import BRepBuilderAPI_MakeFace
    from OCP.gp import gp_Pln

    face = BRepBuilderAPI_MakeFace(gp_Pln(), 0, 1, 0, 1).Face()
    path = write_step(face, tmp_path / "face.step")
    with pytest.raises(InvalidSolid) as caught:
        as_solid(path)
    assert caught.value.defects[0].kind == "no_solid"


def test_a_step_file_with_no_shape(tmp_path: Path) -> None:
    path = tmp_path / "empty.step"
    path.write_text(
        "ISO-10303-21;\nHEADER;\nFILE_DESCRIPTION((''),'2;1');\nFILE_NAME('','',(''),(''),'','','');\n"
        "FILE_SCHEMA(('AUTOMOTIVE_DESIGN'));\nENDSEC;\nDATA;\nENDSEC;\nEND-ISO-10303-21;\n"
    )
    with pytest.raises(TetraError):
        as_solid(path)


@pytest.mark.parametrize("suffix", [".step", ".stp", ".brep", ".brp", ".iges", ".igs", ".fcstd"])
def test_missing_empty_and_garbage_files(tmp_path: Path, suffix: str) -> None:
    with pytest.raises(UnreadableFile):
        as_solid(tmp_path / f"none{suffix}")
    random = np.random.default_rng(1)
    for content in (b"", b"\n", random.integers(0, 256, 3000, dtype=np.uint8).tobytes()):
        path = tmp_path / f"bad{suffix}"
        path.write_bytes(content)
        with pytest.raises(UnreadableFile):
            as_solid(path)


def test_truncated_step_files(tmp_path: Path) -> None:
    whole = write_step(drilled_box(), tmp_path / "whole.step").read_bytes()
    path = tmp_path / "cut.step"
    for part in (0.02, 0.3, 0.7, 0.95, 0.999):
        path.write_bytes(whole[: int(len(whole) * part)])
        with pytest.raises(UnreadableFile):
            as_solid(path)


def test_truncated_brep_files(tmp_path: Path) -> None:
    path = tmp_path / "whole.brep"
    BRepTools.Write_s(drilled_box(), str(path))
    whole = path.read_bytes()
    assert as_solid(path).volume() > 0
    path = tmp_path / "cut.brep"
    for part in (*np.linspace(0.02, 0.99, 40), 1 - 4 / len(whole)):
        path.write_bytes(whole[: int(len(whole) * part)])
        with pytest.raises(UnreadableFile):
            as_solid(path)


def test_deflections_must_be_positive() -> None:
    for options in (
        {"linear_deflection": 0.0},
        {"relative_deflection": -1.0},
        {"angular_deflection": math.nan},
    ):
        with pytest.raises(TetraError, match="above zero"):
            as_solid(box(1, 1, 1), **options)  # type: ignore[arg-type]


def test_fused_solids_with_seams_and_poles() -> None:
    ball = BRepPrimAPI_MakeSphere(gp_Pnt(0, 0, 10), 4).Solid()
    cone = BRepPrimAPI_MakeCone(6, 0, 12).Solid()
    solid = brep.tessellate(BRepAlgoAPI_Fuse(cone, ball).Shape())
    assert_closed(solid)
    assert solid.volume() == pytest.approx(solid.notes["brep_volume"], rel=0.02)


def test_deflections_below_opencascades_least_are_its_least() -> None:
    solid = as_solid(box(1e-5, 1e-5, 1e-5))
    assert solid.volume() == pytest.approx(1e-15)
    solid = as_solid(box(1, 1, 1), linear_deflection=1e-20, angular_deflection=1e-20)
    assert len(solid.triangles) == 12 and solid.volume() == pytest.approx(1.0)
