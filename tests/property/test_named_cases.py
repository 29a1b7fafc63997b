# SPDX-License-Identifier: LGPL-2.1-or-later
"""The named cases of the issues: exact volume, number of pieces, a proven partition or mesh."""

from __future__ import annotations

from functools import cache
from itertools import pairwise

import numpy as np
import pytest
from check_solids import check_cells, check_tets, decompose, lists_of_cells, validated
from shapes_exact import (
    NamedShape,
    chazelle,
    named_shapes,
    schoenhardt,
    torus,
    turned,
    volume_of,
)

SHAPES = named_shapes()
WHOLE = [shape for shape in SHAPES if shape.whole]
TURNED = [shape for shape in SHAPES if not shape.whole]


def name_of(value: object) -> str:
    return value.name if isinstance(value, NamedShape) else str(value)


@cache
def validation(name: str) -> dict[str, object]:
    return validated(next(s.surface for s in SHAPES if s.name == name))


@pytest.mark.parametrize("shape", SHAPES, ids=name_of)
def test_shape_is_what_it_says(shape):
    found = validation(shape.name)
    assert found["turned"] == []
    assert found["counts"]["genus"] == shape.genus
    assert found["counts"]["shells"] == shape.shells
    assert volume_of(shape.surface) == pytest.approx(shape.volume, rel=1e-14)


@pytest.mark.parametrize("shape", WHOLE, ids=name_of)
def test_cells_are_a_proven_partition(shape):
    for options in ({}, {"rule": "plain", "merge": False}):
        counts = check_cells(shape.surface, options)
    r, shells = counts["notches"], shape.shells
    assert counts["pieces"] <= r * (r + 1) // 2 + shells


@pytest.mark.parametrize("shape", [s for s in SHAPES if s.pieces], ids=name_of)
def test_number_of_cells(shape):
    found = decompose(shape.surface, validation(shape.name), {})
    assert len(lists_of_cells(found)) == shape.pieces


@pytest.mark.parametrize("shape", TURNED, ids=name_of)
def test_cells_of_turned_solids_keep_the_volume(shape):
    found = decompose(shape.surface, validation(shape.name), {})
    triangles = [
        (cycle[0], b, c)
        for cell in lists_of_cells(found)
        for cycle in cell
        for b, c in pairwise(cycle[1:])
    ]
    total = volume_of((found["points"], np.array(triangles)))
    assert total == pytest.approx(shape.volume, rel=1e-7)


@pytest.mark.parametrize("direction", ["auto", "x", "y", "z"])
@pytest.mark.parametrize("shape", SHAPES, ids=name_of)
def test_tetrahedra_are_proven(shape, direction):
    counts = check_tets(shape.surface, {"direction": direction})
    assert counts["lost"] == 0
    assert counts["on_grid"] == 0 or not shape.whole


@pytest.mark.parametrize("compact", ["default", "off", "max"])
@pytest.mark.parametrize("shape", SHAPES, ids=name_of)
def test_tetrahedra_of_cells_are_proven(shape, compact):
    counts = check_tets(shape.surface, {"method": "bajaj-dey", "compact": compact})
    assert counts["lost"] == 0
    assert counts["on_grid"] == 0 or not shape.whole


def test_plate_with_holes_has_no_crossing():
    """Seen through its 100 holes no two edges cross: a Steiner point is never made."""
    plate = next(s.surface for s in SHAPES if s.name == "plate_with_100_holes")
    options = {"pull_off": "off", "compact": "off"}
    assert check_tets(plate, options)["steiner"] == 0
    assert check_tets(plate, {**options, "direction": [1, 2, 3]})["steiner"] > 0


@pytest.mark.parametrize("method", ["chazelle-palios", "bajaj-dey"])
def test_tetrahedra_of_the_family_grow_with_the_square(method):
    """Between N^2, the lower bound's order, and 16 N^2; per N^2 they come to rest."""
    share = {}
    for n in (4, 8, 16):
        counts = check_tets(chazelle(n), {"method": method})
        share[n] = counts["tets"] / n**2
        assert 1 < share[n] < 16
    assert share[16] < share[8] < share[4]


def test_schoenhardt_needs_exactly_one_steiner_point():
    assert check_tets(schoenhardt(), {})["steiner"] == 1


def test_torus_is_as_good_turned():
    surface = torus(16, 8)
    counts = check_tets(turned(surface, (13, 29, 41)), {})
    assert counts["lost"] == 0


@pytest.mark.parametrize("notches", [2, 3, 4, 6, 8])
def test_lower_bound_family(notches):
    """Chazelle's (N + 2)^2 by default, the papers' bound by the papers' rule."""
    surface = chazelle(notches)
    assert check_cells(surface, {})["pieces"] == (notches + 2) ** 2
    r = 2 * notches + 2
    plain = decompose(surface, validated(surface), {"plain": True, "merge": False, "flatness": 0})
    assert len(lists_of_cells(plain)) <= r * (r + 1) // 2 + 1
