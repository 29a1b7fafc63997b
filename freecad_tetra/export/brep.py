# SPDX-License-Identifier: LGPL-2.1-or-later
"""Pieces as OpenCascade BREP text, with vertices, edges and faces shared between neighbours.

Written by hand: building a thousand solids one by one takes OpenCascade seconds, parsing
their text takes it a tenth of a second, and neighbours keep their common faces.
"""

from __future__ import annotations

import tempfile
from collections.abc import Sequence
from itertools import pairwise
from pathlib import Path
from typing import Any, BinaryIO

import numpy as np

from freecad_tetra.errors import MissingDependency, TetraError
from freecad_tetra.export import brep_tables
from freecad_tetra.export.brep_tables import Tables
from freecad_tetra.model import ConvexCells, FloatArray, LongArray, TetMesh

_FLAGS = {"Ve": "0101101", "Ed": "0101000", "Wi": "0101100", "Fa": "0111000", "Sh": "0101100",
          "So": "0100000", "CS": "0100000", "Co": "1100000"}  # fmt: skip


def write_cells(cells: ConvexCells, stream: BinaryIO) -> None:
    """Write one compound with one solid per cell, in the order of the cells.

    Edges shorter than OpenCascade can tell are closed, and what they bounded goes.
    """
    stream.write(text(brep_tables.tables(cells, share=True)).encode("ascii"))


def write_tets(mesh: TetMesh, stream: BinaryIO) -> None:
    """Write one compound with one solid per tetrahedron."""
    write_cells(brep_tables.cells_of_tets(mesh), stream)


def write_step(cells: ConvexCells, stream: BinaryIO) -> None:
    """Write STEP (AP214) by way of the BREP text and OCP.

    Raises
    ------
    MissingDependency
        OCP is not installed.
    """
    try:
        from OCP.BRep import BRep_Builder
        from OCP.BRepTools import BRepTools
        from OCP.IFSelect import IFSelect_ReturnStatus
        from OCP.Message import Message, Message_PrinterOStream
        from OCP.STEPControl import STEPControl_StepModelType, STEPControl_Writer
        from OCP.TopoDS import TopoDS_Shape
    except ImportError as error:
        raise MissingDependency("OCP", "writing STEP files", "cadquery-ocp") from error
    Message.DefaultMessenger_s().RemovePrinters(Message_PrinterOStream.get_type_descriptor_s())
    with tempfile.TemporaryDirectory() as folder:
        brep, step = Path(folder) / "cells.brep", Path(folder) / "cells.step"
        with brep.open("wb") as out:
            write_cells(cells, out)
        shape, writer = TopoDS_Shape(), STEPControl_Writer()
        if not BRepTools.Read_s(shape, str(brep), BRep_Builder()):
            raise TetraError("OpenCascade cannot read the cells", "write .brep and report the part")
        writer.Transfer(shape, STEPControl_StepModelType.STEPControl_AsIs)
        if writer.Write(str(step)) != IFSelect_ReturnStatus.IFSelect_RetDone:
            raise TetraError("OpenCascade cannot write the cells as STEP", "write .brep instead")
        stream.write(step.read_bytes())


def text(table: Tables, whole: Sequence[LongArray] = (), shifts: FloatArray | None = None) -> str:
    """Return BREP text (version 1) of a compound of solids; O(size).

    Parameters
    ----------
    table : Tables
    whole : sequence of (k,) int64
        Pieces that become one CompSolid each, in place of solids in the compound. When the
        first holds all pieces, it is the shape itself.
    shifts : (C, 3) float64, optional
        Moves each piece by a location of its own.
    """
    planes = brep_tables.planes(table, table.first)
    book = _Book()
    vertices = book.add("Ve", len(table.points), _vertices(table))
    edges = book.add("Ed", len(table.ends), _edges(table, vertices, book))
    faces = _add_faces(table, edges, book)
    solids = _add_solids(table, faces, book)
    moved = shifts is not None and len(shifts) > 0
    at = np.arange(1, len(solids) + 1) if moved else np.zeros(len(solids), np.int64)
    _add_top(solids, at, whole, book)
    locations = _locations(shifts) if shifts is not None else "Locations 0\n"
    return (
        "DBRep_DrawableShape\n\nCASCADE Topology V1, (c) Matra-Datavision\n"
        f"{locations}Curve2ds 0\nCurves {len(table.ends)}\n{_curves(table)}"
        "Polygon3D 0\nPolygonOnTriangulations 0\n"
        f"Surfaces {len(table.first)}\n{_surfaces(*planes)}Triangulations 0\n\n"
        f"TShapes {book.count}\n{book.assembled()}\n+1 0 \n"
    )


class _Book:
    """Blocks of shapes; they count from 1 as made, and files count them from the last."""

    def __init__(self) -> None:
        self.count = 0
        self._blocks: list[tuple[str, Any]] = []

    def add(self, kind: str, count: int, body: Any) -> LongArray:
        """Add `count` shapes and return their numbers; `body` gets the file's total later."""
        numbers = np.arange(self.count + 1, self.count + count + 1)
        self.count += count
        self._blocks.append((kind, body))
        return numbers

    def assembled(self) -> str:
        """Return the text of all shapes."""
        total = self.count + 1
        return "".join(body(f"\n{_FLAGS[kind]}\n", total) for kind, body in self._blocks)


def _vertices(table: Tables) -> Any:
    rows = np.column_stack([table.slack, table.points])

    def body(flags: str, total: int) -> str:
        return _filled(f"Ve\n%r\n%r %r %r\n0 0\n{flags}*\n", rows)

    return body


