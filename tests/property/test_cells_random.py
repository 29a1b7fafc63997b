# SPDX-License-Identifier: LGPL-2.1-or-later
"""A slice of tools/fuzz_cells.py: random solids into convex cells, each proven exactly."""

from __future__ import annotations

import random
from collections import Counter
from itertools import pairwise
from typing import Any

import numpy as np
import pytest
from check_solids import Unfit, check_cells, decompose, validated
from random_solids import Surface, random_csg, random_solid, random_type1, random_voxel, shuffled
from shapes_exact import cube_with_cavity, stairs, turned, volume_of


def drawn_options(seed: int) -> dict[str, Any]:
    rng = random.Random(seed)
    return {
        "rule": rng.choice(["cover", "plain", "random"]),
        "extent": rng.choice(["notch", "whole", "random"]),
        "merge": rng.random() < 0.6,
        "seed": seed,
    }


@pytest.mark.parametrize("family", [random_voxel, random_type1, random_csg])
def test_random_solids_are_partitioned(family):
    passed, unfit = Counter(), 0
    for seed in range(60):
        try:
            passed.update(check_cells(family(seed), drawn_options(seed)))
        except Unfit:
            unfit += 1
    assert unfit <= 3
    assert passed["cuts"] > 100, "the slice must contain work"
    assert passed["pieces"] <= passed["raw_cells"]


def test_plain_rule_keeps_the_bound_of_the_papers():
    for seed in range(60):
        surface = random_solid(seed)
        try:
            checked = validated(surface)
        except Unfit:
            continue
        options = {"rule": "plain", "merge": False, "flatness": 0}
        counts = decompose(surface, checked, options)["report"]["counts"]
        r = counts["notches"]
        bodies = checked["counts"]["shells"]
        assert counts["pieces"] <= r * (r + 1) // 2 + bodies, seed


ARRAYS = ("points", "point_source", "facet_offsets", "facet_vertices", "facet_source",
          "cell_offsets", "cell_solid")  # fmt: skip


def cell_set(found: dict[str, Any]) -> list[Any]:
    """Cells as sets of facets as cycles of places, in no order at all."""
    points = [tuple(row) for row in found["points"].tolist()]
    vertices, offsets = found["facet_vertices"].tolist(), found["facet_offsets"].tolist()
    facets = []
    for a, b in pairwise(offsets):
        cycle = [points[v] for v in vertices[a:b]]
        k = cycle.index(min(cycle))
        facets.append(tuple(cycle[k:] + cycle[:k]))
    stops = found["cell_offsets"].tolist()
    return sorted(sorted(facets[a:b]) for a, b in pairwise(stops))


def fit_solids(count: int) -> list[Surface]:
    solids = []
    for seed in range(count):
        surface = random_solid(seed)
        try:
            validated(surface)
        except Unfit:
            continue
        solids.append(surface)
    return solids


def test_repetition_gives_equal_bytes():
    for surface in fit_solids(30):
        first, again = (decompose(surface, validated(surface), {}) for _ in range(2))
        for name in ARRAYS:
            assert first[name].tobytes() == again[name].tobytes(), name


def test_order_of_input_does_not_matter():
    for seed, surface in enumerate(fit_solids(30)):
        mixed, *_ = shuffled(surface, np.random.default_rng(seed))
        options = {"flatness": 0}
        expected = decompose(surface, validated(surface), options)
        found = decompose(mixed, validated(mixed), options)
        assert cell_set(found) == cell_set(expected), seed


def volumes(found: dict[str, Any]) -> float:
    """Total volume of the cells from their doubles."""
    vertices, offsets = found["facet_vertices"], found["facet_offsets"]
    fans = [
        (cycle[0], b, c)
        for cycle in (vertices[a:b] for a, b in pairwise(offsets))
        for b, c in pairwise(cycle[1:])
    ]
    return volume_of((found["points"], np.array(fans)))


@pytest.mark.parametrize("shape", [cube_with_cavity, stairs])
def test_volume_under_fifty_rotations(shape):
    surface = shape()
    expected = volume_of(surface)
    rng = np.random.default_rng(1)
    for _ in range(50):
        body = turned(surface, tuple(rng.uniform(-180, 180, 3)))
        found = decompose(body, validated(body), {})
        assert abs(volumes(found) - expected) <= 1e-7 * expected
