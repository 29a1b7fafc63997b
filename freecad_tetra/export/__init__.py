# SPDX-License-Identifier: LGPL-2.1-or-later
"""Results become files: the suffix selects the writer, a file appears whole or not at all."""

from __future__ import annotations

import os
from collections.abc import Callable
from os import PathLike
from pathlib import Path
from typing import Any, BinaryIO

from freecad_tetra.errors import TetraError, UnsupportedFormat
from freecad_tetra.model import ConvexCells, Solid, Tet10Mesh, TetMesh

Writer = Callable[[Any, BinaryIO], None]

CELL_SUFFIXES = (".obj", ".vtu", ".glb", ".brep", ".step", ".stp")
TET_SUFFIXES = (".vtu", ".msh", ".msh2", ".inp", ".mesh", ".vtk", ".obj", ".brep")
SURFACE_SUFFIXES = (".off",)


def write(
    result: ConvexCells | TetMesh | Tet10Mesh | Solid, path: str | PathLike[str], order: int = 1
) -> Path:
    """Write a result; the file appears whole or not at all.

    Parameters
    ----------
    result : ConvexCells, TetMesh, Tet10Mesh or Solid
    path : path
        Cells: .obj .vtu .glb .brep .step; tetrahedra: .vtu .msh (4.1) .msh2 (2.2) .inp .mesh
        .vtk .obj (skin) .brep; a Solid: .off.
    order : {1, 2}
        Nodes per edge of a TetMesh, less one; 2 puts a node in the middle of each chord.

    Raises
    ------
    UnsupportedFormat
        The suffix does not fit the result.
    UnwritableFile
        The folder cannot be written to.
    """
    file = Path(path)
    writer = writer_for(type(result), file, order)
    with atomic(file) as stream:
        writer(result, stream)
    return file


def writer_for(kind: type, path: str | PathLike[str], order: int = 1) -> Writer:
    """Return the writer of a kind of result for a suffix, before any work is done.

    Raises
    ------
    UnsupportedFormat
    """
    suffix = Path(path).suffix.lower()
    wanted = {ConvexCells: CELL_SUFFIXES, TetMesh: TET_SUFFIXES, Solid: SURFACE_SUFFIXES,
              Tet10Mesh: TET_SUFFIXES}[kind]  # fmt: skip
    if suffix not in wanted:
        raise UnsupportedFormat(
            f"{path}: suffix {suffix or '(none)'} cannot be written for this result",
            f"use one of {' '.join(wanted)}",
        )
    if kind is ConvexCells:
        return _cell_writer(suffix)
    if kind in (TetMesh, Tet10Mesh):
        return _tet_writer(suffix, 2 if kind is Tet10Mesh else order)
    from freecad_tetra.export import off

    return off.write_surface


def _cell_writer(suffix: str) -> Writer:
    from freecad_tetra.export import brep, glb, obj, vtu

    return {
        ".obj": obj.write_cells,
        ".vtu": vtu.write_cells,
        ".glb": glb.write_cells,
        ".brep": brep.write_cells,
        ".step": brep.write_step,
        ".stp": brep.write_step,
    }[suffix]


def _tet_writer(suffix: str, order: int) -> Writer:
    from freecad_tetra.export import brep, elements, inp, medit, msh, obj, vtk, vtu

    if suffix == ".obj":
        return obj.write_skin
    if suffix == ".brep":
        return brep.write_tets
    if suffix == ".mesh" and order == 2:
        raise UnsupportedFormat("Medit .mesh is written in first order only", "use order 1")
    writer = {
        ".vtu": vtu.write_tets,
        ".msh": msh.write_tets,
        ".msh2": msh.write_tets_22,
        ".inp": inp.write_tets,
        ".mesh": medit.write_tets,
        ".vtk": vtk.write_tets,
    }[suffix]
    return lambda mesh, stream: writer(elements.elements(mesh, order), stream)


class atomic:
    """Open a file for writing that appears under its name only when all went well."""

    def __init__(self, path: str | PathLike[str]) -> None:
        self._path = Path(path)
        self._temporary = temporary_name(self._path, os.getpid())
        self._stream: BinaryIO | None = None

    def __enter__(self) -> BinaryIO:
        try:
            self._stream = open(self._temporary, "wb")
        except OSError as error:
            raise _unwritable(self._path, error) from error
        return self._stream

    def __exit__(self, kind: type[BaseException] | None, error: Any, trace: Any) -> None:
        assert self._stream is not None
        try:
            self._stream.close()
            if kind is None:
                os.replace(self._temporary, self._path)
        except OSError as failure:
            raise _unwritable(self._path, failure) from failure
        finally:
            self._temporary.unlink(missing_ok=True)
        if isinstance(error, OSError):
            raise _unwritable(self._path, error) from error


def temporary_name(path: Path, pid: int) -> Path:
    """Return the name under which `path` is being written by process `pid`."""
    return path.with_name(f".{path.name}.{pid}.part")


class UnwritableFile(TetraError):
    """The output cannot be written; nothing was left behind."""


def _unwritable(path: Path, error: OSError) -> UnwritableFile:
    return UnwritableFile(
        f"cannot write {path}: {error.strerror or error}",
        "choose a folder that exists and that you may write to",
    )
