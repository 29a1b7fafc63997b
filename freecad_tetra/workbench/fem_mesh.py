# SPDX-License-Identifier: LGPL-2.1-or-later
"""Arrays become a Fem.FemMesh with groups, and the groups are found again in one from a file.

Nodes and elements count from 1, triangles follow the tetrahedra. Groups of the B-rep are
``Face3_Nodes``, ``Face3_Faces`` and ``Solid1_Volumes``; they carry the B-rep through documents and
files, so those of constraints can be made anew without meshing.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from typing import Any

import numpy as np

from freecad_tetra.fem.groups import face_groups, solid_groups
from freecad_tetra.model import LongArray, Tet10Mesh, TetMesh

NODES, FACES, VOLUMES = "Node", "Face", "Volume"  # FreeCAD's kinds of groups
# FreeCAD wants tetrahedra of negative orientation: the second and third corner change places.
_TURNED = {4: [0, 2, 1, 3], 10: [0, 2, 1, 3, 6, 5, 4, 7, 9, 8]}


@dataclass(frozen=True)
class NamedGroup:
    """A group to be made: its name, FreeCAD's kind of element, and ids from 1."""

    name: str
    kind: str
    ids: LongArray


def fem_mesh(mesh: TetMesh | Tet10Mesh) -> Any:
    """Return a Fem.FemMesh with tetrahedra, triangles on the skin, and groups of the B-rep."""
    import Fem

    made = Fem.FemMesh()
    for number, (x, y, z) in enumerate(mesh.points.tolist(), 1):
        made.addNode(x, y, z, number)
    turned = mesh.tets[:, _TURNED[mesh.tets.shape[1]]] + 1
    for number, nodes in enumerate(turned.tolist(), 1):
        made.addVolume(nodes, number)
    for number, nodes in enumerate((mesh.skin + 1).tolist(), len(mesh) + 1):
        made.addFace(nodes, number)
    add_groups(made, brep_groups(mesh))
    return made


def brep_groups(mesh: TetMesh | Tet10Mesh) -> list[NamedGroup]:
    """Return the groups of B-rep faces and solids."""
    out = []
    for group in face_groups(mesh):
        out.append(NamedGroup(f"{group.name}_Nodes", NODES, group.nodes + 1))
        out.append(NamedGroup(f"{group.name}_Faces", FACES, group.elements + 1 + len(mesh)))
    for group in solid_groups(mesh):
        out.append(NamedGroup(f"{group.name}_Volumes", VOLUMES, group.elements + 1))
    return out


def add_groups(made: Any, groups: Iterable[NamedGroup]) -> None:
    """Add groups to a Fem.FemMesh; empty ones are left out."""
    for group in groups:
        if len(group.ids):
            number = made.addGroup(group.name, group.kind)
            made.addGroupElements(number, group.ids.tolist())


def remove_groups(made: Any, names: Iterable[str]) -> None:
    """Remove the groups whose names begin with one of `names` and an underscore."""
    heads = tuple(f"{name}_" for name in names)
    if heads:
        for number in list(made.Groups):
            if made.getGroupName(number).startswith(heads):
                made.removeGroup(number)


def group_ids(made: Any, name: str) -> LongArray:
    """Return the ids in the group of that name, (k,) int64 ascending; none without a group."""
    for number in made.Groups:
        if made.getGroupName(number) == name:
            return np.array(sorted(made.getGroupElements(number)), np.int64)
    return np.zeros(0, np.int64)


def group_names(made: Any) -> list[str]:
    """Return the names of all groups."""
    return [made.getGroupName(number) for number in made.Groups]


def nodes_table(made: Any) -> Any:
    """Return coordinates by node number, (n + 1, 3) float64; NaN where there is none."""
    nodes = made.Nodes
    table = np.full((max(nodes, default=0) + 1, 3), np.nan)
    for number, point in nodes.items():
        table[number] = tuple(point)
    return table
