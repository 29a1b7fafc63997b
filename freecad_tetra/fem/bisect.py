# SPDX-License-Identifier: LGPL-2.1-or-later
"""Elements no longer than a size, by bisection of longest edges.

An edge is divided when it is the longest of all tetrahedra around it (a terminal edge: Rivara, Int.
J. Numer. Meth. Engng 40, 1997). All of them are divided with it, so the mesh stays face to face.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from freecad_tetra.errors import TetraError
from freecad_tetra.fem.jacobian import TET_EDGES
from freecad_tetra.fem.project import Project, project_points
from freecad_tetra.fem.second_order import tet_edges
from freecad_tetra.model import LongArray, TetMesh, rebuilt

MOST_ELEMENTS = 5_000_000


def bisect(mesh: TetMesh, size: float, project: Project | None = None) -> TetMesh:
    """Return the mesh with no edge longer than `size`.

    Parameters
    ----------
    mesh : TetMesh
    size : float
        In the unit of the model.
    project : Project, optional
        Takes new boundary points to the CAD at the end, as far as all tetrahedra stay positive;
        edges may then be a little longer.

    Returns
    -------
    TetMesh
        Old points keep their ids; skin triangles keep face and source.

    Raises
    ------
    TetraError
        The size asks for more than `MOST_ELEMENTS`.

    O(t) for each of some rounds, about three per halving of the longest edge.
    """
    work = _Work(mesh)
    while work.divide(size):
        if len(work.tets) > MOST_ELEMENTS:
            raise TetraError(f"size {size:g} asks for too many elements", "choose a larger size")
    fine = work.mesh()
    if project is None or len(fine.points) == len(mesh.points):
        return fine
    new = np.arange(len(fine.points)) >= len(mesh.points)
    return project_points(fine, project, new)[0]


def halve(mesh: TetMesh, chosen: LongArray) -> TetMesh:
    """Return the mesh with the edges `chosen` divided, rows of `second_order.tet_edges`.

    No tetrahedron may have two of them. New points follow the old ones, in the order of `chosen`.
    """
    work = _Work(mesh)
    work.halve(*tet_edges(mesh.tets), chosen)
    return work.mesh()


class _Work:
    """The growing arrays of a mesh."""

    def __init__(self, mesh: TetMesh) -> None:
        self._given = mesh
        self.points = np.array(mesh.points)
        self.tets = mesh.tets.astype(np.int64)
        self._solid = np.array(mesh.tet_solid)
        self._skin = mesh.skin.astype(np.int64)
        self._face, self._source = np.array(mesh.skin_face), np.array(mesh.skin_source)

    def divide(self, size: float) -> bool:
        """Divide all terminal edges above `size`; False when there are none."""
        ends, of_tets = tet_edges(self.tets)
        length = np.linalg.norm(self.points[ends[:, 0]] - self.points[ends[:, 1]], axis=1)
        if not (length > size).any():
            return False
        # A rank instead of the length: equal lengths are told apart in the same way everywhere.
        rank = np.empty(len(ends), np.int64)
        rank[np.argsort(length, kind="stable")] = np.arange(len(ends))
        longest = of_tets[np.arange(len(of_tets)), rank[of_tets].argmax(axis=1)]
        around = np.bincount(of_tets.reshape(-1), minlength=len(ends))
        terminal = np.bincount(longest, minlength=len(ends)) == around
        self.halve(ends, of_tets, np.flatnonzero(terminal & (length > size)))
        return True

    def halve(self, ends: LongArray, of_tets: LongArray, chosen: LongArray) -> None:
        """Divide edges, of which no tetrahedron has two."""
        middle = np.full(len(ends), -1, np.int64)
        middle[chosen] = len(self.points) + np.arange(len(chosen))
        self._divide_skin(ends, middle)
        self._divide_tets(of_tets, middle)
        halves = (self.points[ends[chosen, 0]] + self.points[ends[chosen, 1]]) / 2
        self.points = np.concatenate([self.points, halves])

    def _divide_tets(self, of_tets: LongArray, middle: LongArray) -> None:
        split = middle[of_tets] >= 0
        rows = np.flatnonzero(split.any(axis=1))
        local = np.argmax(split[rows], axis=1)
        pairs = np.array(TET_EDGES)[local]
        self.tets, twice = _halved(self.tets, rows, pairs, middle[of_tets[rows, local]])
        self._solid = self._solid[twice]

    def _divide_skin(self, ends: LongArray, middle: LongArray) -> None:
        size = len(self.points)
        codes = ends[:, 0] * size + ends[:, 1]
        pairs = np.sort(np.stack([self._skin, np.roll(self._skin, -1, axis=1)], axis=2), axis=2)
        edge = np.searchsorted(codes, pairs[:, :, 0] * size + pairs[:, :, 1])
        split = middle[edge] >= 0
        rows = np.flatnonzero(split.any(axis=1))
        local = np.argmax(split[rows], axis=1)
        corners = np.stack([local, (local + 1) % 3], axis=1)
        self._skin, twice = _halved(self._skin, rows, corners, middle[edge[rows, local]])
        self._face, self._source = self._face[twice], self._source[twice]

    def mesh(self) -> TetMesh:
        made = len(self.points) - len(self._given.points)
        source = np.concatenate([self._given.point_source, np.full(made, -1)])
        return rebuilt(
            self._given, self.points, self.tets, self._solid, self._skin, self._face, self._source,
            source,
        )  # fmt: skip


def _halved(table: LongArray, rows: LongArray, pairs: Any, middle: LongArray) -> tuple[Any, Any]:
    """Return the table with `rows` divided at the edge between local corners `pairs`.

    The first half stays in its row, the second ones follow at the end; with them the old row of
    every new one.
    """
    first, second = table.copy(), table[rows].copy()
    first[rows, pairs[:, 1]] = middle
    second[np.arange(len(rows)), pairs[:, 0]] = middle
    return np.concatenate([first, second]), np.concatenate([np.arange(len(table)), rows])
