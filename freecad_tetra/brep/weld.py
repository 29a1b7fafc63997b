# SPDX-License-Identifier: LGPL-2.1-or-later
"""Nodes of the faces of a B-rep become one by topology, and the faces one triangulated solid.

The i-th node of an edge is one node in every face that the edge bounds, its ends are the
edge's vertices, and all nodes of a degenerate edge are its one vertex. Distance decides
nothing; only nodes with equal coordinates are merged afterwards, which joins solids that
touch without sharing topology.
"""

from __future__ import annotations

from collections.abc import Hashable, Sequence
from typing import Any

import numpy as np

from freecad_tetra.model import Solid

Numbers = np.ndarray[Any, Any]


class Nodes:
    """Nodes of all faces, and the classes of those that are one."""

    def __init__(self) -> None:
        self._points: list[Numbers] = []
        self._parent: list[int] = []
        self._key: dict[Hashable, int] = {}

    def add(self, points: Numbers) -> int:
        """Add nodes (n, 3) and return the number of the first."""
        base = len(self._parent)
        self._points.append(points)
        self._parent.extend(range(base, base + len(points)))
        return base

    def weld_edge(
        self, nodes: Sequence[int], edge: Hashable, first: Hashable, last: Hashable, point: bool
    ) -> None:
        """Join the nodes of one edge in one face with their namesakes in other faces.

        Parameters
        ----------
        nodes : sequence of int
            Along the edge's own direction.
        edge, first, last : hashable
            Names of the edge and of its end vertices.
        point : bool
            The edge is degenerate: it is its first vertex.
        """
        if point:
            for node in nodes:
                self.join((0, first), node)
            return
        self.join((0, first), nodes[0])
        self.join((0, last), nodes[-1])
        for i, node in enumerate(nodes[1:-1], 1):
            self.join((edge, i), node)

    def join(self, key: Hashable, node: int) -> None:
        """Join a node with all others of that key."""
        a, b = self._find(self._key.setdefault(key, node)), self._find(node)
        if a != b:
            self._parent[max(a, b)] = min(a, b)

    def _find(self, node: int) -> int:
        parent = self._parent
        while parent[node] != node:
            parent[node] = parent[parent[node]]
            node = parent[node]
        return node

    def welded(self, triangles: Numbers) -> Numbers:
        """Return `triangles` with every node replaced by the first of its class."""
        root = np.array([self._find(i) for i in range(len(self._parent))], dtype=np.int64)
        return root[triangles]

    def points(self) -> Numbers:
        """Return the coordinates of all nodes, (n, 3), -0.0 turned into 0.0."""
        return np.concatenate([np.zeros((0, 3)), *self._points]) + 0.0


def compact(
    points: Numbers, triangles: Numbers, face_ids: Numbers, solid_ids: Numbers,
    names: tuple[str, ...], name: str, notes: dict[str, Any],
) -> Solid:  # fmt: skip
    """Merge equal coordinates, drop unused nodes and triangles with two equal corners."""
    used, inverse = np.unique(triangles, return_inverse=True)
    _, first, same = np.unique(points[used], axis=0, return_index=True, return_inverse=True)
    rank = np.argsort(np.argsort(first, kind="stable"), kind="stable")
    triangles = rank[same.reshape(-1)][inverse.reshape(-1)].reshape(-1, 3)
    keep = (triangles != np.roll(triangles, 1, axis=1)).all(axis=1)
    notes["collapsed_triangles"] = int((~keep).sum())
    return Solid(
        points[used][np.sort(first)], triangles[keep], face_ids[keep], names, name,
        solid_ids[keep], notes,
    )  # fmt: skip
