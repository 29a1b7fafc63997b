# SPDX-License-Identifier: LGPL-2.1-or-later
"""Results become files: the suffix selects the writer, a file appears whole or not at all."""

from __future__ import annotations

import os
from collections.abc import Callable
from os import PathLike
from pathlib import Path
from typing import Any, BinaryIO

from freecad_tetra.errors import TetraError, UnsupportedFormat
from freecad_tetra.model import ConvexCells, Solid, TetMesh

Writer = Callable[[Any, BinaryIO], None]

CELL_SUFFIXES = (".obj", ".vtu", ".glb", ".brep", ".step", ".stp")
TET_SUFFIXES = (".vtu", ".msh", ".inp", ".mesh", ".vtk", ".obj")
SURFACE_SUFFIXES = (".off",)


def write(result: ConvexCells | TetMesh | Solid, path: str | PathLike[str]) -> Path:
    """Write a result; the file appears whole or not at all.

    Parameters
    ----------
    result : ConvexCells, TetMesh or Solid
    path : path
        Cells: .obj .vtu .glb .brep .step; tetrahedra: .vtu .msh .inp .mesh .vtk .obj (skin);
        a Solid: .off.

    Raises
    ------
    UnsupportedFormat
        The suffix does not fit the result.
    TetraError
        The folder cannot be written to.
    """
    file = Path(path)
    writer = writer_for(type(result), file)
    with atomic(file) as stream:
        writer(result, stream)
    return file


def writer_for(kind: type, path: str | PathLike[str]) -> Writer:
    """Return the writer of a kind of result for a suffix, before any work is done.

    Raises
    ------
    UnsupportedFormat
    """
    suffix = Path(path).suffix.lower()
    if kind is ConvexCells and suffix in CELL_SUFFIXES:
        return _cell_writer(suffix)
    if kind is TetMesh and suffix in TET_SUFFIXES:
        return _tet_writer(suffix)
    if kind is Solid and suffix in SURFACE_SUFFIXES:
        from freecad_tetra.export import off

        return off.write_surface
    wanted = {ConvexCells: CELL_SUFFIXES, TetMesh: TET_SUFFIXES, Solid: SURFACE_SUFFIXES}
    raise UnsupportedFormat(
        f"{path}: suffix {suffix or '(none)'} cannot be written for this result",
        f"use one of {' '.join(wanted.get(kind, ()))}",
    )


def _cell_writer(suffix: str) -> Writer:
    if suffix == ".obj":
        from freecad_tetra.export import obj

        return obj.write_cells
    if suffix == ".vtu":
        from freecad_tetra.export import vtu

        return vtu.write_cells
    if suffix == ".glb":
        from freecad_tetra.export import glb

        return glb.write_cells
    from freecad_tetra.export import brep

    return brep.write_cells if suffix == ".brep" else brep.write_step


def _tet_writer(suffix: str) -> Writer:
    if suffix == ".obj":
        from freecad_tetra.export import obj

        return obj.write_skin
    if suffix == ".vtu":
        from freecad_tetra.export import vtu

        return vtu.write_tets
    if suffix == ".msh":
        from freecad_tetra.export import msh

        return msh.write_tets
    if suffix == ".inp":
        from freecad_tetra.export import inp

        return inp.write_tets
    if suffix == ".mesh":
        from freecad_tetra.export import medit

        return medit.write_tets
    from freecad_tetra.export import vtk

    return vtk.write_tets


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
