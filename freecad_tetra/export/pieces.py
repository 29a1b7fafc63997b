# SPDX-License-Identifier: LGPL-2.1-or-later
"""Pieces of a result as OpenCascade solids: one compound, common faces shared."""

from __future__ import annotations

import tempfile
from pathlib import Path
from typing import Any

import numpy as np

from freecad_tetra.errors import MissingDependency, TetraError
from freecad_tetra.export import brep
from freecad_tetra.model import ConvexCells, TetMesh

_SIDES = [[0, 2, 1], [0, 1, 3], [1, 2, 3], [0, 3, 2]]


def occ_compound(result: ConvexCells | TetMesh) -> Any:
    """Return a TopoDS_Compound with one solid per piece, in the order of the pieces.

    Raises
    ------
    MissingDependency
        OCP is not installed.
    TetraError
        A piece is too thin for OpenCascade's tolerance.
    """
    cells = as_cells(result) if isinstance(result, TetMesh) else result
    try:
        from OCP.BRep import BRep_Builder
        from OCP.BRepTools import BRepTools
        from OCP.TopoDS import TopoDS_Compound
    except ImportError as error:
        raise MissingDependency("OCP", "making CAD solids", "cadquery-ocp") from error
    shape = TopoDS_Compound()
    with tempfile.TemporaryDirectory() as folder:
        text = Path(folder) / "pieces.brep"
        with text.open("wb") as out:
            brep.write_cells(cells, out)
        if not BRepTools.Read_s(shape, str(text), BRep_Builder()):
            raise TetraError("OpenCascade cannot read the pieces", "write .brep and report it")
    if shape.NbChildren() != len(cells):
        raise TetraError(
            f"{len(cells) - shape.NbChildren()} pieces are too thin for OpenCascade",
            "use the arrays or the files instead, or a coarser deflection",
        )
    return shape


def names(result: ConvexCells | TetMesh) -> list[str]:
    """Return a name per piece: that of its solid, and the number of the piece."""
    tets = isinstance(result, TetMesh)
    owner = result.tet_solid if isinstance(result, TetMesh) else result.cell_solid
    kind = "tet" if tets else "cell"
    return [f"{result.labels.solid(s)}_{kind}_{k}" for k, s in enumerate(owner.tolist())]


def as_cells(mesh: TetMesh) -> ConvexCells:
    """Return tetrahedra as convex cells of four facets each, O(t log t)."""
    loops = mesh.tets[:, _SIDES].reshape(-1, 3)
    row = skin_rows(mesh)
    # One row more, so that -1 finds something in an empty skin too.
    source, face = (np.append(values, -1)[row] for values in (mesh.skin_source, mesh.skin_face))
    return ConvexCells(
        points=mesh.points,
        facet_offsets=np.arange(len(loops) + 1) * 3,
        facet_vertices=loops.reshape(-1),
        cell_offsets=np.arange(len(mesh) + 1) * 4,
        facet_source=source,
        facet_face=face,
        cell_solid=mesh.tet_solid,
        point_source=mesh.point_source,
        face_names=mesh.face_names,
        report=mesh.report,
        labels=mesh.labels,
    )


def skin_rows(mesh: TetMesh) -> Any:
    """Return the row in ``skin`` of the four sides of every tetrahedron, -1 inside, (4 t,)."""
    sides = _turned(mesh.tets[:, _SIDES].reshape(-1, 3))
    _, index = np.unique(np.concatenate([_turned(mesh.skin), sides]), axis=0, return_inverse=True)
    index = index.reshape(-1)
    place = np.full(int(index.max(initial=0)) + 1, -1, np.int64)
    place[index[: len(mesh.skin)]] = np.arange(len(mesh.skin))
    return place[index[len(mesh.skin) :]]


def _turned(triangles: Any) -> Any:
    """Return triangles with the smallest id first, turned and not mirrored."""
    first = np.argmin(triangles, axis=1)[:, None]
    return np.take_along_axis(triangles, (first + np.arange(3)) % 3, axis=1)
