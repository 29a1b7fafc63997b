# SPDX-License-Identifier: LGPL-2.1-or-later
"""Every kind of input becomes the same solid; B-reps are made finer when they have to be."""

from __future__ import annotations

import dataclasses
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import shapes

import freecad_tetra
from freecad_tetra import api, kernel
from freecad_tetra.errors import Cancelled, Defect, InvalidSolid, UnsupportedFormat
from freecad_tetra.kernel import Validation
from freecad_tetra.model import Solid

CROSSING = Defect("self_crossing", "two triangles cross")


def test_all_public_names_exist() -> None:
    for name in freecad_tetra.__all__:
        assert getattr(freecad_tetra, name) is not None


def test_arrays_trimesh_and_solids_are_taken() -> None:
    shape = shapes.l_prism()
    given = Solid(shape.vertices, shape.triangles)
    assert api.as_solid(given) is given
    assert api.as_solid((shape.vertices, shape.triangles)).volume() == 10
    lists = (shape.vertices.tolist(), shape.triangles.tolist())
    assert api.as_solid(lists, name="part").name == "part"

    class Mesh:
        vertices, faces = shape.vertices, shape.triangles

    assert api.as_solid(Mesh()).volume() == 10
    for wrong in (7, None, [1, 2, 3], {"vertices": 1}):
        with pytest.raises(UnsupportedFormat):
            api.as_solid(wrong)


def test_arrays_are_welded_and_keep_their_numbers() -> None:
    shape = shapes.l_prism()
    soup = shape.vertices[shape.triangles].reshape(-1, 3)
    solid = api.as_solid((soup, np.arange(len(soup)).reshape(-1, 3)))
    assert len(solid.vertices) == len(soup)
    assert len(np.unique(solid.triangles)) == len(shape.vertices)


def test_bad_arrays() -> None:
    with pytest.raises(InvalidSolid):
        api.as_solid(([[0, 0, 0]], [[0, 1, 2]]))


@pytest.mark.parametrize("scale", [1e300, 1e-300])
def test_sizes_beyond_doubles_are_refused(scale: float) -> None:
    shape = shapes.l_prism()
    for decompose in (api.tetrahedralize, api.convex_cells):
        with pytest.raises(InvalidSolid) as caught:
            decompose((shape.vertices * scale, shape.triangles))
        assert [d.kind for d in caught.value.defects] == ["scale_out_of_range"]


@pytest.mark.parametrize("scale", [1e59, 1e-58])
def test_sizes_far_out_are_computed(scale: float) -> None:
    shape = shapes.l_prism()
    for decompose in (api.tetrahedralize, api.convex_cells):
        report = decompose((shape.vertices * scale, shape.triangles)).report
        assert report.volume == pytest.approx(10 * scale**3, rel=1e-12)


def test_trimesh_itself() -> None:
    trimesh = pytest.importorskip("trimesh", reason="trimesh is not installed")
    assert api.as_solid(trimesh.creation.box((1, 2, 3))).volume() == pytest.approx(6)


class Judge:
    """Stands in for kernel.validate: says what it is told to, one answer after the other."""

    def __init__(self, answers: list[tuple[Defect, ...]]) -> None:
        self.answers = answers
        self.seen: list[Solid] = []

    def __call__(self, solid: Solid, *_: Any) -> Validation:
        self.seen.append(solid)
        count = len(solid.triangles)
        zeros, rows = np.zeros(count, np.int32), np.arange(count, dtype=np.int32)
        return Validation(solid, self.answers.pop(0), solid.triangles, rows, zeros, zeros)


def drilled() -> Any:
    pytest.importorskip("OCP", reason="cadquery-ocp is not installed")
    from OCP.BRepAlgoAPI import BRepAlgoAPI_Cut
    from OCP.BRepPrimAPI import BRepPrimAPI_MakeBox, BRepPrimAPI_MakeCylinder

    hole = BRepPrimAPI_MakeCylinder(2, 4).Solid()
    return BRepAlgoAPI_Cut(BRepPrimAPI_MakeBox(5, 5, 4).Solid(), hole).Shape()


def test_a_crossing_tessellation_is_made_finer(monkeypatch: pytest.MonkeyPatch) -> None:
    judge = Judge([(CROSSING,), (CROSSING,), ()])
    monkeypatch.setattr(kernel, "validate", judge)
    found = api.validate(drilled())
    assert not found.defects
    assert found.solid.notes["retries"] == 2
    assert found.solid.notes["retried_for"] == ["self_crossing"] * 2
    chords = [s.notes["linear_deflection"] for s in judge.seen]
    assert chords[1] == chords[0] / 2 and chords[2] == chords[0] / 4


