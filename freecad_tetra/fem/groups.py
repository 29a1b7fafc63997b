# SPDX-License-Identifier: LGPL-2.1-or-later
"""Groups of nodes, triangles and tetrahedra that loads, supports and materials are given to."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np

from freecad_tetra.model import LongArray, Tet10Mesh, TetMesh


@dataclass(frozen=True, eq=False)
class Group:
    """What of a mesh belongs to a B-rep face or a solid.

    Attributes
    ----------
    name : str
        ``Face3``, ``Solid1``; ``Skin`` for meshes without B-rep faces.
    nodes : (n,) int64
        All nodes, middles too, ascending.
    elements : (k,) int64
        Skin triangles of a face, tetrahedra of a solid.
    """

    name: str
    nodes: LongArray
    elements: LongArray


def face_groups(mesh: TetMesh | Tet10Mesh) -> tuple[Group, ...]:
    """Return a group per B-rep face that occurs on the skin, in the order of the faces."""
    if not mesh.face_names:
        every = np.arange(len(mesh.skin), dtype=np.int64)
        return (Group("Skin", np.unique(mesh.skin).astype(np.int64), every),)
    return tuple(_of_faces(mesh, [int(f)], mesh.face_names[f]) for f in np.unique(mesh.skin_face))


def faces_group(mesh: TetMesh | Tet10Mesh, names: Iterable[str], name: str) -> Group:
    """Return one group of several B-rep faces; names that the skin lacks add nothing."""
    known = {n: i for i, n in enumerate(mesh.face_names)}
    return _of_faces(mesh, [known[n] for n in names if n in known], name)


def solid_groups(mesh: TetMesh | Tet10Mesh) -> tuple[Group, ...]:
    """Return a group per solid."""
    out = []
    for solid in np.unique(mesh.tet_solid).tolist():
        rows = np.flatnonzero(mesh.tet_solid == solid)
        nodes = np.unique(mesh.tets[rows]).astype(np.int64)
        out.append(Group(f"Solid{solid + 1}", nodes, rows.astype(np.int64)))
    return tuple(out)


def _of_faces(mesh: TetMesh | Tet10Mesh, faces: list[int], name: str) -> Group:
    rows = np.flatnonzero(np.isin(mesh.skin_face, faces)).astype(np.int64)
    return Group(name, np.unique(mesh.skin[rows]).astype(np.int64), rows)
