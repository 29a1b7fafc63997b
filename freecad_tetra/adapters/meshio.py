# SPDX-License-Identifier: LGPL-2.1-or-later
"""meshio: tetrahedra and skin triangles with cell sets, or convex cells as polyhedra."""

from __future__ import annotations

from typing import Any

import numpy as np

from freecad_tetra.adapters import require
from freecad_tetra.model import ConvexCells, TetMesh


def mesh(result: ConvexCells | TetMesh) -> Any:
    """Return a ``meshio.Mesh``.

    Tetrahedra: blocks ``tetra`` and ``triangle`` with the cell data ``solid`` and ``face`` (-1
    where it does not apply), and a cell set per solid, per B-rep face and per named group.
    Convex cells: polyhedra, which meshio writes as .vtu, with the cell data ``solid``.
    """
    meshio = require("meshio", "handing a mesh to meshio")
    return _cells(meshio, result) if isinstance(result, ConvexCells) else _tets(meshio, result)


def _tets(meshio: Any, result: TetMesh) -> Any:
    tets, skin = len(result.tets), len(result.skin)
    none = np.zeros(0, np.int64)
    sets: dict[str, list[Any]] = {}
    for number in np.unique(result.tet_solid).tolist():
        rows = np.flatnonzero(result.tet_solid == number)
        sets[result.labels.solid(number)] = [rows, none]
    for face in np.unique(result.skin_face).tolist() if result.face_names else ():
        sets[result.face_names[face]] = [none, np.flatnonzero(result.skin_face == face)]
    for name, faces in result.labels.faces.items():
        sets[name] = [none, np.flatnonzero(np.isin(result.skin_face, faces))]
    return meshio.Mesh(
        result.points.copy(),
        [("tetra", result.tets.astype(np.int64)), ("triangle", result.skin.astype(np.int64))],
        point_data={"source": result.point_source.astype(np.int64)},
        cell_data={
            "solid": [result.tet_solid.astype(np.int64), np.full(skin, -1)],
            "face": [np.full(tets, -1), result.skin_face.astype(np.int64)],
        },
        cell_sets=sets,
    )


def _cells(meshio: Any, result: ConvexCells) -> Any:
    """Group the polyhedra by their number of points, as meshio wants them, order kept within."""
    blocks: dict[str, list[Any]] = {}
    numbers: dict[str, list[int]] = {}
    for k in range(len(result)):
        loops = [result.facet(f).astype(np.int64) for f in result.cell_facets(k)]
        kind = f"polyhedron{len(np.unique(np.concatenate(loops)))}"
        blocks.setdefault(kind, []).append(loops)
        numbers.setdefault(kind, []).append(k)
    solid = [result.cell_solid[np.array(ids)].astype(np.int64) for ids in numbers.values()]
    cell = [np.array(ids, np.int64) for ids in numbers.values()]
    return meshio.Mesh(
        result.points.copy(), list(blocks.items()), cell_data={"solid": solid, "cell": cell}
    )
