# SPDX-License-Identifier: LGPL-2.1-or-later
"""How far cells in floating point are from convex; knows nothing of the kernel's planes."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from scipy.spatial import ConvexHull, QhullError


def concavity(points: np.ndarray, cells: Sequence[Sequence[Sequence[int]]]) -> float:
    """Return the largest of two lengths over all cells: how deep a vertex lies inside its cell's
    hull, and the volume that the cell lacks of its hull by the hull's area.

    Parameters
    ----------
    points : (p, 3) float64
    cells : facets of point ids, counter-clockwise from outside
    """
    return max(_of_cell(points, facets) for facets in cells)


def _of_cell(points: np.ndarray, facets: Sequence[Sequence[int]]) -> float:
    own = points[sorted({i for facet in facets for i in facet})]
    try:
        hull = ConvexHull(own, qhull_options="Qt")
    except QhullError:  # flat
        return 0.0
    planes = hull.equations
    depth = -(own @ planes[:, :3].T + planes[:, 3]).max(axis=1).min()
    return max(float(depth), (hull.volume - volume(points - own[0], facets)) / hull.area)


def volume(points: np.ndarray, facets: Sequence[Sequence[int]]) -> float:
    """Return the volume that facets enclose; choose points near their origin."""
    total = 0.0
    for facet in facets:
        p = points[list(facet)]
        total += float((p[0] @ np.cross(p[1:-1], p[2:]).T).sum())
    return total / 6
