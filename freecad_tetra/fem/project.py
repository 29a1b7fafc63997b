# SPDX-License-Identifier: LGPL-2.1-or-later
"""Points that were made on facets are moved onto the CAD faces that the facets stand for.

How a point is projected is the caller's: OpenCascade on the command line, Part in FreeCAD. The
mesh only says which B-rep faces meet in the point.
"""

from __future__ import annotations

from dataclasses import replace
from typing import Any, Protocol

import numpy as np

from freecad_tetra.fem import jacobian, skin
from freecad_tetra.model import FloatArray, LongArray, TetMesh

_SHARE = 0.1  # of its volume that a tetrahedron must keep when its corners move
_STEPS = (1.0, 0.5, 0.25)


class Project(Protocol):
    """Nearest points on a B-rep."""

    def __call__(self, faces: tuple[int, ...], points: FloatArray) -> FloatArray:
        """Return the points nearest to `points` (n, 3) on what `faces` have in common.

        One face: the face itself. Several: an edge of all of them. Faces are 0-based (``Face1``
        is 0). A row of NaN stands for a point that cannot be projected.
        """


def projected(groups: dict[skin.Faces, LongArray], points: Any, project: Project) -> FloatArray:
    """Project `points` by groups of faces; what cannot be projected stays where it is."""
    out = np.array(points, float)
    for faces, rows in groups.items():
        found = np.asarray(project(faces, out[rows]), float)
        ok = np.isfinite(found).all(axis=1)
        out[rows[ok]] = found[ok]
    return out


def project_points(mesh: TetMesh, project: Project, only: Any = None) -> tuple[TetMesh, int, int]:
    """Move boundary Steiner points onto the CAD faces where all tetrahedra stay positive.

    Parameters
    ----------
    mesh : TetMesh
    project : Project
    only : (p,) bool, optional
        Points that may move; by default those that are no input vertices.

    Returns
    -------
    mesh, moved, left
        `left` points could not be moved all the way.

    O(t) for each of a few rounds.
    """
    free = np.asarray(mesh.point_source) < 0 if only is None else np.asarray(only, bool)
    groups = skin.faces_of_points(mesh.skin, mesh.skin_face)
    wanted = {}
    for faces, rows in groups.items():
        chosen = rows[free[rows]]
        if len(chosen) and len(faces) < 3:
            wanted[faces] = chosen
    if not wanted:
        return mesh, 0, 0
    target = projected(wanted, mesh.points, project)
    points, reached = _advance(np.array(mesh.points), target, mesh.tets)
    shift = (target != mesh.points).any(axis=1)
    left = int((shift & ~reached).sum())
    return replace(mesh, points=points), int(shift.sum()) - left, left


def _advance(points: FloatArray, target: FloatArray, tets: Any) -> tuple[FloatArray, Any]:
    """Move points to their targets, in part where a tetrahedron would lose too much.

    Steps back only at the corners of tetrahedra at fault, so the rest arrives.
    """
    six = jacobian.straight_determinants(points[tets])
    start = points.copy()
    share = np.where((points != target).any(axis=1), 1.0, 0.0)
    full = share > 0
    for step in (*_STEPS[1:], 0.0):
        while True:
            now = start + share[:, None] * (target - start)
            now[share == 1.0] = target[share == 1.0]
            bad = jacobian.straight_determinants(now[tets]) < _SHARE * six
            at_fault = np.zeros(len(points), bool)
            at_fault[np.unique(tets[bad])] = True
            at_fault &= share > step
            if not at_fault.any():
                break
            share[at_fault] = step
        if not bad.any():
            break
    return now, (share == 1.0) | ~full
