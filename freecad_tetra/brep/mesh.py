# SPDX-License-Identifier: LGPL-2.1-or-later
"""One tessellation of a B-rep by OCP, whose faces meet in the nodes of their shared edges."""

from __future__ import annotations

from typing import Any

import numpy as np
from OCP.Bnd import Bnd_Box
from OCP.BRep import BRep_Tool
from OCP.BRepBndLib import BRepBndLib
from OCP.BRepBuilderAPI import BRepBuilderAPI_Copy
from OCP.BRepGProp import BRepGProp
from OCP.BRepMesh import BRepMesh_IncrementalMesh
from OCP.GProp import GProp_GProps
from OCP.TopAbs import TopAbs_Orientation, TopAbs_ShapeEnum
from OCP.TopExp import TopExp, TopExp_Explorer
from OCP.TopLoc import TopLoc_Location
from OCP.TopoDS import TopoDS
from OCP.TopTools import TopTools_IndexedMapOfShape

from freecad_tetra.brep import Deflection
from freecad_tetra.brep.contacts import share_contacts
from freecad_tetra.brep.weld import Nodes, compact
from freecad_tetra.errors import Defect, InvalidSolid
from freecad_tetra.model import Solid

FACE, EDGE = TopAbs_ShapeEnum.TopAbs_FACE, TopAbs_ShapeEnum.TopAbs_EDGE
SOLID = TopAbs_ShapeEnum.TopAbs_SOLID
FORWARD, REVERSED = TopAbs_Orientation.TopAbs_FORWARD, TopAbs_Orientation.TopAbs_REVERSED


def tessellate(shape: Any, deflection: Deflection, name: str, only: int | None) -> Solid:
    """Tessellate the solids of `shape`; see `freecad_tetra.brep.tessellate`."""
    # The copy keeps sub-shapes and their order, and spares the caller's shape the mesh.
    shape = BRepBuilderAPI_Copy(shape, False, False).Shape()
    solids = _solids(shape, only)
    linear = deflection.chord(_diagonal(shape))
    numbers = TopTools_IndexedMapOfShape()
    TopExp.MapShapes_s(shape, FACE, numbers)
    shared = share_contacts([s for _, s in solids], numbers)
    meshed = shape if shared is None else shared.shape
    mesh = BRepMesh_IncrementalMesh(meshed, linear, False, deflection.angle(), False)
    faces = _Faces(meshed)
    rows, face_ids, solid_ids = [], [], []
    bare: list[int] = []
    for place, (number, solid) in enumerate(solids):
        for face in _explore(solid if shared is None else shared.solids[place], FACE):
            if face.Orientation() not in (FORWARD, REVERSED):
                continue
            triangles = faces.triangles(faces.number(face))
            if face.Orientation() == REVERSED:
                triangles = triangles[:, ::-1]
            face_id = faces.number(face)
            if shared is not None:
                face_id = shared.origin[place][shared.faces.FindIndex(face)]
            if len(triangles) == 0 and face_id not in bare:
                bare.append(face_id)
            rows.append(triangles)
            face_ids.append(np.full(len(triangles), face_id, np.int32))
            solid_ids.append(np.full(len(triangles), number, np.int32))
    if bare:
        raise InvalidSolid([_no_mesh(bare, mesh.GetStatusFlags())])
    triangles = faces.nodes.welded(np.concatenate(rows)) if rows else np.zeros((0, 3), np.int32)
    notes = {
        "linear_deflection": linear,
        "angular_deflection": deflection.angular,
        "brep_volume": _volume([s for _, s in solids]),
        "solids": len(solids),
        "shared_faces": 0 if shared is None else shared.contacts,
    }
    return compact(
        faces.nodes.points(), triangles, np.concatenate(face_ids), np.concatenate(solid_ids),
        tuple(f"Face{i + 1}" for i in range(numbers.Extent())), name, notes,
    )  # fmt: skip


def _solids(shape: Any, only: int | None) -> list[tuple[int, Any]]:
    """Return (0-based number, solid); each TopoDS_Solid once, in the order of the file."""
    table = TopTools_IndexedMapOfShape()
    TopExp.MapShapes_s(shape, SOLID, table)
    count = table.Extent()
    if count == 0:
        defect = Defect("no_solid", "the model holds no solid, only faces, shells or wires")
        raise InvalidSolid([defect], next_step="make a solid of the shell and export it again")
    if only is not None and not 1 <= only <= count:
        defect = Defect("no_solid", f"there is no solid {only}, the model has {count}")
        raise InvalidSolid([defect], next_step=f"choose a solid from 1 to {count}")
    return [(i, table.FindKey(i + 1)) for i in range(count) if only is None or i == only - 1]


