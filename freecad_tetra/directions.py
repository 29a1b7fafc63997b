# SPDX-License-Identifier: LGPL-2.1-or-later
"""Directions in which a solid was probably made: normals of large planes, axes of round faces."""

from __future__ import annotations

from typing import Any

import numpy as np
import numpy.typing as npt

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
    groups = surface.face_ids if surface.face_names else _parallel_groups(normals)
    _, group = np.unique(groups, return_inverse=True)
    areas = np.bincount(group, np.linalg.norm(normals, axis=1))
    found: list[tuple[float, FloatArray]] = []
    for k in np.argsort(-areas, kind="stable")[:_MOST_FACES]:
        direction = _direction(normals[group == k])
        if direction is not None:
            _add(found, float(areas[k]), direction)
    found = [f for f in found if np.abs(f[1]).max() < 1 - _PARALLEL**2]
    found.sort(key=lambda f: -f[0])
    return np.array([direction for _, direction in found[:limit]], np.float64).reshape(-1, 3)


def _parallel_groups(normals: FloatArray) -> npt.NDArray[Any]:
    """Number the triangles of a bare mesh by their normal, up to sign."""
    size = np.linalg.norm(normals, axis=1, keepdims=True)
    unit = normals / np.where(size > 0, size, 1.0)
    first = np.take_along_axis(unit, np.argmax(np.abs(unit), axis=1)[:, None], axis=1)
    rounded = np.round(unit * np.where(first < 0, -1, 1) / _PARALLEL)
    _, groups = np.unique(rounded, axis=0, return_inverse=True)
    areas = np.bincount(groups.reshape(-1), weights=size[:, 0])
    rank = np.argsort(np.argsort(-areas, kind="stable"), kind="stable")[groups.reshape(-1)]
    # The small groups of a round wall propose nothing: all but the largest become one.
    return np.minimum(rank, 16)


def _direction(normals: FloatArray) -> FloatArray | None:
    values, vectors = np.linalg.eigh(normals.T @ normals)
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