def _edges(table: Tables, vertices: LongArray, book: _Book) -> Any:
    low, high = table.ends.T
    slack = np.minimum(table.slack[low], table.slack[high])
    length = np.linalg.norm(table.points[high] - table.points[low], axis=1)

    def body(flags: str, total: int) -> str:
        form = f"Ed\n %r 1 1 0\n1  %d 0 0 %r\n0\n{flags}+%d 0 -%d 0 *\n"
        curve = range(1, len(low) + 1)
        ends = (total - vertices[low]).tolist(), (total - vertices[high]).tolist()
        return _zipped(form, slack.tolist(), curve, length.tolist(), *ends)

    return body


def _add_faces(table: Tables, edges: LongArray, book: _Book) -> LongArray:
    """Add the wires, in blocks of equal size, and a face for every face; return the faces."""
    loops, of_face = _loops_of_faces(table)
    sizes = np.diff(table.starts)[loops]
    wires = np.zeros(len(loops), np.int64)
    for size in np.unique(sizes).tolist():
        own = np.flatnonzero(sizes == size)
        wires[own] = book.add("Wi", len(own), _wires(table, loops[own], size, edges))
    corner_slack = table.slack[table.corners]
    worst = np.maximum.reduceat(corner_slack, table.starts[table.loops[:-1]])
    slack = worst[table.first].tolist()
    cuts = np.searchsorted(of_face, np.arange(len(slack) + 1)).tolist()

    def body(flags: str, total: int) -> str:
        words = _words(total - wires)
        refs = ("".join(words[a:b]) for a, b in pairwise(cuts))
        form = f"Fa\n0  %r %d 0\n{flags}%s*\n"
        return _zipped(form, slack, range(1, len(slack) + 1), refs)

    return book.add("Fa", len(slack), body)


def _loops_of_faces(table: Tables) -> tuple[LongArray, LongArray]:
    """Return the loops of all faces and the face of each, ascending."""
    first, count = table.loops[table.first], np.diff(table.loops)[table.first]
    of_face = np.repeat(np.arange(len(first)), count)
    inner = np.arange(len(of_face)) - np.repeat(np.cumsum(count) - count, count)
    return first[of_face] + inner, of_face


def _wires(table: Tables, loops: LongArray, size: int, edges: LongArray) -> Any:
    at = table.starts[loops][:, None] + np.arange(size)
    numbers, forward = edges[table.edge[at]], table.forward[at]

    def body(flags: str, total: int) -> str:
        refs = np.where(forward, total - numbers, numbers - total)
        return _filled(f"Wi\n{flags}" + "%+d 0 " * size + "*\n", refs)

    return body


def _add_solids(table: Tables, faces: LongArray, book: _Book) -> LongArray:
    """Add a shell and a solid for every piece and return the solids."""
    numbers = faces[table.face]
    signs = np.where(table.reversed_facets(), -1, 1)
    count = len(table.kept)
    cuts = np.searchsorted(table.piece, np.arange(count + 1)).tolist()

    def shells(flags: str, total: int) -> str:
        words = _words(signs * (total - numbers))
        rows = ("".join(words[a:b]) for a, b in pairwise(cuts))
        return "".join(f"Sh\n{flags}{row}*\n" for row in rows)

    made = book.add("Sh", count, shells)

    def solids(flags: str, total: int) -> str:
        return _zipped(f"So\n{flags}+%d 0 *\n", (total - made).tolist())

    return book.add("So", count, solids)


def _add_top(solids: LongArray, at: LongArray, whole: Sequence[LongArray], book: _Book) -> None:
    """Add the CompSolids and, when they are not all, the compound."""
    grouped = np.zeros(len(solids), bool)
    groups = []
    for pieces in whole:
        grouped[pieces] = True
        groups.append(book.add("CS", 1, _container("CS", solids[pieces], at[pieces]))[0])
    rest = np.flatnonzero(~grouped)
    if len(groups) == 1 and not len(rest):
        return
    parts = np.concatenate([np.array(groups, np.int64), solids[rest]])
    places = np.concatenate([np.zeros(len(groups), np.int64), at[rest]])
    book.add("Co", 1, _container("Co", parts, places))


def _container(kind: str, parts: LongArray, at: LongArray) -> Any:
    def body(flags: str, total: int) -> str:
        refs = zip((total - parts).tolist(), at.tolist())
        return f"{kind}\n{flags}" + "".join(f"+{part} {place} " for part, place in refs) + "*\n"

    return body


def _curves(table: Tables) -> str:
    start, stop = table.points[table.ends[:, 0]], table.points[table.ends[:, 1]]
    along = (stop - start) / np.linalg.norm(stop - start, axis=1)[:, None]
    return _filled("1 %r %r %r %r %r %r\n", np.column_stack([start, along]))


def _surfaces(origin: FloatArray, normal: FloatArray, x: FloatArray) -> str:
    rows = np.column_stack([origin, normal, x, np.cross(normal, x)])
    return _filled("1" + " %r" * 12 + "\n", rows)


def _locations(shifts: FloatArray) -> str:
    rows = _filled("1\n1 0 0 %r\n0 1 0 %r\n0 0 1 %r\n", shifts)
    return f"Locations {len(shifts)}\n{rows}"


def _words(signed: LongArray) -> list[str]:
    return [f"{i:+d} 0 " for i in signed.tolist()]


def _filled(form: str, rows: Any) -> str:
    """Return `form` once for every row of numbers."""
    return (form * len(rows)) % tuple(rows.ravel().tolist())


def _zipped(form: str, *columns: Any) -> str:
    """Return `form` once for every row of columns of unlike types."""
    return "".join([form % row for row in zip(*columns)])
