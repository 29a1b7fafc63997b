# SPDX-License-Identifier: LGPL-2.1-or-later
"""Finds what later cuts and unions have left of a face that was tagged before them.

cadquery keeps tagged faces as they were; a hole drilled afterwards makes a new face of them. A
face is taken for a remnant when a point inside one of the two lies on the other.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from OCP.Bnd import Bnd_Box
from OCP.BOPTools import BOPTools_AlgoTools3D
from OCP.BRepBndLib import BRepBndLib
from OCP.BRepBuilderAPI import BRepBuilderAPI_MakeVertex
from OCP.BRepExtrema import BRepExtrema_DistShapeShape
from OCP.gp import gp_Pnt, gp_Pnt2d
from OCP.IntTools import IntTools_Context
from OCP.TopoDS import TopoDS

_NEAR = 1e-6  # mm; ten times OpenCascade's own tolerance


def remnants(tagged: Any, faces: Sequence[Any]) -> list[int]:
    """Return the numbers of the `faces` that are remnants of the face `tagged`."""
    box, inside = _box(tagged), _point_inside(tagged)
    return [
        i
        for i, face in enumerate(faces)
        if not box.IsOut(_box(face))
        and (_lies_on(_point_inside(face), tagged) or _lies_on(inside, face))
    ]


def _box(face: Any) -> Any:
    box = Bnd_Box()
    BRepBndLib.Add_s(face, box, False)
    box.Enlarge(_NEAR)
    return box


def _point_inside(face: Any) -> Any | None:
    """Return a vertex at a point inside a face, None when OpenCascade finds none."""
    point = gp_Pnt()
    status = BOPTools_AlgoTools3D.PointInFace_s(
        TopoDS.Face_s(face), point, gp_Pnt2d(), IntTools_Context()
    )
    return BRepBuilderAPI_MakeVertex(point).Vertex() if status == 0 else None


def _lies_on(vertex: Any | None, face: Any) -> bool:
    if vertex is None:
        return False
    distance = BRepExtrema_DistShapeShape(vertex, face)
    return bool(distance.IsDone() and distance.Value() < _NEAR)
