# SPDX-License-Identifier: LGPL-2.1-or-later
"""The exact verifiers accept true partitions and refuse each kind of false one."""

from __future__ import annotations

import numpy as np
import pytest
from exact_cells import NotAPartition, verify_partition
from exact_tets import NotATetMesh, verify_tets
from random_solids import (
    MAPS,
    Surface,
    mapped,
    random_cells,
    random_csg,
    random_hull,
    random_solid,
    random_voxel,
    shuffled,
    volume6,
    voxel_surface,
)

BOX = [[0, 3, 2, 1], [4, 5, 6, 7], [0, 1, 5, 4], [1, 2, 6, 5], [2, 3, 7, 6], [3, 0, 4, 7]]
KUHN = [(0, 1, 2, 6), (0, 2, 3, 6), (0, 3, 7, 6), (0, 7, 4, 6), (0, 4, 5, 6), (0, 5, 1, 6)]
CORNERS = np.array(
    [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0, 0, 1), (1, 0, 1), (1, 1, 1), (0, 1, 1)]
)


def boxes(seed: int):
    """A voxel solid under a general map, the points of its cells and the cells themselves."""
    rng = np.random.default_rng(seed)
    full = random_cells(rng)
    matrix = 7 * rng.integers(-3, 4, (3, 3)) + 2 * np.eye(3, dtype=int)
    if np.linalg.det(matrix) < 0:
        matrix[0] *= -1
    surface = mapped(voxel_surface(full), matrix)
    where = np.argwhere(full)
    points = ((where[:, None, :] + CORNERS).reshape(-1, 3) @ matrix.T).tolist()
    cells = [[[8 * i + v for v in cycle] for cycle in BOX] for i in range(len(where))]
    return surface, [(*p, 1) for p in points], cells


def test_true_partitions_are_accepted():
    for seed in range(30):
        surface, points, cells = boxes(seed)
        verify_partition(*surface, points, cells)
        doubled = [tuple(3 * c for c in p) for p in points]
        verify_partition(*surface, doubled, cells)


def refuse(surface: Surface, points, cells, match: str):
    with pytest.raises(NotAPartition, match=match):
        verify_partition(*surface, points, cells)


def test_false_partitions_are_refused():
    for seed in range(30):
        surface, points, cells = boxes(seed)
        refuse(surface, points, cells[1:], "volumes")
        refuse(surface, points, [*cells, cells[0]], "volumes")
        refuse(surface, points, [cells[0][1:], *cells[1:]], "not closed")
        inside_out = [[cycle[::-1] for cycle in cells[0]], *cells[1:]]
        refuse(surface, points, inside_out, "not convex")
        moved = [(4 * x, 4 * y, 4 * z + (i == 0), 4) for i, (x, y, z, _) in enumerate(points)]
        refuse(surface, moved, cells, "not convex|not planar|volumes")
        if len(cells) > 1:
            refuse(surface, points, [cells[0], cells[0], *cells[2:]], "do not cancel")


def test_overlap_balanced_by_a_gap_is_refused():
    surface, points, cells = voxel_surface(np.ones((2, 1, 1), bool)), [], []
    for low, high in ((0, 3), (2, 3)):  # in halves: [0, 1.5] and [1, 1.5] for a length of 2
        cells.append([[v + len(points) for v in cycle] for cycle in BOX])
        points += [(high if x else low, 2 * y, 2 * z, 2) for x, y, z in CORNERS.tolist()]
    refuse(surface, points, cells, "do not cancel")


def test_cell_with_two_facets_in_one_plane_is_refused():
    surface = voxel_surface(np.ones((1, 1, 1), bool))
    points = [(*p, 1) for p in CORNERS.tolist()]
    cell = [[0, 3, 2], [0, 2, 1], *BOX[1:]]
    refuse(surface, points, [cell], "one plane")


def kuhn(seed: int):
    """A voxel solid, and six tetrahedra for each of its cells with shared points."""
    surface, points, cells = boxes(seed)
    places, index = np.unique(np.array(points, dtype=float)[:, :3], axis=0, return_inverse=True)
    tets = np.array(
        [[index.reshape(-1)[8 * i + v] for v in t] for i in range(len(cells)) for t in KUHN]
    )
    return surface, places, tets


def source_of(vertices, places):
    row = {tuple(v): i for i, v in enumerate(np.asarray(vertices, dtype=float).tolist())}
    return np.array([row.get(tuple(p), -1) for p in places.tolist()])


def test_true_tetrahedra_are_accepted():
    for seed in range(20):
        (vertices, triangles), places, tets = kuhn(seed)
        source = source_of(vertices, places)
        result = verify_tets(vertices, triangles, places, tets, point_source=source)
        assert result["skin_exact"] == 1.0
        assert result["volume_error"] == 0.0


def test_false_tetrahedra_are_refused():
    for seed in range(10):
        (vertices, triangles), places, tets = kuhn(seed)
        turned = tets.copy()
        turned[0] = turned[0, [1, 0, 2, 3]]
        bent = places.copy()
        bent[tets[0, 0]] += 0.25
        for p, t, match in (
            (places, turned, "inverted"),
            (places, tets[1:], "volume|skin"),
            (places, np.concatenate([tets, tets[:1]]), "sides"),
            (bent, tets, "inverted|volume|skin|moved"),
        ):
            with pytest.raises(NotATetMesh, match=match):
                verify_tets(vertices, triangles, p, t)
        source = source_of(vertices, places)
        with pytest.raises(NotATetMesh, match="moved"):
            verify_tets(vertices, triangles, places + 1, tets, point_source=source)
        with pytest.raises(NotATetMesh, match="lost"):
            verify_tets(vertices, triangles, places + 1, tets, point_source=0 * source - 1)


def test_random_solids_are_closed_and_repeatable():
    from collections import Counter

    for seed in range(200):
        vertices, triangles = random_solid(seed)
        again = random_solid(seed)
        assert (vertices == again[0]).all() and (triangles == again[1]).all()
        balance: Counter[tuple[int, int]] = Counter()
        for a, b, c in triangles.tolist():
            for p, q in ((a, b), (b, c), (c, a)):
                balance[p, q] += 1
                balance[q, p] -= 1
        assert not any(balance.values()), seed
        assert volume6(vertices, triangles) > 0
        (mixed, faces), order, _ = shuffled((vertices, triangles), np.random.default_rng(seed))
        assert volume6(mixed, faces) == volume6(vertices, triangles)
        assert (mixed == vertices[order]).all()


def test_families_are_what_they_say():
    for kind in MAPS:
        vertices, _ = random_voxel(1, kind)
        assert np.abs(vertices).max() <= 2**20
    assert (random_hull(3)[0] == random_hull(3)[0]).all()
    assert len(random_csg(4)[1]) >= 4
