# SPDX-License-Identifier: LGPL-2.1-or-later
"""Uniform red refinement: every tetrahedron becomes eight, every skin triangle four.

The four corners are copies at half size; the octahedron between them is divided along its shortest
diagonal, which bounds how flat the pieces get (Zhang, Houston J. Math. 21, 1995). Sides are always
divided in the same way, so the result is face to face again.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from freecad_tetra.fem import jacobian
from freecad_tetra.fem.project import Project, project_points
from freecad_tetra.fem.second_order import edge_ids, tet_edges
from freecad_tetra.fem.skin import skin_edges
from freecad_tetra.model import FloatArray, LongArray, TetMesh, rebuilt

# Nodes as in `Tet10Mesh`: corners 0 to 3, middles 4 to 9.
_CORNERS = ((0, 4, 6, 7), (4, 1, 5, 8), (6, 5, 2, 9), (7, 8, 9, 3))
_DIAGONALS = ((4, 9), (5, 7), (6, 8))
_RINGS = ((6, 7, 8, 5), (4, 8, 9, 6), (4, 5, 9, 7))
_TRIANGLES = ((0, 3, 5), (3, 1, 4), (5, 4, 2), (3, 4, 5))


def _octahedra() -> LongArray:
    """Return the four tetrahedra around each diagonal, positively oriented, (3, 4, 4)."""
    unit = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]], float)
    nodes = np.concatenate([unit, [(unit[i] + unit[j]) / 2 for i, j in jacobian.TET_EDGES]])
    out = []
    for (p, q), ring in zip(_DIAGONALS, _RINGS):
        for r, s in zip(ring, ring[1:] + ring[:1]):
            positive = jacobian.straight_determinants(nodes[None, [p, q, r, s]])[0] > 0
            out.append((p, q, r, s) if positive else (p, q, s, r))
    return np.array(out).reshape(3, 4, 4)


_OCTAHEDRA = _octahedra()


def refine(mesh: TetMesh, project: Project | None = None) -> TetMesh:
    """Return the mesh with every tetrahedron divided into eight, O(t log t).

    Parameters
    ----------
    mesh : TetMesh
    project : Project, optional
        Takes new boundary points to the CAD, as far as all tetrahedra stay positive.

    Returns
    -------
    TetMesh
        Old points keep their ids; skin triangles keep face and source.
    """
    ends, index = tet_edges(mesh.tets)
    base = len(mesh.points)
    points = np.concatenate([mesh.points, (mesh.points[ends[:, 0]] + mesh.points[ends[:, 1]]) / 2])
    nodes = np.hstack([mesh.tets.astype(np.int64), index + base])
    tets = _children(points, nodes)
    table = skin_edges(mesh.skin)
    place = edge_ids(ends, table.ends, base)[table.of_triangle] + base
    rows = np.hstack([mesh.skin.astype(np.int64), place])
    skin = rows[:, np.array(_TRIANGLES)].reshape(-1, 3)
    fine = rebuilt(
        mesh, points, tets, np.repeat(mesh.tet_solid, 8), skin, np.repeat(mesh.skin_face, 4),
        np.repeat(mesh.skin_source, 4), np.append(mesh.point_source, np.full(len(ends), -1)),
    )  # fmt: skip
    if project is None:
        return fine
    new = np.arange(len(points)) >= base
    return project_points(fine, project, new)[0]


def _children(points: FloatArray, nodes: LongArray) -> LongArray:
    """Return the eight tetrahedra of each, (8 t, 4), parents in order."""
    lengths = [
        np.linalg.norm(points[nodes[:, p]] - points[nodes[:, q]], axis=1) for p, q in _DIAGONALS
    ]
    shortest = np.argmin(lengths, axis=0)  # the first of equals: always the same
    inner: Any = np.take_along_axis(
        nodes[:, None, :], _OCTAHEDRA[shortest].reshape(len(nodes), 1, 16), axis=2
    )
    corners = nodes[:, np.array(_CORNERS)].reshape(len(nodes), 16)
    return np.hstack([corners, inner.reshape(len(nodes), 16)]).reshape(-1, 4)


def refined(mesh: TetMesh, times: int, project: Project | None = None) -> TetMesh:
    """Return the mesh refined `times` times; elements grow by eight each time."""
    for _ in range(times):
        mesh = refine(mesh, project)
    return mesh
