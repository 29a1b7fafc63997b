# SPDX-License-Identifier: LGPL-2.1-or-later
"""The only door to meshio: the tetrahedra of mesh files that others wrote."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np

from freecad_tetra.errors import MissingDependency, UnreadableFile, UnsupportedFormat
from freecad_tetra.model import FloatArray, LongArray

SUFFIXES = (".vtu", ".vtk", ".msh", ".inp", ".mesh", ".med", ".bdf", ".unv", ".xdmf")


def read_tets(file: Path) -> tuple[FloatArray, LongArray]:
    """Return points (p, 3) and tetrahedra (t, 4) or (t, 10), middles in the order of VTK.

    Raises
    ------
    UnreadableFile, UnsupportedFormat, MissingDependency
    """
    if file.suffix.lower() not in SUFFIXES:
        raise UnsupportedFormat(
            f"{file}: suffix {file.suffix or '(none)'} is no mesh", f"use {' '.join(SUFFIXES)}"
        )
    if not file.is_file():
        raise UnreadableFile(file, "there is no such file")
    try:
        import meshio
    except ImportError as error:
        raise MissingDependency("meshio", f"reading {file.suffix} files") from error
    try:
        mesh: Any = meshio.read(file)
    except (Exception, SystemExit) as error:  # meshio's readers raise anything, and may exit
        raise UnreadableFile(file, f"meshio cannot read it ({error})") from error
    kinds = {kind: [b.data for b in mesh.cells if b.type == kind] for kind in ("tetra10", "tetra")}
    kinds = {kind: blocks for kind, blocks in kinds.items() if blocks}
    if not kinds:
        raise UnreadableFile(file, "it holds no tetrahedra")
    if len(kinds) > 1:
        raise UnreadableFile(file, "it mixes tetrahedra of first and second order")
    (blocks,) = kinds.values()
    points = np.asarray(mesh.points, float)
    return points, np.concatenate(blocks).astype(np.int64)
