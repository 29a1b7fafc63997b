# SPDX-License-Identifier: LGPL-2.1-or-later
"""Room below a curved boundary: elements that cannot bear their curved edges are divided inside.

A tetrahedron with two faces on one smooth surface has almost a straight angle between them once
they are curved. The edge across, inside the solid, is divided, and its middle moves away from the
surface: what is left has one face there. The boundary stays as it is.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from freecad_tetra.fem import skin
from freecad_tetra.fem.bisect import halve
from freecad_tetra.fem.quality import dihedral_angles
from freecad_tetra.fem.second_order import edge_ids, tet_edges
from freecad_tetra.fem.smooth import settle
from freecad_tetra.model import LongArray, TetMesh

_COLUMNS = [0, 3, 1, 2, 4, 5]  # of `dihedral_angles`: the angle across each of `TET_EDGES`


def make_room(mesh: TetMesh, poor: Any) -> TetMesh:
    """Divide an inner edge of each of the tetrahedra `poor`, where it has one.

    Parameters
    ----------
    mesh : TetMesh
    poor : (k,) int
        Tetrahedra, worst first: of two that would both be divided twice the first is served.

    Returns
    -------
    TetMesh
        Old points and the skin are unchanged; the same mesh when nothing can be divided.

    O(t log t).
    """
    ends, of_tets = tet_edges(mesh.tets)
    chosen = _independent(_inner_edges(mesh, ends, of_tets, np.asarray(poor, np.int64)), of_tets)
    if not len(chosen):
        return mesh
    made = halve(mesh, chosen)
    return settle(made, np.arange(len(mesh.points), len(made.points)))


def _inner_edges(mesh: TetMesh, ends: LongArray, of_tets: LongArray, poor: LongArray) -> LongArray:
    """Return for each tetrahedron the edge across its widest angle that is no boundary edge."""
    outside = np.zeros(len(ends), bool)
    outside[edge_ids(ends, skin.skin_edges(mesh.skin).ends, len(mesh.points))] = True
    edges = of_tets[poor]
    angle = dihedral_angles(mesh.points[mesh.tets[poor]])[:, _COLUMNS]
    angle[outside[edges]] = -1.0
    rows, best = np.arange(len(poor)), angle.argmax(axis=1)
    inner: LongArray = edges[rows, best][angle[rows, best] >= 0]
    return inner


def _independent(edges: LongArray, of_tets: LongArray) -> LongArray:
    """Return edges of which no tetrahedron has two, the first ones first."""
    order = np.argsort(of_tets.reshape(-1), kind="stable")
    start = np.searchsorted(of_tets.reshape(-1)[order], [edges, edges + 1])
    busy = np.zeros(len(of_tets), bool)
    chosen = []
    for edge, first, last in zip(edges.tolist(), *start.tolist()):
        around = order[first:last] // 6
        if not busy[around].any():
            busy[around] = True
            chosen.append(edge)
    return np.array(chosen, np.int64)
