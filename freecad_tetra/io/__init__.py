# SPDX-License-Identifier: LGPL-2.1-or-later
"""Mesh files become Solids: one module per format, one function for all."""

from __future__ import annotations

from collections.abc import Callable
from os import PathLike
from pathlib import Path
from typing import Any

import numpy as np

from freecad_tetra.errors import Defect, InvalidSolid, TetraError, UnreadableFile, UnsupportedFormat
from freecad_tetra.io import obj, off, ply, polygons, stl, weld
from freecad_tetra.model import IntArray, Solid

SUFFIXES = (".stl", ".obj", ".off", ".ply")

_READERS: dict[str, Callable[[bytes], polygons.Mesh]] = {
    ".stl": stl.parse,
    ".obj": obj.parse,
    ".off": off.parse,
    ".ply": ply.parse,
}


def read_mesh(
    path: str | PathLike[str],
    split: Callable[[Any, Any], IntArray] | None = None,
) -> Solid:
    """Read a mesh file by its suffix.

    Vertices with equal coordinates become one; polygons become triangles. The vertices of
    indexed formats keep their numbers.

    Parameters
    ----------
    path : path
        .stl (ascii or binary), .obj, .off or .ply (ascii or binary).
    split : callable, optional
        ``split(points (n, 2), loop (k,)) -> (t, 3)`` triangulates a non-convex polygon.

    Returns
    -------
    Solid
        ``face_ids`` number the polygons of the file.

    Raises
    ------
    UnreadableFile
        The file is missing, empty, truncated or garbage.
    UnsupportedFormat
        The suffix, or a variant of the format, is not handled.
    InvalidSolid
        ``nonfinite_coordinate``, ``empty`` or ``bad_polygon``.
    """
    file = Path(path)
    reader = _READERS.get(file.suffix.lower())
    if reader is None:
        raise UnsupportedFormat(
            f"{file}: suffix {file.suffix or '(none)'} is no mesh format",
            f"use one of {' '.join(SUFFIXES)}",
        )
    mesh = _parse(file, reader)
    _require_finite(mesh)
    if not mesh.count:
        raise InvalidSolid([Defect("empty", f"{file} holds no polygon")])
    welded = polygons.welded(mesh, weld.classes(mesh.points))
    triangles, polygon = polygons.triangulate(welded, split)
    # What welding collapsed has no area and no neighbours to lose.
    keep = (triangles != np.roll(triangles, 1, axis=1)).all(axis=1)
    return Solid(
        mesh.points, triangles[keep], polygon[keep], (), file.stem,
        notes={"file": file.name, "collapsed_triangles": int((~keep).sum())},
    )  # fmt: skip


def _parse(file: Path, reader: Callable[[bytes], polygons.Mesh]) -> polygons.Mesh:
    try:
        data = file.read_bytes()
    except OSError as error:
        raise UnreadableFile(file, error.strerror or str(error)) from error
    if not data.strip():
        raise UnreadableFile(file, "the file is empty")
    try:
        return reader(data)
    except polygons.BadFile as error:
        raise UnreadableFile(file, str(error)) from error
    except TetraError:
        raise
    except (ValueError, IndexError, KeyError, OverflowError, TypeError) as error:
        raise UnreadableFile(file, f"it is malformed ({error})") from error


def _require_finite(mesh: polygons.Mesh) -> None:
    bad = np.flatnonzero(~np.isfinite(mesh.points).all(axis=1))
    if len(bad):
        ids = tuple(int(i) for i in bad[:100])
        text = f"{len(bad)} vertices have a coordinate that is not a number or infinite"
        raise InvalidSolid([Defect("nonfinite_coordinate", text, vertices=ids)])
