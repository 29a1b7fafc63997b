# SPDX-License-Identifier: LGPL-2.1-or-later
"""One file per convex cell, because physics engines take the hull of a whole file."""

from __future__ import annotations

from collections.abc import Callable
from os import PathLike
from pathlib import Path

import numpy as np

from freecad_tetra import export
from freecad_tetra.errors import UnsupportedFormat
from freecad_tetra.export.text import lines
from freecad_tetra.model import Cell, ConvexCells

# Engines compute in single precision and refuse hulls that are flat there.
THINNEST = 1e-6


def write_parts(
    cells: ConvexCells, folder: str | PathLike[str], suffix: str = ".obj", scale: float = 1.0
) -> list[Path]:
    """Write ``cell_0.obj``, ``cell_1.obj`` ... into a folder that is made when it is missing.

    Parameters
    ----------
    cells : ConvexCells
    folder : path
    suffix : {".obj", ".stl"}
        OBJ keeps facets and 17 digits, STL (binary) has triangles in single precision.
    scale : float
        Lengths in the files per length of the model.

    Returns
    -------
    list of Path
        In the order of the cells; `thick` tells which cells they are.

    Raises
    ------
    UnsupportedFormat, UnwritableFile
    """
    writers: dict[str, Callable[[Cell, float], bytes]] = {".obj": _obj, ".stl": _stl}
    if suffix not in writers:
        raise UnsupportedFormat(f"cells are not written as {suffix}", "use .obj or .stl")
    target = Path(folder)
    try:
        target.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise export.UnwritableFile(
            f"cannot make the folder {target}: {error.strerror}", "choose another name"
        ) from error
    files = []
    for k in thick(cells):
        files.append(target / f"cell_{k}{suffix}")
        with export.atomic(files[-1]) as stream:
            stream.write(writers[suffix](cells.cell(k), scale))
    return files


def thick(cells: ConvexCells) -> list[int]:
    """Return the cells that are no thinner than `THINNEST` of the part's diagonal.

    Thinner ones come from rounding; leaving them out opens gaps no wider than that.
    """
    if not len(cells):
        return []
    size = float(np.linalg.norm(np.ptp(cells.points, axis=0)))
    triangles, facet = cells.fans()
    corners = cells.points[triangles]
    vectors = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    areas = np.zeros((len(cells.facet_offsets) - 1, 3))
    np.add.at(areas, facet, vectors / 2)
    widest = np.maximum.reduceat(np.linalg.norm(areas, axis=1), cells.cell_offsets[:-1])
    # A convex body has a third at least of its widest facet times its height.
    keep = 3 * cells.volumes() > THINNEST * size * widest
    return np.flatnonzero(keep).tolist()


def _obj(cell: Cell, scale: float) -> bytes:
    rows = ["f " + " ".join(str(i + 1) for i in facet) + "\n" for facet in cell.facets]
    return lines("v %.17g %.17g %.17g", cell.points * scale) + "".join(rows).encode()


def _stl(cell: Cell, scale: float) -> bytes:
    corners = cell.points[cell.triangles()] * scale
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    lengths = np.linalg.norm(normals, axis=1, keepdims=True)
    rows = np.zeros(len(corners), [("vectors", "<f4", (4, 3)), ("attribute", "<u2")])
    rows["vectors"][:, 0] = normals / np.where(lengths > 0, lengths, 1.0)
    rows["vectors"][:, 1:] = corners
    return b"freecad_tetra".ljust(80) + len(rows).to_bytes(4, "little") + rows.tobytes()
