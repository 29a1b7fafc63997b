# SPDX-License-Identifier: LGPL-2.1-or-later
"""Directions in which a solid was probably made: normals of large planes, axes of round faces."""

from __future__ import annotations

import numpy as np

from freecad_tetra.model import FloatArray, Solid

_PARALLEL = 1e-6  # directions closer than this are one
_MOST_FACES = 16  # the largest ones; small faces don't tell how a solid was made
_FLAT = 1e-10  # share of squared area by which normals may leave their common plane


def candidates(surface: Solid, limit: int = 4) -> FloatArray:
    """Return up to `limit` unit directions by falling area, without the axes, (k, 3) float64.

    A face whose normals are all parallel proposes its normal; one whose normals are all
    perpendicular to a direction proposes that (cylinders, extrusions). O(m log m).
    """
    corners = surface.vertices[surface.triangles]
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    _, group = np.unique(surface.face_ids, return_inverse=True)
    areas = np.bincount(group, np.linalg.norm(normals, axis=1))
    found: list[tuple[float, FloatArray]] = []
    for k in np.argsort(-areas, kind="stable")[:_MOST_FACES]:
        direction = _direction(normals[group == k])
        if direction is not None:
            _add(found, float(areas[k]), direction)
    found = [f for f in found if np.abs(f[1]).max() < 1 - _PARALLEL**2]
    found.sort(key=lambda f: -f[0])
    return np.array([direction for _, direction in found[:limit]], np.float64).reshape(-1, 3)


def _direction(normals: FloatArray) -> FloatArray | None:
    values, vectors = np.linalg.eigh(np.einsum("ni,nj->ij", normals, normals))
    if values[2] <= 0:
        return None
    flat, straight = values[1] <= _FLAT * values[2], values[0] <= _FLAT * values[2]
    if not (flat or straight):
        return None
    direction: FloatArray = vectors[:, 2] if flat else vectors[:, 0]
    lead = direction[int(np.argmax(np.abs(direction)))]
    return direction if lead > 0 else -direction


def _add(found: list[tuple[float, FloatArray]], area: float, direction: FloatArray) -> None:
    for i, (before, other) in enumerate(found):
        if 1 - abs(direction @ other) < _PARALLEL**2 / 2:  # half the square of the angle
            found[i] = (before + area, other)
            return
    found.append((area, direction))
