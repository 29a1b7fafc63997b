# SPDX-License-Identifier: LGPL-2.1-or-later
"""Wavefront OBJ: one object per convex cell, or the skin of tetrahedra grouped by B-rep face."""

from __future__ import annotations

from typing import BinaryIO

import numpy as np

from freecad_tetra.export.text import lines
from freecad_tetra.model import ConvexCells, Tet10Mesh, TetMesh


def write_cells(cells: ConvexCells, stream: BinaryIO) -> None:
    """Write ``o cell_K`` (K from 0) per cell; indices are global and begin with 1."""
    stream.write(lines("v %.17g %.17g %.17g", cells.points))
    names = [str(i) for i in (cells.facet_vertices + 1).tolist()]
    offsets = cells.facet_offsets.tolist()
    for k in range(len(cells)):
        facets = [
            "f " + " ".join(names[offsets[f] : offsets[f + 1]]) + "\n" for f in cells.cell_facets(k)
        ]
        stream.write(f"o cell_{k}\n{''.join(facets)}".encode())


def write_skin(mesh: TetMesh | Tet10Mesh, stream: BinaryIO) -> None:
    """Write the boundary as straight triangles, one group per B-rep face."""
    used, index = np.unique(mesh.skin[:, :3], return_inverse=True)
    triangles = index.reshape(-1, 3) + 1
    stream.write(lines("v %.17g %.17g %.17g", mesh.points[used]))
    if not mesh.face_names:
        stream.write(lines("f %d %d %d", triangles))
        return
    for face in np.unique(mesh.skin_face).tolist():
        stream.write(f"g {mesh.face_names[face]}\n".encode())
        stream.write(lines("f %d %d %d", triangles[mesh.skin_face == face]))
