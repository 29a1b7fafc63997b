# SPDX-License-Identifier: LGPL-2.1-or-later
"""Cells stay convex in the caller's coordinates, where the corners of the solid are no grid points.

The grid's planes and the caller's differ by a rounding, which far from a small facet is much.
"""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from check_solids import Unfit, decompose, lists_of_cells, validated
from concavity import concavity, volume
from off_grid_solids import dented_cube
from random_solids import Surface, read_off

CASES = sorted((Path(__file__).resolve().parents[1] / "cases" / "off_grid").glob("*.off"))
TOLERANCE = 2.0**-22  # of the diagonal


def check(surface: Surface) -> None:
    vertices, triangles = surface
    diagonal = float(np.linalg.norm(np.ptp(vertices, axis=0)))
    checked = validated(surface)
    for options in ({}, {"flatness": 0}, {"method": "auto"}, {"merge": False}):
        found = decompose(surface, checked, options)
        cells = lists_of_cells(found)
        assert concavity(found["points"], cells) <= TOLERANCE * diagonal
        wanted = volume(vertices, triangles)
        assert sum(volume(found["points"], c) for c in cells) == pytest.approx(wanted, rel=1e-7)


def test_there_are_cases():
    assert CASES


@pytest.mark.parametrize("path", CASES, ids=lambda path: path.stem)
def test_cases(path):
    check(read_off(path))


@pytest.mark.parametrize("first", range(0, 160, 20))
def test_dented_cubes(first):
    checked = 0
    for seed in range(first, first + 20):
        try:
            check(dented_cube(seed))
            checked += 1
        except Unfit:
            pass  # pits that overlap, or smaller than the grid can tell
    assert checked >= 10
