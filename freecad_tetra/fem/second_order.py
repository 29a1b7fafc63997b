# SPDX-License-Identifier: LGPL-2.1-or-later
"""A mesh becomes one of second order, its boundary middles on the CAD faces where that is safe.

A middle that leaves the chord bends the elements around it. Where that takes the Jacobian of one
near zero, at an integration point or elsewhere, the middle that hurts most goes back to its chord.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from freecad_tetra.fem import jacobian, skin
from freecad_tetra.fem.project import Project, projected
from freecad_tetra.model import FloatArray, LongArray, Tet10Mesh, TetMesh

# Shares of its straight Jacobian that a curved element must keep. Two edges of an element that
# follow a smooth rim meet there in almost a straight angle: near corners little must be enough.
LEAST_INTEGRATED = 0.1  # at integration points
LEAST_SHARE = 1e-4  # everywhere else
_LONGEST_SHIFT = 0.5  # of the edge's length; a projection that goes farther found another place


@dataclass(frozen=True)
class Curving:
    """What became of the boundary middles.

    Attributes
    ----------
    curved : int
        Lie on the CAD, off their chord.
    straightened : int
        Were put back to the chord, for an element's sake.
    unprojected : int
        Have no near point on the CAD.
    faces : tuple of int
        B-rep faces with middles that were put back.
    unbearing : tuple of int
        Tetrahedra that could not bear all their middles on the CAD, worst first.
    """

    curved: int = 0
    straightened: int = 0
    unprojected: int = 0
    faces: tuple[int, ...] = ()
    unbearing: tuple[int, ...] = ()


def second_order(mesh: TetMesh, project: Project | None = None) -> tuple[Tet10Mesh, Curving]:
    """Put a node into the middle of every edge, on the CAD where `project` is given.

    Every element keeps `LEAST_INTEGRATED` of its straight Jacobian at the integration points and
    `LEAST_SHARE` at corners, middles and the points of the cubic lattice. O(t log t), and O(k) for
    each of the k middles that have to go back.
    """
    ends, of_tets = tet_edges(mesh.tets)
    straight = (mesh.points[ends[:, 0]] + mesh.points[ends[:, 1]]) / 2
    skin_edges = skin.skin_edges(mesh.skin)
    place = edge_ids(ends, skin_edges.ends, len(mesh.points))
    base = len(mesh.points)
    tets = np.hstack([mesh.tets.astype(np.int64), of_tets + base])
    triangles = np.hstack([mesh.skin.astype(np.int64), place[skin_edges.of_triangle] + base])
    middles, curving = straight, Curving()
    if project is not None:
        groups = skin.faces_of_edges(skin_edges, mesh.skin_face)
        wanted = {faces: place[rows] for faces, rows in groups.items()}
        middles, curving = _curve(mesh, tets, ends, straight, wanted, project)
    source = np.concatenate([mesh.point_source, np.full(len(middles), -1)])
    made = Tet10Mesh(
        np.concatenate([mesh.points, middles]), tets.astype(np.int32), triangles.astype(np.int32),
        mesh.skin_face, mesh.skin_source, mesh.tet_solid, source, mesh.face_names, mesh.report,
        mesh.labels,
    )  # fmt: skip
    return made, curving


def tet_edges(tets: Any) -> tuple[LongArray, LongArray]:
    """Return the edges of tetrahedra (e, 2), ascending, and the six of each (t, 6), O(t log t)."""
    pairs = np.sort(np.asarray(tets, np.int64)[:, np.array(jacobian.TET_EDGES)], axis=2)
    size = int(pairs.max()) + 1 if pairs.size else 1
    codes, index = np.unique(pairs[:, :, 0] * size + pairs[:, :, 1], return_inverse=True)
    return np.stack([codes // size, codes % size], axis=1), index.reshape(-1, 6)


def edge_ids(ends: LongArray, wanted: Any, points: int) -> LongArray:
    """Return the rows of the edges `wanted` (k, 2) in `ends`; both ascending, all present."""
    size = max(points, 1)
    rows = np.asarray(wanted, np.int64)
    codes = ends[:, 0] * size + ends[:, 1]
    return np.searchsorted(codes, rows[:, 0] * size + rows[:, 1]).astype(np.int64)


def _curve(
    mesh: TetMesh, tets: LongArray, ends: LongArray, straight: FloatArray,
    wanted: dict[skin.Faces, LongArray], project: Project,
) -> tuple[FloatArray, Curving]:  # fmt: skip
    """Return the middles on the CAD where all elements bear it, and what became of them."""
    target = projected(wanted, straight, project)
    shift = np.linalg.norm(target - straight, axis=1)
    length = np.linalg.norm(mesh.points[ends[:, 1]] - mesh.points[ends[:, 0]], axis=1)
    far = shift > _LONGEST_SHIFT * length
    target[far] = straight[far]
    off = (target != straight).any(axis=1)
    middles, back, unbearing = _bearable(mesh.points, tets, straight, target)
    faces = [f for f, rows in wanted.items() if back[rows].any()]
    curving = Curving(
        curved=int(np.count_nonzero(off & ~back)),
        straightened=int(np.count_nonzero(back)),
        unprojected=int(np.count_nonzero(far)),
        faces=tuple(sorted({i for f in faces for i in f})),
        unbearing=tuple(unbearing.tolist()),
    )
    return middles, curving


def _bearable(
    points: FloatArray, tets: LongArray, straight: FloatArray, target: FloatArray
) -> tuple[FloatArray, Any, LongArray]:
    """Put middles back to the chord until every element keeps its share of the Jacobian.

    With the middles and which of them went back: the elements at fault in the beginning.
    """
    base = len(points)
    nodes = np.concatenate([points, target])
    back = np.zeros(len(straight), bool)
    need = LEAST_SHARE * jacobian.straight_determinants(points[tets[:, :4]])
    bent = (target != straight).any(axis=1)
    check = np.flatnonzero(bent[tets[:, 4:] - base].any(axis=1))
    share = _margin(nodes[tets[check]]) - need[check]
    unbearing = check[np.argsort(share, kind="stable")[: np.count_nonzero(share < 0)]]
    while len(check):
        poor = check[_margin(nodes[tets[check]]) < need[check]]
        if not len(poor):
            break
        culprits = np.unique(_culprits(nodes, tets[poor], base, straight))
        back[culprits] = True
        nodes[base + culprits] = straight[culprits]
        check = np.flatnonzero(np.isin(tets[:, 4:] - base, culprits).any(axis=1))
        check = np.union1d(check, poor)
    return nodes[base:], back, unbearing


def _margin(corners: FloatArray) -> FloatArray:
    """Return the least det J, (t,); at integration points as if it were as dear as elsewhere."""
    values = jacobian.determinants(corners)
    values[:, jacobian.GAUSS_COLUMNS] *= LEAST_SHARE / LEAST_INTEGRATED
    return values.min(axis=1)


def _culprits(nodes: FloatArray, poor: LongArray, base: int, straight: FloatArray) -> LongArray:
    """Return for each poor element the middle whose return to the chord helps it most."""
    least = np.full((len(poor), 6), -np.inf)
    corners = nodes[poor]
    for k in range(6):
        edge = poor[:, 4 + k] - base
        rows = np.flatnonzero((corners[:, 4 + k] != straight[edge]).any(axis=1))
        trial = corners[rows]
        trial[:, 4 + k] = straight[edge[rows]]
        least[rows, k] = _margin(trial)
    return poor[np.arange(len(poor)), 4 + least.argmax(axis=1)] - base


def straightened(mesh: Tet10Mesh) -> TetMesh:
    """Return the corners alone as a mesh of first order."""
    corners = int(mesh.tets[:, :4].max()) + 1 if len(mesh) else 0
    return TetMesh(
        mesh.points[:corners], mesh.tets[:, :4], mesh.skin[:, :3], mesh.skin_face,
        mesh.skin_source, mesh.tet_solid, mesh.point_source[:corners], mesh.face_names, mesh.report,
    )  # fmt: skip


def with_report(mesh: TetMesh | Tet10Mesh, **changes: Any) -> Any:
    """Return the mesh with fields of its report replaced."""
    return replace(mesh, report=replace(mesh.report, **changes))