def _explore(shape: Any, kind: Any) -> list[Any]:
    found, explorer = [], TopExp_Explorer(shape, kind)
    cast = {FACE: TopoDS.Face_s, EDGE: TopoDS.Edge_s}[kind]
    while explorer.More():
        found.append(cast(explorer.Current()))
        explorer.Next()
    return found


def _diagonal(shape: Any) -> float:
    box = Bnd_Box()
    BRepBndLib.Add_s(shape, box, False)
    return 1.0 if box.IsVoid() else float(box.SquareExtent() ** 0.5)


def _volume(solids: list[Any]) -> float:
    total = 0.0
    for solid in solids:
        props = GProp_GProps()
        BRepGProp.VolumeProperties_s(solid, props)
        total += abs(props.Mass())
    return total


def _no_mesh(faces: list[int], status: int) -> Defect:
    names = tuple(f"Face{i + 1}" for i in faces)
    return Defect("no_mesh", f"OpenCascade cannot tessellate them (status {status})", faces=names)


class _Faces:
    """Triangulations of all faces of a shape, and the classes of their welded nodes."""

    def __init__(self, shape: Any) -> None:
        self._table = TopTools_IndexedMapOfShape()
        TopExp.MapShapes_s(shape, FACE, self._table)
        self._edges = TopTools_IndexedMapOfShape()
        self._vertices = TopTools_IndexedMapOfShape()
        self._triangles: dict[int, np.ndarray[Any, Any]] = {}
        self.nodes = Nodes()

    def number(self, face: Any) -> int:
        """Return the 0-based number of a face, as FreeCAD counts them."""
        return int(self._table.FindIndex(face)) - 1

    def triangles(self, number: int) -> np.ndarray[Any, Any]:
        """Return the triangles of a face as it lies in the file's FORWARD sense, (t, 3)."""
        if number not in self._triangles:
            # The map's copy carries the orientation of its first use: take it off.
            face = TopoDS.Face_s(self._table.FindKey(number + 1).Oriented(FORWARD))
            self._triangles[number] = self._load(number, face)
        return self._triangles[number]

    def _load(self, number: int, face: Any) -> np.ndarray[Any, Any]:
        location = TopLoc_Location()
        mesh = BRep_Tool.Triangulation_s(face, location)
        if mesh is None or mesh.NbTriangles() == 0:
            return np.zeros((0, 3), np.int64)
        points = []
        move = None if location.IsIdentity() else location.Transformation()
        for i in range(1, mesh.NbNodes() + 1):
            node = mesh.Node(i)
            if move is not None:
                node = node.Transformed(move)
            points.append((node.X(), node.Y(), node.Z()))
        base = self.nodes.add(np.array(points, dtype=np.float64).reshape(-1, 3))
        for edge in _explore(face, EDGE):
            self._weld_edge(edge, mesh, location, base)
        corners = [mesh.Triangle(i).Get() for i in range(1, mesh.NbTriangles() + 1)]
        return np.array(corners, dtype=np.int64).reshape(-1, 3) + (base - 1)

    def _weld_edge(self, edge: Any, mesh: Any, location: Any, base: int) -> None:
        """Join the nodes of one edge of a face with their namesakes in other faces.

        The edge's orientation selects the side of a seam, so it is passed on as it is.
        """
        polygon = BRep_Tool.PolygonOnTriangulation_s(edge, mesh, location)
        if polygon is None:
            return
        nodes = [base - 1 + polygon.Node(i) for i in range(1, polygon.NbNodes() + 1)]
        forward = TopoDS.Edge_s(edge.Oriented(FORWARD))
        first = self._vertices.Add(TopExp.FirstVertex_s(forward))
        last = self._vertices.Add(TopExp.LastVertex_s(forward))
        point = BRep_Tool.Degenerated_s(edge)
        number = 0 if point else self._edges.Add(edge)
        self.nodes.weld_edge(nodes, number, first, last, point)
