# SPDX-License-Identifier: LGPL-2.1-or-later
"""Legacy VTK in ascii: tetrahedra only, as Drake and OpenMC want them."""

from __future__ import annotations

from typing import BinaryIO

import numpy as np

from freecad_tetra.export.elements import Elements
from freecad_tetra.export.text import lines

_KIND = {1: 10, 2: 24}


def write_tets(grid: Elements, stream: BinaryIO) -> None:
    """Write an unstructured grid with the cell field ``solid``."""
    count, width = grid.tets.shape
    stream.write(b"# vtk DataFile Version 3.0\nfreecad_tetra\nASCII\nDATASET UNSTRUCTURED_GRID\n")
    stream.write(f"POINTS {len(grid.points)} double\n".encode())
    stream.write(lines("%.17g %.17g %.17g", grid.points))
    stream.write(f"\nCELLS {count} {count * (width + 1)}\n".encode())
    table = np.column_stack([np.full(count, width), grid.tets])
    stream.write(lines(" ".join(["%d"] * (width + 1)), table))
    stream.write(f"\nCELL_TYPES {count}\n".encode())
    stream.write(lines("%d", np.full(count, _KIND[grid.order])))
    stream.write(f"\nCELL_DATA {count}\nSCALARS solid int 1\nLOOKUP_TABLE default\n".encode())
    stream.write(lines("%d", grid.solid))
