# SPDX-License-Identifier: LGPL-2.1-or-later
"""Areas of skin triangles and how a uniform traction is shared among their nodes.

Straight triangles have three nodes, curved ones six; integrals over curved ones use the rule of
seven points that is exact for quintics (Radon, Monatsh. Math. Phys. 52, 1948).
"""

from __future__ import annotations

from typing import Any

import numpy as np

from freecad_tetra.fem.jacobian import TRIANGLE_EDGES
from freecad_tetra.model import FloatArray, Tet10Mesh, TetMesh


def _rule() -> tuple[FloatArray, FloatArray]:
    """Return barycentric points (7, 3) and weights (7,) that sum up to 1."""
    rows, weights = [[1 / 3] * 3], [9 / 40]
    for sign in (-1, 1):
        near = (6 + sign * 15**0.5) / 21
        for i in range(3):
            rows.append([1 - 2 * near if i == j else near for j in range(3)])
            weights.append((155 + sign * 15**0.5) / 1200)
    return np.array(rows), np.array(weights)


POINTS, WEIGHTS = _rule()


def shapes(nodes: int) -> tuple[FloatArray, FloatArray]:
    """Return shape functions (7, n) and their derivatives (7, n, 2) of 3 or 6 nodes."""
    table, slopes = np.zeros((7, nodes)), np.zeros((7, nodes, 3))
    for q, at in enumerate(POINTS):
        for i in range(3):
            table[q, i] = at[i] if nodes == 3 else at[i] * (2 * at[i] - 1)
            slopes[q, i, i] = 1.0 if nodes == 3 else 4 * at[i] - 1
        for m, (i, j) in enumerate(TRIANGLE_EDGES[: nodes - 3], 3):
            table[q, m] = 4 * at[i] * at[j]
            slopes[q, m, i], slopes[q, m, j] = 4 * at[j], 4 * at[i]
    return table, slopes[:, :, 1:] - slopes[:, :, :1]


def normals(points: Any, triangles: Any) -> FloatArray:
    """Return area elements times normals at the seven points, (s, 7, 3)."""
    corners = np.asarray(points, float)[np.asarray(triangles)]
    _, slopes = shapes(corners.shape[1])
    tangents = np.einsum("qnk,snx->sqkx", slopes, corners)
    cross: FloatArray = np.cross(tangents[:, :, 0], tangents[:, :, 1]) / 2
    return cross


def areas(points: Any, triangles: Any) -> FloatArray:
    """Return the area of each triangle (s,), curved ones as they are."""
    out: FloatArray = np.linalg.norm(normals(points, triangles), axis=2) @ WEIGHTS
    return out


def shares(points: Any, triangles: Any) -> FloatArray:
    """Return the integral of each node's shape function over its triangle, (s, n).

    A uniform traction f gives node k of the triangle the force f times this share.
    """
    values, _ = shapes(np.asarray(triangles).shape[1])
    elements = np.linalg.norm(normals(points, triangles), axis=2)
    out: FloatArray = np.einsum("sq,q,qn->sn", elements, WEIGHTS, values)
    return out


def face_areas(mesh: TetMesh | Tet10Mesh) -> dict[int, float]:
    """Return the area of every B-rep face on the skin."""
    total = np.bincount(mesh.skin_face, weights=areas(mesh.points, mesh.skin))
    return {int(f): float(total[f]) for f in np.unique(mesh.skin_face)}
