# SPDX-License-Identifier: LGPL-2.1-or-later
"""Nearest points on a FreeCAD Part.Shape, by FreeCAD's own geometry."""

from __future__ import annotations

from typing import Any

import numpy as np

from freecad_tetra.brep.nearest import Line, Nearest
from freecad_tetra.model import FloatArray

_NOWHERE = (float("nan"),) * 3


class Projector(Nearest):
    """Nearest points on a Part.Shape."""

    def __init__(self, shape: Any) -> None:
        super().__init__()
        self._faces = shape.Faces
        self._surfaces: dict[int, Any] = {}

    def _surface(self, face: int) -> Any:
        if face not in self._surfaces:
            self._surfaces[face] = self._faces[face].Surface
        return self._surfaces[face]

    def plane(self, face: int) -> tuple[FloatArray, FloatArray] | None:
        surface = self._surface(face)
        if surface.TypeId != "Part::GeomPlane":
            return None
        return np.array(tuple(surface.Position)), np.array(tuple(surface.Axis))

    def on_surface(self, face: int, points: list[list[float]]) -> list[tuple[float, float, float]]:
        from FreeCAD import Vector

        surface = self._surface(face)
        return [tuple(surface.value(*surface.parameter(Vector(*p)))) for p in points]

    def shared_edges(self, faces: tuple[int, ...]) -> list[Any]:
        first, *others = (self._faces[face].Edges for face in faces)
        return [
            edge
            for edge in first
            if not edge.Degenerated and all(any(e.isSame(edge) for e in o) for o in others)
        ]

    def line(self, edge: Any) -> Line | None:
        curve = edge.Curve
        if curve.TypeId != "Part::GeomLine":
            return None
        origin, direction = np.array(tuple(curve.Location)), np.array(tuple(curve.Direction))
        return origin, direction, edge.FirstParameter, edge.LastParameter

    def on_curve(self, edge: Any, points: list[list[float]]) -> list[tuple[float, float, float]]:
        from FreeCAD import Vector

        curve, first, last = edge.Curve, edge.FirstParameter, edge.LastParameter
        period = curve.period() if curve.isPeriodic() else 0.0
        out: list[tuple[float, float, float]] = []
        for p in points:
            at = curve.parameter(Vector(*p))
            if period:
                at = first + (at - first) % period
            out.append(tuple(curve.value(at)) if first <= at <= last else _NOWHERE)
        return out
