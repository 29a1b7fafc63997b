# SPDX-License-Identifier: LGPL-2.1-or-later
"""The few worst tetrahedra of a mesh are bettered by moving their corners.

Each corner is tried at positions around it and goes where the least dihedral angle of all its
tetrahedra is largest, as in the optimisation-based smoothing of Freitag and Ollivier-Gooch (Int. J.
Numer. Meth. Engng 40, 1997) with a pattern search in place of the gradient. Corners on the
boundary stay on their CAD face or edge.
"""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np

from freecad_tetra.fem import jacobian, skin
from freecad_tetra.fem.project import Project
from freecad_tetra.fem.quality import dihedral_angles, quality
from freecad_tetra.model import FloatArray, TetMesh

_AXES = np.array([v for v in np.ndindex(3, 3, 3) if v.count(1) in (0, 2)], float) - 1
_DIRECTIONS = _AXES / np.maximum(np.linalg.norm(_AXES, axis=1), 1)[:, None]
_START, _STOP = 0.3, 0.01  # reach of the search, as a share of the shortest edge at the corner
_MOST = 3000  # tetrahedra; above it something else is wrong


def smooth(
    mesh: TetMesh, target: float, project: Project | None = None, sweeps: int = 4
) -> tuple[TetMesh, int]:
    """Move corners of tetrahedra whose least dihedral angle is below `target`.

    Parameters
    ----------
    mesh : TetMesh
    target : float
        Radians.
    project : Project, optional
        Without it only corners inside the solid move.
    sweeps : int

    Returns
    -------
    mesh, moved : TetMesh, int
        No least angle of a star gets smaller. O(k) for k tetrahedra below the target.
    """
    points = np.array(mesh.points)
    places = {int(v): f for f, rows in skin.faces_of_points(mesh.skin, mesh.skin_face).items()
              for v in rows}  # fmt: skip
    around = _Stars(mesh.tets, len(points))
    moved: set[int] = set()
    for _ in range(sweeps):
        now = quality(replace(mesh, points=points)).min_dihedral
        poor = np.flatnonzero(now < target)
        if not 0 < len(poor) <= _MOST:
            break
        corners = dict.fromkeys(mesh.tets[poor[np.argsort(now[poor])]].reshape(-1).tolist())
        changed = [v for v in corners if _move(points, around.star(v), v, places.get(v), project)]
        if not changed:
            break
        moved.update(changed)
    return replace(mesh, points=points), len(moved)


def settle(mesh: TetMesh, corners: Any) -> TetMesh:
    """Move the corners given, one after the other, where their stars are best, O(k).

    They have to lie inside.
    """
    points = np.array(mesh.points)
    around = _Stars(mesh.tets, len(points))
    for v in corners:
        _move(points, around.star(v), int(v), None, None)
    return replace(mesh, points=points)


class _Stars:
    """The tetrahedra around each point."""

    def __init__(self, tets: Any, points: int) -> None:
        self._tets = np.asarray(tets, np.int64)
        flat = self._tets.reshape(-1)
        self._order = np.argsort(flat, kind="stable") // 4
        self._start = np.searchsorted(np.sort(flat), np.arange(points + 1))

    def star(self, v: int) -> Any:
        return self._tets[self._order[self._start[v] : self._start[v + 1]]]


def _move(
    points: FloatArray, star: Any, v: int, faces: skin.Faces | None, project: Project | None
) -> bool:
    """Search for a better place of point `v`; True when it moved."""
    if faces is not None and (project is None or len(faces) > 2):
        return False
    corners = points[star]
    own = star == v
    best = float(_least_angles(corners, own, points[v : v + 1])[0])
    others = np.linalg.norm(corners - points[v], axis=2)
    shortest = float(others[~own].min())
    reach, at, moved = _START, points[v].copy(), False
    while reach > _STOP:
        tried = at + reach * shortest * _DIRECTIONS
        if faces is not None and project is not None:
            tried = np.asarray(project(faces, tried), float)
            tried = tried[np.isfinite(tried).all(axis=1)]
        values = _least_angles(corners, own, tried)
        k = int(values.argmax()) if len(values) else 0
        if len(values) and values[k] > best + 1e-6:
            best, at, moved = float(values[k]), tried[k], True
        else:
            reach /= 2
    if moved:
        points[v] = at
    return moved


def _least_angles(corners: FloatArray, own: Any, places: FloatArray) -> FloatArray:
    """Return the least dihedral angle of a star for each place of its point, (k,)."""
    trial = np.repeat(corners[None], len(places), axis=0)
    trial[:, own] = places[:, None]
    flat = trial.reshape(-1, 4, 3)
    volume = jacobian.straight_determinants(flat)
    angle = np.where(volume > 0, dihedral_angles(flat).min(axis=1), np.minimum(volume, 0.0) - 1.0)
    least: FloatArray = angle.reshape(len(places), -1).min(axis=1)
    return least
