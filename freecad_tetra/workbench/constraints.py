# SPDX-License-Identifier: LGPL-2.1-or-later
"""Which faces and solids the constraints and materials of an analysis are about.

FreeCAD looks for nodes by distance unless the mesh has a group named after the constraint: these
groups are made from the B-rep faces that carry the triangles, and nothing is left to distance.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from freecad_tetra.workbench import fem_mesh as meshes
from freecad_tetra.workbench.fem_mesh import NamedGroup

_SAME = 1e-6  # of the diagonal: how near two descriptions of one face have to be


def analysis_of(mesh_object: Any) -> Any:
    """Return the analysis that holds a mesh object, or None."""
    for parent in mesh_object.InList:
        if parent.isDerivedFrom("Fem::FemAnalysis") and mesh_object in parent.Group:
            return parent
    return None


def constraints_of(analysis: Any) -> list[Any]:
    """Return the constraints and materials of an analysis, those with references to shapes."""
    if analysis is None:
        return []
    return [
        member
        for member in analysis.Group
        if "References" in member.PropertiesList and not member.isDerivedFrom("Fem::FemMeshObject")
    ]


def is_material(member: Any) -> bool:
    """Whether a member of an analysis is a material of solids."""
    return member.isDerivedFrom("App::MaterialObject") or "Material" in member.PropertiesList


def faces_of(member: Any, shape: Any, source: Any = None) -> list[int] | None:
    """Return the faces (0-based, of `shape`) that a constraint refers to.

    None when it refers to anything that is no face of the shape: then FreeCAD has to search.
    """
    found = []
    for owner, names in member.References:
        for name in _names(names):
            place = _index(owner, name, "Face", shape.Faces, source)
            if place is None:
                return None
            found.append(place)
    return found


def solids_of(member: Any, shape: Any, source: Any = None) -> list[int] | None:
    """Return the solids (0-based) that a material is given to; [] when it names none."""
    found: list[int] = []
    for owner, names in member.References:
        for name in _names(names):
            if not name:
                return None
            place = _index(owner, name, "Solid", shape.Solids, source)
            if place is None:
                return None
            found.append(place)
    return found


def groups(made: Any, analysis: Any, shape: Any, source: Any = None) -> list[NamedGroup]:
    """Return the groups of all constraints and materials of an analysis.

    Parameters
    ----------
    made : Fem.FemMesh
        With the groups of the B-rep.
    analysis : Fem::FemAnalysis or None
    shape : Part.Shape
        What was meshed.
    source : document object
        Its owner: references to it are taken by number, others by geometry.
    """
    out: list[NamedGroup] = []
    members = constraints_of(analysis)
    for member in members:
        if is_material(member):
            continue
        faces = faces_of(member, shape, source)
        if faces:
            for kind, tail in ((meshes.NODES, "Nodes"), (meshes.FACES, "Faces")):
                ids = [meshes.group_ids(made, f"Face{face + 1}_{tail}") for face in faces]
                out.append(
                    NamedGroup(f"{member.Name}_{tail}", kind, np.unique(np.concatenate(ids)))
                )
    return out + _material_groups(made, [m for m in members if is_material(m)], shape, source)


def _material_groups(
    made: Any, materials: Sequence[Any], shape: Any, source: Any
) -> list[NamedGroup]:
    """Return a group of tetrahedra per material, none at all when one cannot be told.

    A material without references gets what the others leave.
    """
    by_solid = {
        solid: meshes.group_ids(made, f"Solid{solid + 1}_Volumes")
        for solid in range(len(shape.Solids))
    }
    given: dict[str, list[int]] = {}
    for material in materials:
        solids = solids_of(material, shape, source)
        if solids is None:
            return []
        given[material.Name] = solids
    taken = {solid for solids in given.values() for solid in solids}
    if sum(not solids for solids in given.values()) > 1:
        return []
    out = []
    for name, solids in given.items():
        own = solids or [solid for solid in by_solid if solid not in taken]
        ids = [by_solid[solid] for solid in own]
        if ids:
            out.append(NamedGroup(f"{name}_Volumes", meshes.VOLUMES, np.concatenate(ids)))
    return out


def signature(analysis: Any) -> list[Any]:
    """Return what the groups of an analysis depend on, as plain types."""
    return [
        [member.Name, [[owner.Name, list(_names(names))] for owner, names in member.References]]
        for member in constraints_of(analysis)
    ]


def _names(names: Any) -> tuple[str, ...]:
    return (names,) if isinstance(names, str) else tuple(names)


def _index(owner: Any, name: str, kind: str, parts: Sequence[Any], source: Any) -> int | None:
    """Return the place of a named part of an object in the parts of the meshed shape."""
    if not name.startswith(kind):
        return None
    if owner is source and source is not None:
        place = int(name[len(kind) :]) - 1
        return place if 0 <= place < len(parts) else None
    wanted = owner.Shape.getElement(name)
    for place, part in enumerate(parts):
        if _same(wanted, part):
            return place
    return None


def _same(a: Any, b: Any) -> bool:
    """Whether two faces or solids are one place: same box, size and centre."""
    box, other = a.BoundBox, b.BoundBox
    near = _SAME * max(box.DiagonalLength, 1e-12)
    if abs(box.DiagonalLength - other.DiagonalLength) > near:
        return False
    if box.Center.distanceToPoint(other.Center) > near:
        return False
    size = (a.Area, b.Area)
    if abs(size[0] - size[1]) > _SAME * max(size):
        return False
    return bool(a.CenterOfMass.distanceToPoint(b.CenterOfMass) <= near)
