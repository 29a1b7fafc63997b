# SPDX-License-Identifier: LGPL-2.1-or-later
"""Abaqus and CalculiX input: elements, a node set and a surface per B-rep face and named group."""

from __future__ import annotations

from typing import Any, BinaryIO

import numpy as np

from freecad_tetra.export.elements import Elements, sides_of_skin
from freecad_tetra.export.text import lines

_SIDES = [[0, 1, 2], [0, 3, 1], [1, 3, 2], [2, 3, 0]]  # S1 to S4
_KIND = {1: "C3D4", 2: "C3D10"}


def write_tets(grid: Elements, stream: BinaryIO) -> None:
    """Write *NODE, *ELEMENT, *ELSET per solid, *NSET and *SURFACE per face; ids from 1.

    A number may have 20 characters, which 13 digits with sign and exponent fill.
    """
    stream.write(b"*HEADING\nfreecad_tetra\n*NODE, NSET=Nall\n")
    for start in range(0, len(grid.points), 4096):
        block = grid.points[start : start + 4096].tolist()
        rows = [
            f"{start + i + 1}, {x:.13g}, {y:.13g}, {z:.13g}\n" for i, (x, y, z) in enumerate(block)
        ]
        stream.write("".join(rows).encode())
    for i, name in grid.solid_names.items():
        ids = np.flatnonzero(grid.solid == i)
        stream.write(f"*ELEMENT, TYPE={_KIND[grid.order]}, ELSET={name}\n".encode())
        table = np.column_stack([ids + 1, grid.tets[ids] + 1])
        stream.write(lines(", ".join(["%d"] * table.shape[1]), table))
    _element_sets(grid, stream)
    element, side = sides_of_skin(grid, _SIDES)
    groups = {name: [i] for i, name in grid.face_names.items()} | grid.face_groups
    for name, faces in groups.items():
        rows_of_face = np.flatnonzero(np.isin(grid.face, faces))
        stream.write(f"*NSET, NSET={name}\n".encode())
        _ids(stream, np.unique(grid.skin[rows_of_face]) + 1)
        stream.write(f"*SURFACE, NAME={name}_surface, TYPE=ELEMENT\n".encode())
        table = np.column_stack([element[rows_of_face] + 1, side[rows_of_face] + 1])
        stream.write(lines("%d, S%d", table))


def _element_sets(grid: Elements, stream: BinaryIO) -> None:
    """Gather all solids in one set, which loads and materials are often given to."""
    names = ",\n".join(grid.solid_names.values())
    stream.write(f"*ELSET, ELSET=Eall\n{names}\n".encode())


def _ids(stream: BinaryIO, ids: Any) -> None:
    """Write ids, 16 a line as the format allows at most."""
    words = [str(i) for i in ids.tolist()]
    rows = [", ".join(words[i : i + 16]) for i in range(0, len(words), 16)]
    stream.write((",\n".join(rows) + "\n").encode())
