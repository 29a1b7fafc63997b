# SPDX-License-Identifier: LGPL-2.1-or-later
"""A FEM mesh as a document object: nodes, tetrahedra and the triangles of the skin.

Documents store the path of this module and the name of its class: both are a file format.
"""

from __future__ import annotations

import json
from collections.abc import Mapping
from typing import Any

import FreeCAD
import numpy as np

from freecad_tetra.errors import BadOption, TetraError
from freecad_tetra.export.elements import Elements, elements
from freecad_tetra.model import TetMesh
from freecad_tetra.workbench import compat, feature, progress, properties, runner, source, store


class FemMesh(compat.Stateless):
    """Proxy of a Fem::FemMeshObjectPython, of a solid or of an object of tetrahedra."""

    def __init__(self, obj: Any) -> None:
        obj.Proxy = self
        properties.add(obj, properties.FEM_MESH)

    def execute(self, obj: Any) -> None:
        """FreeCAD calls this when something has changed."""
        with compat.errors_for_freecad():
            mesh = _tetrahedra_of(obj.Source)
            if mesh is not None:
                mark = obj.Source.Fingerprint
            else:
                shape, options = source.shape_of(obj.Source), feature.options_of(obj)
                mark = source.fingerprint(shape, json.dumps(options))
            mark = f"{mark} {obj.Order}"
            if mark == obj.Fingerprint:
                return
            if mesh is None:
                job = runner.start("tetrahedralize", shape, options)
                mesh = progress.wait(job, obj.Label)
            obj.FemMesh = fem_mesh(elements(mesh, _order(obj.Order)))
            store.figures(obj, mesh)
            obj.Fingerprint = mark

    def onDocumentRestored(self, obj: Any) -> None:
        """FreeCAD calls this after opening a document and for a copy."""
        properties.migrate(obj, properties.FEM_MESH)


def make(doc: Any, source_object: Any, analysis: Any, order: int, given: Mapping[str, Any]) -> Any:
    """Add the object; see `freecad_tetra.workbench.feature.make_fem_mesh`."""
    properties.require(properties.FEM_MESH, given)
    obj = doc.addObject("Fem::FemMeshObjectPython", "TetraFemMesh")
    try:
        FemMesh(obj)
        obj.Source = source_object
        properties.fill(obj, properties.FEM_MESH, {**given, "Order": _order(order)})
    except TetraError:
        doc.removeObject(obj.Name)
        raise
    if FreeCAD.GuiUp:
        obj.ViewObject.Proxy = 0
    if analysis is not None:
        analysis.addObject(obj)
    return obj


def accept(obj: Any, mesh: TetMesh) -> None:
    """Store the result of `feature.start`; the next recompute computes nothing.

    It holds as that of `feature.accept` does.
    """
    obj.FemMesh = fem_mesh(elements(mesh, _order(obj.Order)))
    store.figures(obj, mesh)
    obj.Fingerprint = f"{feature.mark_of(mesh)} {obj.Order}"


def fem_mesh(grid: Elements) -> Any:
    """Return a Fem.FemMesh; nodes and elements count from 1, triangles follow tetrahedra.

    FreeCAD wants tetrahedra of negative orientation: the second and third corner change places.
    """
    import Fem

    mesh = Fem.FemMesh()
    for number, (x, y, z) in enumerate(grid.points.tolist(), 1):
        mesh.addNode(x, y, z, number)
    turn = [0, 2, 1, 3] if grid.order == 1 else [0, 2, 1, 3, 6, 5, 4, 7, 9, 8]
    for number, nodes in enumerate((grid.tets[:, turn] + 1).tolist(), 1):
        mesh.addVolume(nodes, number)
    for number, nodes in enumerate((grid.skin + 1).tolist(), len(grid.tets) + 1):
        mesh.addFace(nodes, number)
    return mesh


def _tetrahedra_of(obj: Any) -> TetMesh | None:
    """Return the tetrahedra of an object of ours, None for a solid."""
    if not isinstance(getattr(obj, "Proxy", None), feature.Tetrahedra):
        return None
    pieces = feature.pieces_of(obj)
    if not isinstance(pieces, TetMesh):
        raise TetraError(
            f"{obj.Label} holds no tetrahedra", "choose the solid, or an object of tetrahedra"
        )
    placed = np.array(obj.Placement.Matrix.A).reshape(4, 4)
    if np.array_equal(placed, np.eye(4)):
        return pieces
    import dataclasses

    points = pieces.points @ placed[:3, :3].T + placed[:3, 3]
    return dataclasses.replace(pieces, points=points)


def _order(value: Any) -> int:
    if int(value) not in (1, 2):
        raise BadOption(f"order cannot be {value}", "use 1 or 2")
    return int(value)
