# SPDX-License-Identifier: LGPL-2.1-or-later
"""Signed flags (see exact_cells) of triangles with small whole coordinates, in 64-bit integers."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

Ints = npt.NDArray[np.int64]

# Plane offsets are below 3 * 8 * reach^3 and have to fit 63 bits.
REACH = 2**18


def fits(points: npt.NDArray[np.float64]) -> bool:
    """Whether the coordinates are whole and small enough for `same_surface`."""
    return bool((np.abs(points) <= REACH).all() and (points == np.rint(points)).all())


def _primitive(rows: Ints) -> Ints:
    """Rows divided by their greatest common divisor, the first non-zero number positive."""
    divisor = np.gcd.reduce(rows, axis=1)
    rows = rows // np.maximum(divisor, 1)[:, None]
    lead = rows[np.arange(len(rows)), (rows != 0).argmax(axis=1)]
    return rows * np.where(lead < 0, -1, 1)[:, None]


def _ids(rows: Ints) -> tuple[Ints, int]:
    """A number for each row, equal for equal rows, and how many there are."""
    order = np.lexsort(rows.T)
    fresh = np.r_[True, (rows[order[1:]] != rows[order[:-1]]).any(axis=1)]
    ids = np.empty(len(rows), np.int64)
    ids[order] = np.cumsum(fresh) - 1
    return ids, int(fresh.sum())


def same_surface(ours: Ints, theirs: Ints) -> bool:
    """Whether oriented triangles (n, 3, 3) and (m, 3, 3) are the same surface, exactly.

    Raises
    ------
    ValueError
        A triangle is flat.
    """
    corners = np.concatenate([ours, theirs])
    weight = np.repeat([1, -1], [len(ours), len(theirs)])
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    if (normals == 0).all(axis=1).any():
        raise ValueError("a triangle is flat")
    normals = _primitive(normals)
    planes, _ = _ids(np.c_[normals, (normals * corners[:, 0]).sum(axis=1)])
    tails, heads = corners.reshape(-1, 3), np.roll(corners, -1, axis=1).reshape(-1, 3)
    along = _primitive(heads - tails)
    lines, line_count = _ids(np.c_[along, np.cross(tails, along)])
    points, point_count = _ids(np.concatenate([tails, heads]))
    key = np.repeat(planes, 3) * line_count + lines
    flags = np.concatenate([key, key]) * point_count + points
    signs = np.repeat(weight, 3)
    _, place = np.unique(flags, return_inverse=True)
    return not np.bincount(place, weights=np.concatenate([-signs, signs])).any()
