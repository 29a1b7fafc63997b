# SPDX-License-Identifier: LGPL-2.1-or-later
"""Medit .mesh, the format of mmg: references are B-rep faces and solids, counted from 1."""

from __future__ import annotations

from typing import BinaryIO

import numpy as np

from freecad_tetra.export.elements import Elements
from freecad_tetra.export.text import lines


def write_tets(grid: Elements, stream: BinaryIO) -> None:
    """Write first-order vertices, triangles (reference: face) and tetrahedra (reference: solid)."""
    stream.write(
        f"MeshVersionFormatted 2\n\nDimension 3\n\nVertices\n{len(grid.points)}\n".encode()
    )
    stream.write(lines("%.17g %.17g %.17g 0", grid.points))
    stream.write(f"\nTriangles\n{len(grid.skin)}\n".encode())
    stream.write(lines("%d %d %d %d", np.column_stack([grid.skin + 1, grid.face + 1])))
    stream.write(f"\nTetrahedra\n{len(grid.tets)}\n".encode())
    stream.write(lines("%d %d %d %d %d", np.column_stack([grid.tets + 1, grid.solid + 1])))
    stream.write(b"\nEnd\n")
