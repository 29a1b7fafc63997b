# SPDX-License-Identifier: LGPL-2.1-or-later
"""Vertices with exactly equal coordinates are one vertex; nearness never counts."""

from __future__ import annotations

from typing import Any

import numpy as np
import numpy.typing as npt

from freecad_tetra.model import FloatArray


def classes(points: FloatArray) -> npt.NDArray[np.int64]:
    """Return for each point the lowest index of an equal point, (n,) int64, O(n log n)."""
    if not len(points):
        return np.zeros(0, np.int64)
    keys = np.ascontiguousarray(points + 0.0)  # -0.0 and 0.0 are equal
    order = np.lexsort(keys.T)  # stable: the lowest index leads its class
    ordered = keys[order]
    new = np.ones(len(order), bool)
    new[1:] = (ordered[1:] != ordered[:-1]).any(axis=1)
    leader = order[np.flatnonzero(new)]
    out = np.zeros(len(order), np.int64)
    out[order] = leader[np.cumsum(new) - 1]
    return out


def merged(points: FloatArray, triangles: npt.NDArray[Any]) -> npt.NDArray[np.int32]:
    """Return `triangles` with each corner replaced by the first vertex equal to it."""
    return classes(points)[triangles].astype(np.int32)


def compacted(soup: FloatArray) -> tuple[FloatArray, npt.NDArray[np.int32]]:
    """Return (points in the order of first use, triangles) of a soup (3 m, 3)."""
    leader = classes(soup)
    first, index = np.unique(leader, return_inverse=True)
    return soup[first], index.reshape(-1, 3).astype(np.int32)