def test_after_three_retries_the_defect_is_told(monkeypatch: pytest.MonkeyPatch) -> None:
    judge = Judge([(CROSSING,)] * 4)
    monkeypatch.setattr(kernel, "validate", judge)
    found = api.validate(drilled())
    assert found.defects == (CROSSING,) and len(judge.seen) == 4
    with pytest.raises(InvalidSolid):
        found.surface()


def test_other_defects_are_not_retried(monkeypatch: pytest.MonkeyPatch) -> None:
    judge = Judge([(Defect("open_edge", "open"),)])
    monkeypatch.setattr(kernel, "validate", judge)
    assert api.validate(drilled()).defects[0].kind == "open_edge"
    assert judge.seen[0].notes["retries"] == 0


def test_what_cannot_be_made_finer_stays_as_it_is(monkeypatch: pytest.MonkeyPatch) -> None:
    shape, coarse = drilled(), api.brep.Shape.tessellate

    def once(self: Any, wanted: Any, only: Any, name: str = "") -> Solid:
        if wanted != api.brep.Deflection():
            raise InvalidSolid([Defect("no_mesh", "OpenCascade cannot tessellate them")])
        return coarse(self, wanted, only, name)

    monkeypatch.setattr(api.brep.Shape, "tessellate", once)
    monkeypatch.setattr(api, "VOLUME_SHARE", 1e-4)
    found = api.validate(shape)
    assert not found.defects and found.solid.notes["retries"] == 0
    monkeypatch.setattr(kernel, "validate", Judge([(CROSSING,)]))
    assert api.validate(shape).defects == (CROSSING,)


def test_a_volume_that_strays_is_made_finer(monkeypatch: pytest.MonkeyPatch) -> None:
    judge = Judge([()] * 4)
    monkeypatch.setattr(kernel, "validate", judge)
    monkeypatch.setattr(api, "VOLUME_SHARE", 1e-4)
    found = api.validate(drilled())
    notes = found.solid.notes
    assert notes["retried_for"] == ["volume"] * notes["retries"] and notes["retries"] >= 1
    assert found.solid.volume() == pytest.approx(notes["brep_volume"], rel=1e-4)
    assert judge.seen[0].volume() != pytest.approx(notes["brep_volume"], rel=1e-4)


def test_a_deflection_that_was_asked_for_is_kept(monkeypatch: pytest.MonkeyPatch) -> None:
    judge = Judge([()])
    monkeypatch.setattr(kernel, "validate", judge)
    monkeypatch.setattr(api, "VOLUME_SHARE", 1e-4)
    found = api.validate(drilled(), angular_deflection=20)
    assert found.solid.notes["retries"] == 0


def test_reading_can_be_cancelled(tmp_path: Path) -> None:
    with pytest.raises(Cancelled):
        api.validate(tmp_path / "a.off", progress=lambda *_: False)


def test_options_reach_the_kernel(monkeypatch: pytest.MonkeyPatch) -> None:
    shape = shapes.cube()
    judge = Judge([()] * 2)
    seen: list[Any] = []
    monkeypatch.setattr(kernel, "validate", judge)
    monkeypatch.setattr(kernel, "convex_cells", lambda *a: seen.append(a[1]))
    monkeypatch.setattr(kernel, "tetrahedralize", lambda *a: seen.append(a[1]))
    api.convex_cells((shape.vertices, shape.triangles), plain=True, merge=False, flatness=0)
    api.tetrahedralize((shape.vertices, shape.triangles), direction=(0, 1, 2), compact="off")
    assert seen == [
        {"method": "auto", "plain": True, "merge": False, "flatness": 0},
        {
            "method": "chazelle-palios", "direction": [0, 1, 2], "pull_off": "auto",
            "compact": "off",
        },
    ]  # fmt: skip


def test_one_solid_of_a_validated_mesh(monkeypatch: pytest.MonkeyPatch) -> None:
    cube = shapes.cube(1)
    both = Solid(
        np.vstack([cube.vertices, cube.vertices + 5]),
        np.vstack([cube.triangles, cube.triangles + 8]),
    )
    judge = Judge([(), ()])

    def labelled(solid: Solid, *rest: Any) -> Validation:
        found = judge(solid, *rest)
        ids = (np.arange(len(solid.triangles)) // 12).astype(np.int32)
        return dataclasses.replace(found, solid_id=ids)

    monkeypatch.setattr(kernel, "validate", labelled)
    found = api.validate(both, solid=2)
    assert len(found.triangles) == 12 and found.triangles.min() == 8
