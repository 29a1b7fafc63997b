# SPDX-License-Identifier: LGPL-2.1-or-later
"""The middle of each piece, from which pieces are drawn apart."""

from __future__ import annotations

import numpy as np

from freecad_tetra.model import ConvexCells, FloatArray, TetMesh


def centres(pieces: ConvexCells | TetMesh) -> FloatArray:
    """Return the mean of the corners of every piece, (pieces, 3), O(size)."""
    if isinstance(pieces, TetMesh):
        return pieces.points[pieces.tets].mean(axis=1)
    size = np.diff(pieces.facet_offsets)
    cell_of_facet = np.repeat(np.arange(len(pieces)), np.diff(pieces.cell_offsets))
    cell = np.repeat(cell_of_facet, size)
    key = np.unique(cell.astype(np.int64) * max(1, len(pieces.points)) + pieces.facet_vertices)
    owner, corner = np.divmod(key, max(1, len(pieces.points)))
    count = np.bincount(owner, minlength=len(pieces))
    sums = [np.bincount(owner, pieces.points[corner, k], len(pieces)) for k in range(3)]
    return np.stack(sums, axis=1) / np.maximum(count, 1)[:, None]
