# SPDX-License-Identifier: LGPL-2.1-or-later
"""Result files of this package are read back, so that they can be verified."""

from __future__ import annotations

import base64
import binascii
import contextlib
from dataclasses import dataclass
from os import PathLike
from pathlib import Path
from typing import Any
from xml.etree import ElementTree

import numpy as np

from freecad_tetra.errors import UnreadableFile, UnsupportedFormat
from freecad_tetra.io.polygons import BadFile
from freecad_tetra.io.text import numbers
from freecad_tetra.model import FloatArray, LongArray

_POLYHEDRON = 42
_TETS, _SKIN = (10, 24), (5, 22)
_KINDS = {"Float64": "<f8", "Float32": "<f4", "Int64": "<i8", "Int32": "<i4", "UInt8": "u1"}


@dataclass(frozen=True)
class StoredCells:
    """Convex cells of a file: points (p, 3), and for each cell its loops of point ids."""

    points: FloatArray
    cells: tuple[tuple[LongArray, ...], ...]


@dataclass(frozen=True)
class StoredTets:
    """Tetrahedra of a file.

    Attributes
    ----------
    points : (p, 3) float64
    tets : (t, 4) int64
    skin : (s, 3) int64
    skin_face : (s,) int64
        B-rep faces, -1 where the file tells none.
    middles : (t, 6) int64 or None
        Nodes amid the edges 01, 12, 20, 03, 13, 23, of second order.
    """

    points: FloatArray
    tets: LongArray
    skin: LongArray
    skin_face: LongArray
    middles: LongArray | None = None


def read_result(path: str | PathLike[str]) -> StoredCells | StoredTets:
    """Read cells (.obj, .vtu) or tetrahedra (.vtu) that this package wrote.

    Raises
    ------
    UnreadableFile, UnsupportedFormat
    """
    file = Path(path)
    suffix = file.suffix.lower()
    if suffix not in (".obj", ".vtu"):
        raise UnsupportedFormat(f"{file}: only .obj and .vtu results can be checked")
    try:
        data = file.read_bytes()
        found = _obj(data) if suffix == ".obj" else _vtu(data)
        _require_sane(found)
    except OSError as error:
        raise UnreadableFile(file, error.strerror or str(error)) from error
    except (BadFile, ValueError, IndexError, KeyError, ElementTree.ParseError) as error:
        raise UnreadableFile(file, f"it is malformed ({error})") from error
    return found


def read_tets(path: str | PathLike[str]) -> StoredTets:
    """Read the tetrahedra of any mesh file: .vtu of this package, others by meshio.

    Raises
    ------
    UnreadableFile, UnsupportedFormat, MissingDependency
    """
    file = Path(path)
    if file.suffix.lower() == ".vtu":
        with contextlib.suppress(UnreadableFile, UnsupportedFormat):
            found = read_result(file)
            if isinstance(found, StoredTets):
                return found
    from freecad_tetra.io import any_mesh

    points, tets = any_mesh.read_tets(file)
    middles = tets[:, 4:] if tets.shape[1] == 10 else None
    no_skin = np.zeros((0, 3), np.int64)
    stored = StoredTets(points, tets[:, :4], no_skin, np.zeros(0, np.int64), middles)
    try:
        _require_sane(stored)
    except BadFile as error:
        raise UnreadableFile(file, f"it is malformed ({error})") from error
    return stored


def _require_sane(found: StoredCells | StoredTets) -> None:
    if not np.isfinite(found.points).all():
        raise BadFile("a coordinate is not finite")
    if isinstance(found, StoredCells):
        loops = [x for c in found.cells for x in c]
    else:
        loops = [x for x in (found.tets, found.middles) if x is not None]
    if not loops:
        raise BadFile("it holds no cells")
    for loop in loops:
        if loop.size and (loop.min() < 0 or loop.max() >= len(found.points)):
            raise BadFile("a point id is out of range")


def _obj(data: bytes) -> StoredCells:
    points: list[bytes] = []
    cells: list[list[LongArray]] = []
    for line in data.split(b"\n"):
        words = line.split()
        if not words:
            continue
        if words[0] == b"v":
            points.append(b" ".join(words[1:4]))
        elif words[0] == b"o":
            cells.append([])
        elif words[0] == b"f":
            if not cells:
                raise BadFile("faces stand before the first object")
            cells[-1].append(np.array([int(w.split(b"/")[0]) - 1 for w in words[1:]], np.int64))
    return StoredCells(numbers(b"\n".join(points)).reshape(-1, 3), tuple(tuple(c) for c in cells))


def _vtu(data: bytes) -> StoredCells | StoredTets:
    root = ElementTree.fromstring(data)
    piece = root.find("UnstructuredGrid/Piece")
    if piece is None:
        raise BadFile("it holds no unstructured grid")
    arrays = {a.get("Name", ""): _array(a) for a in piece.iter("DataArray")}
    points = arrays["Points"].reshape(-1, 3).astype(np.float64)
    types = arrays["types"]
    if np.isin(types, (*_TETS, *_SKIN)).all():
        starts = np.append(0, arrays["offsets"])[:-1].astype(np.int64)
        solid = np.isin(types, _TETS)
        second = bool((types[solid] == _TETS[1]).all())
        tets, skin = (
            arrays["connectivity"][starts[rows][:, None] + np.arange(count)].astype(np.int64)
            for rows, count in ((solid, 10 if second else 4), (~solid, 3))
        )
        face = arrays.get("face", np.full(len(types), -1))[~solid].astype(np.int64)
        return StoredTets(points, tets[:, :4], skin, face, tets[:, 4:] if second else None)
    if not (types == _POLYHEDRON).all():
        raise BadFile("it holds cells that are neither tetrahedra nor polyhedra")
    return StoredCells(points, tuple(_polyhedra(arrays["faces"].astype(np.int64), len(types))))


def _array(node: Any) -> Any:
    text = (node.text or "").strip()
    kind = np.dtype(_KINDS[node.get("type")])
    if node.get("format") == "ascii":
        return numbers(text.encode()).astype(kind)
    if node.get("format") != "binary":
        raise BadFile("only ascii and uncompressed base64 arrays are read")
    try:
        raw = base64.b64decode(text, validate=True)
    except binascii.Error as error:
        raise BadFile("an array is not base64") from error
    if len(raw) < 8 or int.from_bytes(raw[:8], "little") != len(raw) - 8:
        raise BadFile("an array is truncated")
    return np.frombuffer(raw, kind, offset=8)


def _polyhedra(faces: LongArray, count: int) -> list[tuple[LongArray, ...]]:
    cells, at = [], 0
    for _ in range(count):
        loops, rest = [], int(faces[at])
        at += 1
        for _ in range(rest):
            size = int(faces[at])
            loops.append(faces[at + 1 : at + 1 + size])
            at += 1 + size
        cells.append(tuple(loops))
    if at != len(faces):
        raise BadFile("the faces do not fit the cells")
    return cells
