# SPDX-License-Identifier: LGPL-2.1-or-later
"""A slice of tools/fuzz_tets.py: random solids into tetrahedra, each mesh verified exactly."""

from __future__ import annotations

import random
from collections import Counter
from typing import Any

import numpy as np
import pytest
from check_solids import Unfit, check_tets, check_tets_at_once, validated
from exact_tets import verify_tets
from random_solids import (
    random_csg,
    random_hull,
    random_solid,
    random_type1,
    random_voxel,
    shuffled,
)
from shapes_exact import cube_with_cavity, sphere, stairs, turned

from freecad_tetra.kernel import load


def drawn_options(seed: int) -> dict[str, Any]:
    rng = random.Random(seed)
    return {
        "direction": "xyz"[seed % 3],
        "pull_off": rng.choice(["auto", "on", "off"]),
        "compact": rng.choice(["default", "off", "max"]),
        "seed": seed,
    }


def dented_hull(seed: int) -> Any:
    return random_hull(seed, dents=seed % 4)


@pytest.mark.parametrize("family", [random_voxel, random_type1, random_csg, dented_hull])
def test_random_solids_are_filled(family):
    sums, unfit = Counter(), 0
    for seed in range(40):
        try:
            sums.update(check_tets_at_once(family(seed), drawn_options(seed)))
        except Unfit:
            unfit += 1
    assert unfit <= 2
    assert sums["lost"] == 0
    assert sums["on_grid"] == 0, "whole numbers need no grid of their own"
    assert sums["volume_error"] == pytest.approx(0, abs=1e-12)


@pytest.mark.parametrize("family", [random_voxel, random_type1, random_csg, dented_hull])
def test_random_solids_are_filled_by_cells(family):
    sums, unfit = Counter(), 0
    for seed in range(40):
        options = {**drawn_options(seed), "method": "bajaj-dey"}
        try:
            sums.update(check_tets_at_once(family(seed), options))
        except Unfit:
            unfit += 1
    assert unfit <= 2
    assert sums["lost"] == 0 and sums["on_grid"] == 0
    assert sums["volume_error"] == pytest.approx(0, abs=1e-12)


def test_convex_solids_are_consumed_whole():
    """Pull-off alone fills them: no Steiner point, at most three tetrahedra a vertex."""
    for seed in range(20):
        surface = random_hull(seed)
        counts = check_tets_at_once(surface, {"pull_off": "on", "compact": "off"})
        assert counts["steiner"] == 0
        assert counts["tets"] <= 3 * len(surface[0])


def test_one_direction_is_as_good_as_another():
    for seed in range(12):
        surface = random_voxel(seed, "jitter")
        for direction in "xyz":
            check_tets(surface, {"direction": direction, "compact": "off", "pull_off": "off"})


def tetrahedralize(surface: Any, **options: Any) -> dict[str, Any]:
    checked = validated(surface)
    vertices = np.ascontiguousarray(surface[0], float)
    return load().tetrahedralize(vertices, checked["triangles"], checked["solid"], options)


def test_every_vertex_of_a_ball_comes_back():
    """Its corners are no grid points: whole strips of its wall are creased by the grid."""
    surface = sphere(100, 51, 2**20)
    found = tetrahedralize(surface)
    (solid,) = found["report"]["solids"]
    assert solid["failed_attempts"] == []
    assert found["report"]["repairs"]["vertices_on_grid"] == 0
    own = found["point_source"] >= 0
    assert sorted(found["point_source"][own]) == list(range(len(surface[0])))
    assert (found["points"][own] == surface[0][found["point_source"][own]]).all()


ARRAYS = ("points", "point_source", "tets", "tet_solid", "skin", "skin_source")


def test_repetition_gives_equal_bytes():
    for seed in range(20):
        surface = random_voxel(seed)
        first, again = (tetrahedralize(surface) for _ in range(2))
        for name in ARRAYS:
            assert first[name].tobytes() == again[name].tobytes(), name


def test_shuffled_input_gives_a_proven_mesh_too():
    for seed in range(20):
        surface, *_ = shuffled(random_solid(seed), np.random.default_rng(seed))
        try:
            check_tets(surface, {})
        except Unfit:
            continue


@pytest.mark.parametrize("shape", [cube_with_cavity, stairs])
def test_fifty_rotations(shape):
    rng = np.random.default_rng(2)
    for _ in range(50):
        vertices, triangles = turned(shape(), tuple(rng.uniform(-180, 180, 3)))
        found = tetrahedralize((vertices, triangles))
        verify_tets(
            vertices,
            triangles,
            found["points"],
            found["tets"],
            found["skin"],
            found["skin_source"],
            found["point_source"],
            found["report"]["repairs"]["vertices_on_grid"],
        )
