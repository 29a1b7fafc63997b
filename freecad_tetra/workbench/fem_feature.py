# SPDX-License-Identifier: LGPL-2.1-or-later
"""A FEM mesh as a document object: made of a solid, prepared for analysis, grouped.

Documents store the path of this module and the name of its class: both are a file format.
"""

from __future__ import annotations

import dataclasses
import hashlib
import json
from collections.abc import Mapping
from typing import Any

import FreeCAD
import numpy as np

from freecad_tetra import brep, kernel_file
from freecad_tetra.errors import BadOption, TetraError
from freecad_tetra.fem.prepare import FemOptions, prepare
from freecad_tetra.fem.remesh import Sizes
from freecad_tetra.model import TetMesh
from freecad_tetra.workbench import (
    compat,
    constraints,
    feature,
    fem_mesh,
    load_check,
    progress,
    properties,
    runner,
    source,
    store,
)

_FEM_INPUTS = ("Order", "Quality", "ElementsPerTurn", "FaceSizes", "Refinement")


class FemMesh(compat.Stateless):
    """Proxy of a Fem::FemMeshObjectPython, of a solid or of an object of tetrahedra."""

    def __init__(self, obj: Any) -> None:
        obj.Proxy = self
        properties.add(obj, properties.FEM_MESH)

    def execute(self, obj: Any) -> None:
        """FreeCAD calls this when something has changed; groups alone are made anew if they do."""
        with compat.errors_for_freecad():
            made = _tetrahedra_of(obj.Source)
            shape = _shape_of(obj.Source)
            if made is not None:
                mark = obj.Source.Fingerprint
            else:
                options = feature.options_of(obj)
                mark = source.fingerprint(shape, json.dumps(options))
            mark = _mark(mark, obj)
            if obj.Fingerprint.split("|")[0] != mark:
                if made is None:
                    job = runner.start("tetrahedralize", shape, {**options, "improve": True})
                    made = progress.wait(job, obj.Label)
                _fill(obj, made, shape)
            _group(obj, shape, mark)

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
        face_sizes(obj.FaceSizes)
    except TetraError:
        doc.removeObject(obj.Name)
        raise
    if FreeCAD.GuiUp:
        obj.ViewObject.Proxy = 0
    if analysis is not None:
        analysis.addObject(obj)
    return obj


def accept(obj: Any, mesh: TetMesh) -> None:
    """Make the mesh of the result of `feature.start`; the next recompute computes nothing.

    It holds as that of `feature.accept` does.
    """
    shape = _shape_of(obj.Source)
    _fill(obj, mesh, shape)
    _group(obj, shape, _mark(feature.mark_of(mesh), obj))


def update_groups(obj: Any) -> None:
    """Give the mesh groups for the constraints that its analysis has now, and check the loads."""
    with compat.errors_for_freecad():
        _group(obj, _shape_of(obj.Source), obj.Fingerprint.split("|")[0])


def options_of(obj: Any, names: tuple[str, ...]) -> FemOptions:
    """Return the options for analysis of an object; `names` are those of the B-rep's faces.

    Raises
    ------
    BadOption
    """
    asked = face_sizes(obj.FaceSizes)
    lost = [name for name in asked if name not in names]
    if lost:
        raise BadOption(f"there is no face {lost[0]}", f"choose Face1 to Face{len(names)}")
    by_number = {names.index(name): size for name, size in asked.items()}
    size = compat.millimetres(obj.ElementSize) or None
    turn = float(obj.ElementsPerTurn)
    packages = (*compat.package_folders(), *kernel_file.checkout_packages())
    return FemOptions(
        _order(obj.Order), bool(obj.Quality), Sizes(size, None, turn, by_number), obj.Refinement,
        packages,
    )  # fmt: skip


def face_sizes(lines: Any) -> dict[str, float]:
    """Read sizes such as ``Face3=0.5``.

    Raises
    ------
    BadOption
    """
    out = {}
    for line in lines:
        name, _, value = str(line).partition("=")
        try:
            out[name.strip()] = float(value)
        except ValueError:
            out[name.strip()] = 0.0
        if not out[name.strip()] > 0:
            raise BadOption(f"{line!r} is no size of a face", "write it as Face3=0.5")
    return out


def _fill(obj: Any, mesh: TetMesh, shape: Any) -> None:
    """Prepare the mesh for analysis and hand it to FreeCAD; warnings go to the report view."""
    project = None if shape is None else brep.projector(brep.as_shape(shape))
    options = options_of(obj, mesh.face_names)
    made = progress.watched(lambda told: prepare(mesh, options, project, told), obj.Label)
    obj.FemMesh = fem_mesh.fem_mesh(made)
    store.figures(obj, made)
    corners = int(made.tets[:, :4].max()) + 1
    obj.SteinerPoints = int((made.point_source[:corners] < 0).sum())
    for line in made.report.details["warnings"]:
        FreeCAD.Console.PrintWarning(f"{obj.Label}: {line}\n")


def _group(obj: Any, shape: Any, mark: str) -> None:
    """Make the groups of the constraints anew when they have changed, then check the loads."""
    analysis = constraints.analysis_of(obj)
    told = json.dumps(constraints.signature(analysis))
    wanted = f"{mark}|{hashlib.sha256(told.encode()).hexdigest()}"
    if obj.Fingerprint == wanted:
        return
    members = constraints.constraints_of(analysis)
    made = obj.FemMesh.copy()
    fem_mesh.remove_groups(made, {m.Name for m in (*obj.Constraints, *members)})
    if shape is not None:
        fem_mesh.add_groups(made, constraints.groups(made, analysis, shape, obj.Source))
    obj.FemMesh = made
    obj.Constraints = members
    obj.Fingerprint = wanted
    if members and obj.LoadCheck != "Off":
        load_check.check(analysis, strict=obj.LoadCheck == "Error")


def _mark(mark: str, obj: Any) -> str:
    """Return what changes with the source and with every input of the mesh."""
    inputs = [getattr(obj, name) for name in _FEM_INPUTS]
    inputs.append(compat.millimetres(obj.ElementSize))
    return f"{mark} {json.dumps(inputs, separators=(',', ':'))}"


def _shape_of(obj: Any) -> Any:
    """Return the B-rep that the mesh is of, where it lies; None when the tetrahedra lost it."""
    if not isinstance(getattr(obj, "Proxy", None), feature.Tetrahedra):
        return source.shape_of(obj)
    if obj.Source is None:
        return None
    shape = source.shape_of(obj.Source).copy(False)
    shape.Placement = obj.Placement.multiply(shape.Placement)
    return shape


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
    points = pieces.points @ placed[:3, :3].T + placed[:3, 3]
    return dataclasses.replace(pieces, points=points)


def _order(value: Any) -> int:
    if int(value) not in (1, 2):
        raise BadOption(f"order cannot be {value}", "use 1 or 2")
    return int(value)
