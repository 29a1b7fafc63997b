# SPDX-License-Identifier: LGPL-2.1-or-later
"""The facade maps ids, options and errors; a stand-in for the kernel says what it is told to."""

from __future__ import annotations

import sys
from types import ModuleType
from typing import Any

import numpy as np
import pytest
import shapes

from freecad_tetra import _version, kernel
from freecad_tetra.errors import (
    Cancelled,
    InvalidPolygon,
    InvalidSolid,
    KernelMissing,
    VerificationFailed,
)
from freecad_tetra.model import Solid


class StandIn(ModuleType):
    """Has the functions of the contract; `answers` holds their results or exceptions."""

    InvalidSolid = type("InvalidSolid", (RuntimeError,), {})
    VerificationFailed = type("VerificationFailed", (RuntimeError,), {})
    Cancelled = type("Cancelled", (RuntimeError,), {})
    InvalidPolygon = type("InvalidPolygon", (ValueError,), {})

    def __init__(self) -> None:
        super().__init__("_tetra_kernel")
        self.answers: dict[str, Any] = {}
        self.calls: list[tuple[str, tuple[Any, ...]]] = []

    def version(self) -> str:
        return _version.__version__

    def _answer(self, name: str, *arguments: Any) -> Any:
        self.calls.append((name, arguments))
        answer = self.answers[name]
        if isinstance(answer, Exception):
            raise answer
        return answer

    def validate(self, *arguments: Any) -> Any:
        return self._answer("validate", *arguments)

    def convex_cells(self, *arguments: Any) -> Any:
        return self._answer("convex_cells", *arguments)

    def tetrahedralize(self, *arguments: Any) -> Any:
        return self._answer("tetrahedralize", *arguments)

    def triangulate_polygon(self, *arguments: Any) -> Any:
        return self._answer("triangulate_polygon", *arguments)


@pytest.fixture
def fake(monkeypatch: pytest.MonkeyPatch) -> StandIn:
    module = StandIn()
    monkeypatch.setitem(sys.modules, "_tetra_kernel", module)
    return module


