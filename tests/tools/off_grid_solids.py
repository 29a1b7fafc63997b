# SPDX-License-Identifier: LGPL-2.1-or-later
"""Solids whose corners are no grid points and whose facets are as small as a few grid steps."""

from __future__ import annotations

import numpy as np
from random_solids import Surface
from scipy.spatial import Delaunay


def dented_cube(seed: int, dents: int | None = None) -> Surface:
    """A unit cube with 1 to 5 small three-sided pits in its top; 12 + 8 triangles a pit.

    The plane of a pit's side turns by much when its corners are rounded to the grid.
    """
    rng = np.random.default_rng(seed)
    count = dents or int(rng.integers(1, 6))
    size = 10 ** rng.uniform(-7.5, -4)
    top: list[tuple[float, ...]] = [(0, 0, 1), (1, 0, 1), (1, 1, 1), (0, 1, 1)]
    for x, y in rng.uniform(0.1, 0.9, (count, 2)):
        for angle in rng.uniform(0, 2 * np.pi) + np.arange(3) * 2 * np.pi / 3:
            top.append((x + size * np.cos(angle), y + size * np.sin(angle), 1))
        top.append((x, y, 1 - size * rng.uniform(0.2, 1)))
    vertices = np.array([*top, (0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0)], np.float64)
    n = len(top)
    flat = vertices[:n, :2]
    triangles = []
    for a, b, c in Delaunay(flat, qhull_options="Qbb Qc Qz").simplices:
        (ux, uy), (vx, vy) = flat[b] - flat[a], flat[c] - flat[a]
        triangles.append((a, b, c) if ux * vy > uy * vx else (a, c, b))
    triangles += [(n, n + 2, n + 1), (n, n + 3, n + 2)]
    for i, j in ((0, 1), (1, 2), (2, 3), (3, 0)):
        triangles += [(n + i, n + j, j), (n + i, j, i)]
    return vertices, np.array(triangles, np.int32)
