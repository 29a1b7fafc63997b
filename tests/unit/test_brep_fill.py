# SPDX-License-Identifier: LGPL-2.1-or-later
"""Slits that a mesher leaves are closed, and what is wider stays open."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
import shapes

from freecad_tetra import Solid, kernel
from freecad_tetra.brep.fill import filled


def cube() -> Solid:
    made = shapes.cube()
    names = tuple(f"Face{i + 1}" for i in range(6))
    return Solid(made.vertices, made.triangles, np.arange(12, dtype=np.int32) // 2, names)


def without(solid: Solid, *rows: int) -> Solid:
    keep = np.delete(np.arange(len(solid.triangles)), rows)
    owners = None if solid.solid_ids is None else solid.solid_ids[keep]
    return replace(
        solid, triangles=solid.triangles[keep], face_ids=solid.face_ids[keep], solid_ids=owners
    )


def fill(solid: Solid, height: float = 1000.0) -> Solid:
    return filled(solid, kernel.triangulate_polygon, height)


def test_closed_solids_are_left_alone() -> None:
    whole = cube()
    assert fill(whole) is whole


@pytest.mark.parametrize("rows", [(0,), (0, 3), (4, 5)])
def test_slits_are_closed(rows: tuple[int, ...]) -> None:
    whole = cube()
    closed = fill(without(whole, *rows))
    assert not kernel.validate(closed).defects
    assert closed.volume() == pytest.approx(whole.volume(), rel=1e-14)
    assert len(closed.triangles) == 12 and len(closed.face_ids) == 12
    assert closed.notes["filled_holes"] == (1 if rows in [(0,), (4, 5)] else 2)


def test_a_triangle_goes_to_the_face_with_most_of_the_rim() -> None:
    points = np.array([[0, 0, 0], [9, 0, 0], [0, 1, 0], [0, 0, 1]], float)
    faces = np.array([[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]], np.int32)
    solid = Solid(points, faces, np.arange(4, dtype=np.int32), ("A", "B", "C", "D"))
    closed = fill(without(solid, 0))
    assert (
        sorted(closed.triangles[-1]) == [0, 1, 2] and closed.face_ids[-1] == 2
    )  # the longest side
    assert closed.volume() == pytest.approx(solid.volume(), rel=1e-14)


@pytest.mark.parametrize("rows", [(0,), (0, 1)])
def test_an_open_shell_stays_open(rows: tuple[int, ...]) -> None:
    holed = without(cube(), *rows)
    assert fill(holed, height=0.1) is holed
    assert fill(holed, height=100.0) is holed


def test_several_solids_are_closed_by_themselves() -> None:
    whole = cube()
    n = len(whole.vertices)
    pair = Solid(
        np.concatenate([whole.vertices, whole.vertices + 9]),
        np.concatenate([whole.triangles, whole.triangles + n]),
        np.concatenate([whole.face_ids, whole.face_ids]),
        whole.face_names,
        solid_ids=np.repeat(np.array([0, 1], np.int32), 12),
    )
    closed = fill(without(pair, 5, 20))
    assert not kernel.validate(closed).defects
    assert closed.solid_ids is not None and closed.solid_ids[-2:].tolist() == [0, 1]
