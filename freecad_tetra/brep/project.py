# SPDX-License-Identifier: LGPL-2.1-or-later
"""Nearest points on a TopoDS_Shape, by OCP."""

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

from freecad_tetra.brep.nearest import Line, Nearest
from freecad_tetra.model import FloatArray

_PRECISION = 1e-9  # mm; FreeCAD takes a node for one of a face up to 1e-7
_NOWHERE = (float("nan"),) * 3
_FACE, _EDGE = TopAbs_ShapeEnum.TopAbs_FACE, TopAbs_ShapeEnum.TopAbs_EDGE


class Projector(Nearest):
    """Nearest points on a TopoDS_Shape."""

    def __init__(self, shape: Any) -> None:
        super().__init__()
        self._faces = _indexed(shape, _FACE)
        self._all_edges = _indexed(shape, _EDGE)
        self._surfaces: dict[int, Any] = {}

    def _face(self, number: int) -> Any:
        return TopoDS.Face_s(self._faces.FindKey(number + 1))

    def plane(self, face: int) -> tuple[FloatArray, FloatArray] | None:
        adaptor = BRepAdaptor_Surface(self._face(face), False)
        if adaptor.GetType() != GeomAbs_SurfaceType.GeomAbs_Plane:
            return None
        plane = adaptor.Plane()
        return _array(plane.Location()), _array(plane.Axis().Direction())

    def on_surface(self, face: int, points: list[list[float]]) -> list[tuple[float, float, float]]:
        surface = self._surfaces.get(face)
        if surface is None:
            surface = ShapeAnalysis_Surface(BRep_Tool.Surface_s(self._face(face)))
            self._surfaces[face] = surface
        out = []
        for x, y, z in points:
            found = surface.Value(surface.ValueOfUV(gp_Pnt(x, y, z), _PRECISION))
            out.append((found.X(), found.Y(), found.Z()))
        return out

    def shared_edges(self, faces: tuple[int, ...]) -> list[Any]:
        tables = [self._edges_of(face) for face in faces]
        first, *others = tables
        return [edge for i, edge in first.items() if all(i in other for other in others)]

    def _edges_of(self, number: int) -> dict[int, Any]:
        """Return the edges of a face by their number in the shape."""
        table = _indexed(self._face(number), _EDGE)
        rows = [TopoDS.Edge_s(table.FindKey(i)) for i in range(1, table.Extent() + 1)]
        return {
            int(self._all_edges.FindIndex(e)): e for e in rows if not BRep_Tool.Degenerated_s(e)
        }

    def line(self, edge: Any) -> Line | None:
        adaptor = BRepAdaptor_Curve(edge)
        if adaptor.GetType() != GeomAbs_CurveType.GeomAbs_Line:
            return None
        line = adaptor.Line()
        ends = adaptor.FirstParameter(), adaptor.LastParameter()
        return _array(line.Location()), _array(line.Direction()), *ends

    def on_curve(self, edge: Any, points: list[list[float]]) -> list[tuple[float, float, float]]:
        found = BRep_Tool.Curve_s(edge, 0.0, 0.0)
        curve = found[0] if isinstance(found, tuple) else found
        if curve is None:
            return [_NOWHERE] * len(points)
        adaptor = BRepAdaptor_Curve(edge)
        first, last = adaptor.FirstParameter(), adaptor.LastParameter()
        out = []
        for x, y, z in points:
            near = GeomAPI_ProjectPointOnCurve(gp_Pnt(x, y, z), curve, first, last)
            if near.NbPoints():
                q = near.NearestPoint()
                out.append((q.X(), q.Y(), q.Z()))
            else:
                out.append(_NOWHERE)
        return out


def _array(point: Any) -> FloatArray:
    return np.array([point.X(), point.Y(), point.Z()])


def _indexed(shape: Any, kind: Any) -> Any:
    table = TopTools_IndexedMapOfShape()
    TopExp.MapShapes_s(shape, kind, table)
    return table
