# SPDX-License-Identifier: LGPL-2.1-or-later
"""Values are frozen, checked when made, and say what they hold."""

import json

import numpy as np
import pytest
import shapes

from freecad_tetra.errors import Defect, InvalidSolid, KernelMissing, TetraError, UnreadableFile
from freecad_tetra.model import ConvexCells, Report, Solid, TetMesh


def test_arrays_are_copies_and_read_only() -> None:
    source = shapes.cube().vertices.copy()
    solid = Solid(source, shapes.cube().triangles)
    source[:] = 7
    assert solid.volume() == 8
    for array in (solid.vertices, solid.triangles, solid.face_ids):
        with pytest.raises(ValueError):
            array[0] = 0
    with pytest.raises(AttributeError):
        solid.vertices = source  # type: ignore[misc]


@pytest.mark.parametrize(
    ("vertices", "triangles", "kind"),
    [
        (np.zeros((4, 2)), [[0, 1, 2]], "bad_shape"),
        (np.zeros((4, 3)), [[0, 1, 2, 3]], "bad_shape"),
        (np.zeros((4, 3)), [[0, 1, 4]], "bad_index"),
        (np.zeros((4, 3)), [[0, 1, -1]], "bad_index"),
        (np.zeros((4, 3)), [[0, 1, 2**40]], "bad_shape"),
        (np.zeros((4, 3)), [[0, 1, 1.5]], "bad_shape"),
        ([["a", "b", "c"]], [[0, 0, 0]], "bad_shape"),
        ([[0, 0, 0], [1]], [[0, 0, 0]], "bad_shape"),
    ],
)
def test_bad_arrays_are_typed_errors(vertices: object, triangles: object, kind: str) -> None:
    with pytest.raises(InvalidSolid) as caught:
        Solid(vertices, triangles)  # type: ignore[arg-type]
    assert [d.kind for d in caught.value.defects] == [kind]


def test_bad_index_names_the_triangles() -> None:
    with pytest.raises(InvalidSolid) as caught:
        Solid(np.zeros((3, 3)), [[0, 1, 2], [0, 1, 9], [5, 1, 2]])  # type: ignore[arg-type]
    assert caught.value.defects[0].triangles == (1, 2)


def test_nan_is_left_for_validation() -> None:
    solid = Solid(np.full((3, 3), np.nan), [[0, 1, 2]])  # type: ignore[arg-type]
    assert np.isnan(solid.vertices).all()


def test_an_empty_solid_can_be_made() -> None:
    solid = Solid(np.zeros((0, 3)), np.zeros((0, 3), int))
    assert (len(solid.triangles), solid.volume(), solid.diagonal()) == (0, 0.0, 0.0)


@pytest.mark.parametrize("name", sorted(shapes.NAMED))
def test_volume_of_named_shapes(name: str) -> None:
    shape = shapes.NAMED[name]()
    assert Solid(shape.vertices, shape.triangles).volume() == pytest.approx(
        float(shape.volume), rel=1e-14
    )


def test_face_names() -> None:
    cube = shapes.cube()
    named = Solid(cube.vertices, cube.triangles, np.arange(12) // 2, tuple("abcdef"))
    assert [named.face_name(i) for i in (0, 5, 6, -1)] == ["a", "f", "", ""]
    assert Solid(cube.vertices, cube.triangles).face_name(3) == "polygon 3"


def test_cells(two_boxes: ConvexCells) -> None:
    assert len(two_boxes) == 2
    assert two_boxes.volumes().tolist() == pytest.approx([1.0, 1.5], rel=1e-15)
    assert [c.volume() for c in two_boxes] == pytest.approx([1.0, 1.5], rel=1e-15)
    cell = two_boxes.cell(1)
    assert cell.points.shape == (8, 3)
    assert sorted(np.concatenate(cell.facets).tolist()) == sorted(list(range(8)) * 3)
    with pytest.raises(IndexError):
        two_boxes.cell(2)


def test_no_cells() -> None:
    empty = np.zeros(0)
    cells = ConvexCells(np.zeros((0, 3)), [0], empty, [0], empty, empty, empty, empty)  # type: ignore[arg-type]
    assert len(cells) == 0
    assert cells.volumes().shape == (0,)


def test_tets(cube_tets: TetMesh) -> None:
    assert cube_tets.volumes().tolist() == pytest.approx([1 / 6] * 6, rel=1e-15)


def test_report_is_plain_json() -> None:
    report = Report(
        counts={"pieces": np.int64(3)},  # type: ignore[dict-item]
        details={"a": np.arange(2), "b": (np.float32(0.5), float("nan")), 3: {"x": None}},  # type: ignore[dict-item]
        defects=(Defect("open_edge", "m", (1, 2), (3,), ("Face1",)),),
    )
    out = json.loads(report.to_json())
    assert out["counts"] == {"pieces": 3}
    assert out["details"] == {"a": [0, 1], "b": [0.5, None], "3": {"x": None}}
    assert out["defects"][0]["faces"] == ["Face1"]


def test_errors_carry_ids_and_the_next_step() -> None:
    defect = Defect("open_edge", "an edge has one triangle", (4, 5), tuple(range(20)), ("Face3",))
    error = InvalidSolid([defect])
    assert isinstance(error, TetraError) and error.defects == (defect,)
    assert "1 defect (open_edge)" in str(error) and "try again" in error.next_step
    assert "Face3" in str(defect) and "and 8 more" in str(defect)
    assert "no.stl" in str(UnreadableFile("no.stl", "it is empty"))
    assert "make" in str(KernelMissing("absent"))
