# SPDX-License-Identifier: LGPL-2.1-or-later
"""Nearest points on the faces and edges of a B-rep, whoever knows the geometry.

Planes and lines are computed here; curved faces and edges are asked of the geometry's owner.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from typing import Any

import numpy as np

from freecad_tetra.model import FloatArray

Line = tuple[FloatArray, FloatArray, float, float]


class Nearest(ABC):
    """Callable as `freecad_tetra.fem.project.Project`; faces are numbered as by `tessellate`."""

    def __init__(self) -> None:
        self._edges: dict[tuple[int, ...], list[Any]] = {}

    def __call__(self, faces: tuple[int, ...], points: FloatArray) -> FloatArray:
        """Return nearest points (n, 3); several faces mean the edges they share; NaN for none."""
        if len(faces) == 1:
            return self._on_face(faces[0], points)
        if faces not in self._edges:
            self._edges[faces] = self.shared_edges(faces)
        best = np.full(points.shape, np.nan)
        distance = np.full(len(points), np.inf)
        for edge in self._edges[faces]:
            found = self._on_edge(edge, points)
            away = np.linalg.norm(found - points, axis=1)
            closer = away < distance
            best[closer], distance[closer] = found[closer], away[closer]
        return best

    @abstractmethod
    def plane(self, face: int) -> tuple[FloatArray, FloatArray] | None:
        """Return a point and the unit normal of a planar face, None for a curved one."""

    @abstractmethod
    def on_surface(self, face: int, points: list[list[float]]) -> list[tuple[float, float, float]]:
        """Return nearest points on the surface of a curved face."""

    @abstractmethod
    def shared_edges(self, faces: tuple[int, ...]) -> list[Any]:
        """Return the edges that all of the faces have, but those that are points."""

    @abstractmethod
    def line(self, edge: Any) -> Line | None:
        """Return a point, the unit direction and the range of a straight edge, or None."""

    @abstractmethod
    def on_curve(self, edge: Any, points: list[list[float]]) -> list[tuple[float, float, float]]:
        """Return nearest points between the ends of a curved edge, NaN where there are none."""

    def _on_face(self, face: int, points: FloatArray) -> FloatArray:
        plane = self.plane(face)
        if plane is None:
            return np.array(self.on_surface(face, points.tolist())).reshape(-1, 3)
        origin, normal = plane
        flat: FloatArray = points - np.outer((points - origin) @ normal, normal)
        return flat

    def _on_edge(self, edge: Any, points: FloatArray) -> FloatArray:
        line = self.line(edge)
        if line is None:
            return np.array(self.on_curve(edge, points.tolist())).reshape(-1, 3)
        origin, direction, first, last = line
        along = (points - origin) @ direction
        inside = (along > first) & (along < last)
        out = np.full(points.shape, np.nan)
        out[inside] = origin + np.outer(along[inside], direction)
        return out
