# SPDX-License-Identifier: LGPL-2.1-or-later
"""How well convex hulls stand for a part: samples with VTK, volumes with manifold3d.

Independent of the kernel: it knows triangles only.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import manifold3d
import numpy as np
import pyvista
from scipy.spatial import ConvexHull

Mesh = tuple[np.ndarray, np.ndarray]  # points (n, 3), triangles (t, 3)


def measure(part: Mesh, hulls: Sequence[np.ndarray], samples: int, seed: int) -> dict[str, float]:
    """Compare a part with the union of the hulls of some point sets.

    Returns
    -------
    dict
        ``outward``: largest distance found from the surface of the union to the part, 0 inside;
        ``inward``: largest found from the surface of the part to the union; ``error``: the
        larger; ``volume_added`` and ``volume_missed``: of the differences.
    """
    random = np.random.default_rng(seed)
    convex = [ConvexHull(points) for points in hulls]
    surface = _poly(*part)
    outside = np.concatenate([sampled(_mesh(h), samples // len(convex), random) for h in convex])
    # Points on the hull of one and strictly inside another are not on the union's surface.
    scale = np.ptp(part[0], axis=0).max()
    outside = outside[~_inside(outside, convex, -1e-9 * scale)]
    outward = np.maximum(_signed(outside, surface), 0.0)
    own = sampled(part, samples, random)
    own = own[~_inside(own, convex, 1e-9 * scale)]
    inward = np.full(len(own), np.inf)
    for hull in convex if len(own) else ():
        inward = np.minimum(inward, np.abs(_signed(own, _poly(*_mesh(hull)))))
    added, missed = _volumes(part, convex)
    result = {"outward": float(outward.max(initial=0)), "inward": float(inward.max(initial=0))}
    result |= {"error": max(result.values()), "volume_added": added, "volume_missed": missed}
    return result


def sampled(mesh: Mesh, count: int, random: np.random.Generator) -> np.ndarray:
    """Return points spread evenly over triangles, and all their corners, (k, 3)."""
    points, triangles = mesh
    a, b, c = (points[triangles[:, i]] for i in range(3))
    area = np.linalg.norm(np.cross(b - a, c - a), axis=1)
    row = random.choice(len(triangles), max(1, count), p=area / area.sum())
    u, v = random.random((2, len(row), 1))
    u, v = np.where(u + v > 1, 1 - u, u), np.where(u + v > 1, 1 - v, v)
    return np.concatenate([a[row] + u * (b - a)[row] + v * (c - a)[row], points])


def _mesh(hull: ConvexHull) -> Mesh:
    """Return the triangles of a hull turned outward."""
    points, triangles = hull.points, hull.simplices
    used, index = np.unique(triangles, return_inverse=True)
    corners = points[triangles]
    normal = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    wrong = np.einsum("ij,ij->i", normal, hull.equations[:, :3]) < 0
    triangles = index.reshape(-1, 3)
    triangles[wrong] = triangles[wrong][:, ::-1]
    return points[used], triangles


def _poly(points: np.ndarray, triangles: np.ndarray) -> Any:
    faces = np.column_stack([np.full(len(triangles), 3), triangles]).reshape(-1)
    return pyvista.PolyData(points, faces)


def _signed(points: np.ndarray, surface: Any) -> np.ndarray:
    """Return distances from a closed surface, negative inside."""
    if not len(points):
        return np.zeros(0)
    return np.asarray(
        pyvista.PolyData(points).compute_implicit_distance(surface)["implicit_distance"]
    )


def _inside(points: np.ndarray, hulls: Sequence[ConvexHull], reach: float) -> np.ndarray:
    """Return whether each point lies within `reach` beyond all planes of some hull."""
    inside = np.zeros(len(points), bool)
    for hull in hulls:
        beyond = points @ hull.equations[:, :3].T + hull.equations[:, 3]
        inside |= (beyond < reach).all(axis=1)
    return inside


def _solid(points: np.ndarray, triangles: np.ndarray) -> Any:
    mesh = manifold3d.Mesh64(np.array(points, float), np.array(triangles, np.uint64))
    return manifold3d.Manifold(mesh)


def _volumes(part: Mesh, hulls: Sequence[ConvexHull]) -> tuple[float, float]:
    body = _solid(*part)
    union = manifold3d.Manifold.batch_boolean(
        [_solid(*_mesh(h)) for h in hulls], manifold3d.OpType.Add
    )
    return float((union - body).volume()), float((body - union).volume())
