# SPDX-License-Identifier: LGPL-2.1-or-later
"""What every tetrahedron format needs: nodes, elements of first or second order, groups."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any

import numpy as np
import numpy.typing as npt

from freecad_tetra.labels import distinct
from freecad_tetra.model import FloatArray, Tet10Mesh, TetMesh

LongArray = npt.NDArray[np.int64]

_TET_EDGES = np.array([[0, 1], [1, 2], [2, 0], [0, 3], [1, 3], [2, 3]])
_TRIANGLE_EDGES = np.array([[0, 1], [1, 2], [2, 0]])


@dataclass(frozen=True)
class Elements:
    """A mesh ready for writing.

    Attributes
    ----------
    points : (n, 3) float64
    tets : (t, 4) or (t, 10) int64
        Second order: corners, then the middles of 01, 12, 20, 03, 13, 23.
    skin : (s, 3) or (s, 6) int64
        Second order: corners, then the middles of 01, 12, 20.
    solid : (t,) int64
    face : (s,) int64
    source : (n,) int64
        Input vertex of each node, -1 for Steiner points and middles.
    face_names, solid_names : dict of int to str
        Names of the groups that occur, without blanks.
    face_groups : dict of str to list of int
        Further groups of faces, which may overlap.
    """

    points: FloatArray
    tets: LongArray
    skin: LongArray
    solid: LongArray
    face: LongArray
    source: LongArray
    face_names: dict[int, str]
    solid_names: dict[int, str]
    face_groups: dict[str, list[int]] = field(default_factory=dict)

    @property
    def order(self) -> int:
        """1 for straight four-node tetrahedra, 2 for ten-node ones."""
        return 1 if self.tets.shape[1] == 4 else 2


def elements(mesh: TetMesh | Tet10Mesh, order: int = 1) -> Elements:
    """Return the mesh with its groups; `order` 2 gives a TetMesh a node amid every chord."""
    points, source = mesh.points, mesh.point_source.astype(np.int64)
    tets, skin = mesh.tets.astype(np.int64), mesh.skin.astype(np.int64)
    if order == 2 and isinstance(mesh, TetMesh):
        points, tets, skin = _second_order(points, tets, skin)
        source = np.concatenate([source, np.full(len(points) - len(source), -1)])
    # Without B-rep faces every input polygon would be a group: one skin serves better.
    face = mesh.skin_face.astype(np.int64) if mesh.face_names else np.zeros(len(skin), np.int64)
    names = {int(i): mesh.face_names[i] if mesh.face_names else "Skin" for i in np.unique(face)}
    solid = mesh.tet_solid.astype(np.int64)
    solids = {int(i): mesh.labels.solid(int(i)) for i in np.unique(solid)}
    groups = _face_groups(mesh, names, solids)
    return Elements(points, tets, skin, solid, face, source, names, solids, groups)


def _face_groups(
    mesh: TetMesh | Tet10Mesh, faces: dict[int, str], solids: dict[int, str]
) -> dict[str, list[int]]:
    """Return the caller's groups of faces that occur, under names that nothing else has."""
    taken = [*faces.values(), *solids.values()]
    names = distinct([*taken, *mesh.labels.faces])[len(taken) :]
    groups = [[i for i in ids if i in faces] for ids in mesh.labels.faces.values()]
    return {name: ids for name, ids in zip(names, groups) if ids and mesh.face_names}


def _second_order(points: FloatArray, tets: LongArray, skin: LongArray) -> tuple[Any, Any, Any]:
    ends = np.sort(tets[:, _TET_EDGES], axis=2)
    codes = ends[:, :, 0] * len(points) + ends[:, :, 1]
    edges, index = np.unique(codes, return_inverse=True)
    middles = (points[edges // len(points)] + points[edges % len(points)]) / 2
    of_tets = index.reshape(codes.shape) + len(points)
    ends = np.sort(skin[:, _TRIANGLE_EDGES], axis=2)
    of_skin = np.searchsorted(edges, ends[:, :, 0] * len(points) + ends[:, :, 1]) + len(points)
    return np.concatenate([points, middles]), np.hstack([tets, of_tets]), np.hstack([skin, of_skin])


def sides_of_skin(grid: Elements, sides: Any) -> tuple[LongArray, LongArray]:
    """Return for each skin triangle its tetrahedron (s,) and local side (s,), O(t log t).

    Parameters
    ----------
    sides : (4, 3) int
        Local corners of the sides, in the numbering of the format.
    """
    faces = np.sort(grid.tets[:, np.asarray(sides)], axis=2).reshape(-1, 3)
    wanted = np.sort(grid.skin[:, :3], axis=1)
    both = np.concatenate([faces, wanted])
    _, index = np.unique(both, axis=0, return_inverse=True)
    index = index.reshape(-1)
    place = np.full(int(index.max()) + 1, -1, np.int64)
    place[index[: len(faces)]] = np.arange(len(faces))
    found = place[index[len(faces) :]]
    return found // 4, found % 4