@pytest.fixture
def solid() -> Solid:
    cube = shapes.cube()
    names = tuple(f"Face{i + 1}" for i in range(6))
    return Solid(cube.vertices, cube.triangles, np.arange(12) // 2, names)


def valid(solid: Solid, order: Any) -> dict[str, Any]:
    """What validate returns when it has put the triangles in another order."""
    return {
        "defects": [],
        "triangles": solid.triangles[order],
        "triangle_source": np.array(order, np.int32),
        "turned": [1],
        "shell": np.zeros(len(order), np.int32),
        "solid": np.zeros(len(order), np.int32),
        "counts": {"facets": 6, "notches": 3},
    }


CELL = {
    "points": np.eye(4, 3),
    "point_source": [0, 1, 2, -1],
    "facet_offsets": [0, 3, 6, 9, 12],
    "facet_vertices": [0, 2, 1, 0, 1, 3, 1, 2, 3, 2, 0, 3],
    "facet_source": [0, 3, -1, 11],
    "cell_offsets": [0, 4],
    "cell_solid": [0],
    "report": {
        "method": "bajaj-dey",
        "seconds": {"cut": 0.5},
        "counts": {"pieces": 1},
        "verdict": "verified",
        "grid_bits": np.int64(26),
    },
}


def test_ids_come_back_to_the_callers_triangles_and_faces(fake: StandIn, solid: Solid) -> None:
    order = list(range(11, -1, -1))
    fake.answers = {"validate": valid(solid, order), "convex_cells": CELL}
    cells = kernel.convex_cells(solid, {"method": "bajaj-dey"})
    assert cells.facet_source.tolist() == [11, 8, -1, 0]
    assert cells.facet_face.tolist() == [5, 4, -1, 0]
    assert cells.face_names == solid.face_names
    name, arguments = fake.calls[1]
    assert name == "convex_cells" and np.array_equal(arguments[1], solid.triangles[::-1])
    assert arguments[3] == {"method": "bajaj-dey"}


def test_report_gathers_all(fake: StandIn, solid: Solid) -> None:
    fake.answers = {"validate": valid(solid, list(range(12))), "convex_cells": CELL}
    report = kernel.convex_cells(solid).report
    assert report.method == "bajaj-dey" and report.verdict == "verified"
    assert report.counts == {"facets": 6, "notches": 3, "pieces": 1}
    assert report.bounds == {"bajaj_dey": 7}
    assert set(report.seconds) == {"validate", "cut", "kernel"}
    assert report.details["grid_bits"] == 26
    assert report.repairs == {"turned_shells": [1]}


def test_defects_name_faces(fake: StandIn, solid: Solid) -> None:
    defect = {"kind": "open_edge", "vertices": [1, 2], "triangles": [3, 2, 9], "message": "open"}
    fake.answers = {"validate": {**valid(solid, []), "defects": [defect]}}
    found = kernel.validate(solid).defects[0]
    assert (found.kind, found.vertices, found.triangles) == ("open_edge", (1, 2), (3, 2, 9))
    assert found.faces == ("Face2", "Face5")
    with pytest.raises(InvalidSolid):
        kernel.convex_cells(solid)
    with pytest.raises(InvalidSolid):
        kernel.validate(solid).surface()


def test_defects_of_the_decomposition_are_mapped_too(fake: StandIn, solid: Solid) -> None:
    error = fake.InvalidSolid("crossing")
    error.defects = [{"kind": "self_crossing", "triangles": [0], "vertices": [], "message": "x"}]  # type: ignore[attr-defined]
    fake.answers = {"validate": valid(solid, list(range(11, -1, -1))), "convex_cells": error}
    with pytest.raises(InvalidSolid) as caught:
        kernel.convex_cells(solid)
    assert caught.value.defects[0].triangles == (11,)
    assert caught.value.defects[0].faces == ("Face6",)


def test_kernel_errors_are_typed(fake: StandIn, solid: Solid) -> None:
    fake.answers = {"validate": valid(solid, list(range(12)))}
    fake.answers["convex_cells"] = fake.VerificationFailed("volume is off")
    with pytest.raises(VerificationFailed, match="volume is off"):
        kernel.convex_cells(solid)
    fake.answers["tetrahedralize"] = fake.Cancelled()
    with pytest.raises(Cancelled):
        kernel.tetrahedralize(solid)
    fake.answers["convex_cells"] = ZeroDivisionError("a callback's own error")
    with pytest.raises(ZeroDivisionError):
        kernel.convex_cells(solid)
    wrong = fake.InvalidPolygon("edges cross")
    wrong.edges, wrong.points = [(0, 1), (0, 3)], [7]  # type: ignore[attr-defined]
    fake.answers["triangulate_polygon"] = wrong
    with pytest.raises(InvalidPolygon) as caught:
        kernel.triangulate_polygon([[0, 0], [1, 1], [1, 0], [0, 1]], [[0, 1, 2, 3]])
    assert caught.value.edges == ((0, 1), (0, 3)) and caught.value.points == (7,)


def test_solid_labels_are_passed_on(fake: StandIn, solid: Solid) -> None:
    labelled = Solid(solid.vertices, solid.triangles, solid_ids=np.arange(12) // 6)
    fake.answers = {"validate": valid(solid, list(range(12)))}
    kernel.validate(labelled)
    assert fake.calls[0][1][2]["solid"].tolist() == [0] * 6 + [1] * 6


def test_tets_are_mapped(fake: StandIn, solid: Solid) -> None:
    fake.answers = {
        "validate": valid(solid, list(range(11, -1, -1))),
        "tetrahedralize": {
            "points": np.eye(4, 3), "point_source": [0, 1, 2, 3], "tets": [[0, 1, 2, 3]],
            "tet_solid": [0], "skin": [[0, 2, 1]], "skin_source": [11], "report": {},
        },
    }  # fmt: skip
    mesh = kernel.tetrahedralize(solid)
    assert (mesh.skin_source.tolist(), mesh.skin_face.tolist()) == ([0], [0])


def test_a_missing_kernel_says_what_to_do(monkeypatch: pytest.MonkeyPatch, solid: Solid) -> None:
    monkeypatch.setitem(sys.modules, "_tetra_kernel", None)
    with pytest.raises(KernelMissing, match="make"):
        kernel.validate(solid)


def test_a_kernel_of_another_version_is_refused(
    fake: StandIn, solid: Solid, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(fake, "version", lambda: "0.0.0")
    with pytest.raises(KernelMissing, match=r"0\.0\.0"):
        kernel.validate(solid)


@pytest.mark.parametrize(("notches", "pieces"), [(0, 1), (1, 2), (2, 4), (6, 22)])
def test_bound(notches: int, pieces: int) -> None:
    assert kernel.piece_bound(notches) == pieces
