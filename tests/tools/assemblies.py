# SPDX-License-Identifier: LGPL-2.1-or-later
"""Solids that touch: boxes of several solids, and voxels shared out among solids at random."""

from __future__ import annotations

import random
from collections import defaultdict
from typing import Any

import numpy as np
import numpy.typing as npt

from freecad_tetra.model import Solid, TetMesh

Corner = tuple[float, float, float]
SIDES = ((0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (2, 6, 7, 3), (0, 4, 6, 2), (1, 3, 7, 5))


def box(low: Corner, high: Corner, diagonal: int = 0, inside_out: bool = False) -> Any:
    """(vertices, triangles) of a box; `diagonal` 0 or 1 chooses those of its sides."""
    ends = np.array([low, high], float)
    vertices = [
        (ends[i, 0], ends[j, 1], ends[k, 2]) for k in (0, 1) for j in (0, 1) for i in (0, 1)
    ]
    triangles = []
    for side in SIDES:
        a, b, c, d = side[diagonal:] + side[:diagonal]
        triangles += [(a, b, c), (a, c, d)]
    rows = np.array(triangles)
    return np.array(vertices), rows[:, ::-1] if inside_out else rows


def assembly(*solids: list[Any]) -> Solid:
    """One Solid of several, each a list of (vertices, triangles), every side with a name."""
    vertices, triangles, numbers, faces, base = [], [], [], [], 0
    for number, surfaces in enumerate(solids):
        for points, rows in surfaces:
            triangles.append(rows + base)
            vertices.append(points)
            numbers.append(np.full(len(rows), number))
            faces.append(np.arange(len(rows)) // 2 + sum(len(f) for f in faces) // 2)
            base += len(points)
    ids = np.concatenate(faces)
    names = tuple(f"Face{i + 1}" for i in range(int(ids.max()) + 1))
    return Solid(
        np.concatenate(vertices), np.concatenate(triangles), ids, names, "", np.concatenate(numbers)
    )


def shared_voxels(seed: int, slanted: bool = False) -> tuple[Solid, float] | None:
    """Voxels of up to four solids, each side with its own diagonal, and their contact area.

    Uneven steps along the axes, or (`slanted`) even ones under an integer map. None when empty.
    """
    rng = random.Random(seed)
    n, labels = rng.choice([2, 3]), rng.choice([2, 3, 4])
    owner = {i: rng.randrange(labels + 1) - 1 for i in np.ndindex(n, n, n)}
    return _of_voxels(owner, rng, slanted)


def around_an_edge(seed: int, numbers: tuple[int, int, int]) -> tuple[Solid, float]:
    """Three quarters round an edge in the middle, with gaps away from it, and their contact area.

    The first and the last solid of `numbers` share only the edge; the one between touches both.
    """
    rng = random.Random(seed)
    quarter = {(0, 0): numbers[0], (1, 0): numbers[1], (1, 1): numbers[2]}
    owner = {}
    for x, y, z in np.ndindex(4, 4, 3):
        kept = (x in (1, 2) and y in (1, 2)) or rng.random() < 0.6
        owner[x, y, z] = quarter.get((x // 2, y // 2), -1) if kept else -1
    found = _of_voxels(owner, rng, slanted=True)
    assert found is not None
    solid, area = found
    order = np.argsort(solid.solid_ids, kind="stable")  # solids are meshed as triangles come
    rows, ids = solid.triangles[order], solid.solid_ids[order]
    return Solid(solid.vertices, rows, np.arange(len(rows)), (), "", ids), area


def _of_voxels(
    owner: dict[Any, int], rng: random.Random, slanted: bool
) -> tuple[Solid, float] | None:
    n = 1 + max(map(max, owner))
    steps = [np.cumsum([rng.random() + 0.1 for _ in range(n + 1)]) for _ in range(3)]
    matrix = np.array([[3, 1, -1], [-2, 4, 1], [1, -1, 5]]) / 4 if slanted else np.eye(3)
    number: dict[Any, int] = {}
    points: list[npt.NDArray[np.float64]] = []

    def vertex(label: int, place: tuple[int, ...]) -> int:
        if (label, place) not in number:
            number[label, place] = len(points)
            corner = np.array([steps[k][place[k]] for k in range(3)])
            points.append(matrix @ (np.round(corner * 64) / 64 if slanted else corner))
        return number[label, place]

    triangles, solid_ids, area = [], [], 0.0
    for cell, label in owner.items():
        if label < 0:
            continue
        for axis in range(3):
            for side in (0, 1):
                beyond = list(cell)
                beyond[axis] += 2 * side - 1
                other = owner.get(tuple(beyond), -1)
                if other == label:
                    continue
                quad = []
                for step in ((0, 0), (1, 0), (1, 1), (0, 1)):
                    place = list(cell)
                    place[axis] += side
                    place[(axis + 1) % 3] += step[0]
                    place[(axis + 2) % 3] += step[1]
                    quad.append(vertex(label, tuple(place)))
                quad = quad if side else quad[::-1]
                turn = rng.randrange(2)
                a, b, c, d = quad[turn:] + quad[:turn]
                triangles += [(a, b, c), (a, c, d)]
                solid_ids += [label, label]
                if other >= 0:  # met from both sides
                    sides = points[b] - points[a], points[d] - points[a]
                    area += float(np.linalg.norm(np.cross(*sides))) / 2
    if not triangles:
        return None
    rows = np.array(triangles)
    ids = np.arange(len(rows))
    return Solid(np.array(points), rows, ids, (), "", np.array(solid_ids)), area


def contact_area(mesh: TetMesh) -> float:
    """Area between solids of a mesh that must be face to face over all its solids."""
    sides = defaultdict(list)
    for number, tet in enumerate(mesh.tets.tolist()):
        for left_out in range(4):
            corners = tet[:left_out] + tet[left_out + 1 :]
            sides[tuple(sorted(corners))].append(int(mesh.tet_solid[number]))
    assert max(map(len, sides.values())) <= 2, "three tetrahedra on a triangle"
    between = [t for t, solids in sides.items() if len(set(solids)) == 2]
    outer = {t for t, solids in sides.items() if len(solids) == 1}
    skin = [tuple(sorted(t)) for t in mesh.skin.tolist()]
    twin = mesh.skin_twin
    assert twin is not None
    assert {t for t, i in zip(skin, twin) if i < 0} == outer
    assert sorted(t for t, i in zip(skin, twin) if i >= 0) == sorted(2 * between)
    assert all(twin[j] == i and skin[i] == skin[j] for i, j in enumerate(twin) if j >= 0)
    assert len(np.unique(mesh.points, axis=0)) == len(mesh.points)
    corners = mesh.points[np.array(between, int).reshape(-1, 3)]
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    return float(np.linalg.norm(normals, axis=1).sum() / 2)
