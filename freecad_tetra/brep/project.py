# SPDX-License-Identifier: LGPL-2.1-or-later
"""Nearest points on the faces and edges of an OpenCascade shape."""

from __future__ import annotations

from typing import Any

import numpy as np
from OCP.BRep import BRep_Tool
from OCP.BRepAdaptor import BRepAdaptor_Curve, BRepAdaptor_Surface
from OCP.GeomAbs import GeomAbs_CurveType, GeomAbs_SurfaceType
from OCP.GeomAPI import GeomAPI_ProjectPointOnCurve
from OCP.gp import gp_Pnt
from OCP.ShapeAnalysis import ShapeAnalysis_Surface
from OCP.TopAbs import TopAbs_ShapeEnum
from OCP.TopExp import TopExp
from OCP.TopoDS import TopoDS
from OCP.TopTools import TopTools_IndexedMapOfShape

from freecad_tetra.model import FloatArray

_PRECISION = 1e-9  # mm; FreeCAD takes a node for one of a face up to 1e-7
_FACE, _EDGE = TopAbs_ShapeEnum.TopAbs_FACE, TopAbs_ShapeEnum.TopAbs_EDGE


class Projector:
    """Callable as `freecad_tetra.fem.project.Project`; faces are numbered as by `tessellate`."""

    def __init__(self, shape: Any) -> None:
        self._faces = _indexed(shape, _FACE)
        self._edges: dict[int, dict[int, Any]] = {}
        self._all_edges = _indexed(shape, _EDGE)
        self._surfaces: dict[int, Any] = {}

    def __call__(self, faces: tuple[int, ...], points: FloatArray) -> FloatArray:
        """Return nearest points; planes are exact, several faces mean their common edges."""
        if len(faces) == 1:
            return self._on_face(faces[0], points)
        return self._on_edges(self._common_edges(faces), points)

    def _face(self, number: int) -> Any:
        return TopoDS.Face_s(self._faces.FindKey(number + 1))

    def _on_face(self, number: int, points: FloatArray) -> FloatArray:
        face = self._face(number)
        adaptor = BRepAdaptor_Surface(face, False)
        if adaptor.GetType() == GeomAbs_SurfaceType.GeomAbs_Plane:
            plane = adaptor.Plane()
            normal, origin = plane.Axis().Direction(), plane.Location()
            n = np.array([normal.X(), normal.Y(), normal.Z()])
            o = np.array([origin.X(), origin.Y(), origin.Z()])
            return points - np.outer((points - o) @ n, n)
        surface = self._surfaces.get(number)
        if surface is None:
            surface = ShapeAnalysis_Surface(BRep_Tool.Surface_s(face))
            self._surfaces[number] = surface
        out = np.empty_like(points)
        for i, (x, y, z) in enumerate(points.tolist()):
            parameters = surface.ValueOfUV(gp_Pnt(x, y, z), _PRECISION)
            q = surface.Value(parameters)
            out[i] = q.X(), q.Y(), q.Z()
        return out

    def _common_edges(self, faces: tuple[int, ...]) -> list[Any]:
        maps = [self._edges_of(f) for f in faces]
        shared = [i for i in maps[0] if all(i in m for m in maps[1:])]
        return [maps[0][i] for i in shared]

    def _edges_of(self, number: int) -> dict[int, Any]:
        """Return the edges of a face by their number in the shape."""
        if number not in self._edges:
            table = _indexed(self._face(number), _EDGE)
            rows = [TopoDS.Edge_s(table.FindKey(i)) for i in range(1, table.Extent() + 1)]
            self._edges[number] = {
                int(self._all_edges.FindIndex(e)): e for e in rows if not BRep_Tool.Degenerated_s(e)
            }
        return self._edges[number]

    def _on_edges(self, edges: list[Any], points: FloatArray) -> FloatArray:
        best = np.full(points.shape, np.nan)
        distance = np.full(len(points), np.inf)
        for edge in edges:
            found = _on_edge(edge, points)
            away = np.linalg.norm(found - points, axis=1)
            closer = away < distance
            best[closer], distance[closer] = found[closer], away[closer]
        return best


def _on_edge(edge: Any, points: FloatArray) -> FloatArray:
    """Return nearest points between the ends of an edge; NaN where there are none."""
    out = np.full(points.shape, np.nan)
    adaptor = BRepAdaptor_Curve(edge)
    if adaptor.GetType() == GeomAbs_CurveType.GeomAbs_Line:
        line = adaptor.Line()
        d, o = line.Direction(), line.Location()
        direction = np.array([d.X(), d.Y(), d.Z()])
        origin = np.array([o.X(), o.Y(), o.Z()])
        along = (points - origin) @ direction
        inside = (along > adaptor.FirstParameter()) & (along < adaptor.LastParameter())
        out[inside] = origin + np.outer(along[inside], direction)
        return out
    curve, first, last = _curve(edge)
    if curve is None:
        return out
    for i, (x, y, z) in enumerate(points.tolist()):
        near = GeomAPI_ProjectPointOnCurve(gp_Pnt(x, y, z), curve, first, last)
        if near.NbPoints():
            q = near.NearestPoint()
            out[i] = q.X(), q.Y(), q.Z()
    return out


def _curve(edge: Any) -> tuple[Any, float, float]:
    found = BRep_Tool.Curve_s(edge, 0.0, 0.0)
    curve = found[0] if isinstance(found, tuple) else found
    adaptor = BRepAdaptor_Curve(edge)
    return curve, adaptor.FirstParameter(), adaptor.LastParameter()


def _indexed(shape: Any, kind: Any) -> Any:
    table = TopTools_IndexedMapOfShape()
    TopExp.MapShapes_s(shape, kind, table)
    return table
