# SPDX-License-Identifier: LGPL-2.1-or-later
"""trimesh: cells as the list that its convex_decomposition gives, skins, scenes; scenes in."""

from __future__ import annotations

from typing import Any

import numpy as np

from freecad_tetra.adapters import require
from freecad_tetra.errors import Defect, InvalidSolid
from freecad_tetra.export import pieces
from freecad_tetra.labels import Labels, distinct, group_name
from freecad_tetra.model import Cell, ConvexCells, FloatArray, IntArray, Solid, TetMesh


def cells(result: ConvexCells) -> list[Any]:
    """Return one watertight ``trimesh.Trimesh`` per cell, in the order of the cells.

    ``metadata`` has the number of the ``cell`` and the name of its ``solid``.
    """
    trimesh = require("trimesh", "handing cells to trimesh")
    names = [result.labels.solid(s) for s in result.cell_solid.tolist()]
    return [_closed(trimesh, cell, {"cell": k, "solid": names[k]}) for k, cell in enumerate(result)]


def _closed(trimesh: Any, cell: Cell, metadata: dict[str, Any]) -> Any:
    mesh = trimesh.Trimesh(cell.points, cell.triangles(), process=False)
    mesh.metadata.update(metadata)
    return mesh


def skin(result: TetMesh) -> Any:
    """Return the skin as one Trimesh; ``face_attributes["face"]`` is the B-rep face."""
    trimesh = require("trimesh", "handing a skin to trimesh")
    return _skin(trimesh, result, np.ones(len(result.skin), bool))


def _skin(trimesh: Any, result: TetMesh, keep: Any) -> Any:
    used, index = np.unique(result.skin[keep], return_inverse=True)
    return trimesh.Trimesh(
        result.points[used],
        index.reshape(-1, 3),
        process=False,
        face_attributes={"face": result.skin_face[keep]},
        metadata={"face_names": list(result.face_names), "face_groups": dict(result.labels.faces)},
    )


def scene(result: ConvexCells | TetMesh) -> Any:
    """Return a Scene: ``Solid1_cell_0`` ... of cells, or the skin of each solid by its name."""
    trimesh = require("trimesh", "making a scene")
    whole = trimesh.Scene()
    if isinstance(result, ConvexCells):
        for mesh in cells(result):
            name = f"{mesh.metadata['solid']}_cell_{mesh.metadata['cell']}"
            whole.add_geometry(mesh, node_name=name, geom_name=name)
        return whole
    owner = _solid_of_skin(result)
    for number in np.unique(owner).tolist():
        name = result.labels.solid(number)
        mesh = _skin(trimesh, result, owner == number)
        whole.add_geometry(mesh, node_name=name, geom_name=name)
    return whole


def _solid_of_skin(result: TetMesh) -> IntArray:
    """Return the solid of every skin triangle, (s,) int32."""
    row = pieces.skin_rows(result)
    owner = np.zeros(len(result.skin), np.int32)
    owner[row[row >= 0]] = result.tet_solid[np.flatnonzero(row >= 0) // 4]
    return owner


def solid_of_scene(whole: Any) -> Solid:
    """Return all meshes of a Scene where its graph places them, one named solid per node.

    Raises
    ------
    InvalidSolid
        ``empty`` when the scene holds no mesh.
    """
    points: list[FloatArray] = []
    triangles: list[Any] = []
    owners: list[Any] = []
    names: list[str] = []
    count = 0
    for node in whole.graph.nodes_geometry:
        matrix, name = whole.graph[node]
        mesh = whole.geometry[name]
        if not hasattr(mesh, "faces"):  # paths and point clouds bound nothing
            continue
        vertices = np.asarray(mesh.vertices, np.float64)
        faces = np.asarray(mesh.faces, np.int64)
        if not np.array_equal(matrix, np.eye(4)):
            vertices = vertices @ matrix[:3, :3].T + matrix[:3, 3]
            faces = faces[:, ::-1] if np.linalg.det(matrix[:3, :3]) < 0 else faces
        points.append(vertices)
        triangles.append(faces + count)
        owners.append(np.full(len(faces), len(names)))
        names.append(group_name(str(node)))
        count += len(vertices)
    if not points:
        raise InvalidSolid([Defect("empty", "the scene holds no mesh")])
    return Solid(
        np.concatenate(points), np.concatenate(triangles),
        solid_ids=np.concatenate(owners), labels=Labels(distinct(names)),
    )  # fmt: skip
