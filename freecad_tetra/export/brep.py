# SPDX-License-Identifier: LGPL-2.1-or-later
"""Convex cells as OpenCascade BREP text, with vertices, edges and faces shared between cells.

Written by hand: building a thousand solids one by one takes OpenCascade seconds, parsing
their text takes it a tenth of a second, and neighbours keep their common faces.
"""

from __future__ import annotations

import tempfile
from pathlib import Path
from typing import Any, BinaryIO

import numpy as np

from freecad_tetra.errors import MissingDependency, TetraError
from freecad_tetra.model import ConvexCells, FloatArray, IntArray

_TOLERANCE = 1e-7  # OpenCascade's smallest
_SHORT = 3e-7  # edges between two points that the tolerance cannot keep apart
_FLAGS = {"Ve": "0101101", "Ed": "0101000", "Wi": "0101100", "Fa": "0111000", "Sh": "0101100",
          "So": "0100000", "Co": "1100000"}  # fmt: skip


def write_cells(cells: ConvexCells, stream: BinaryIO) -> None:
    """Write one compound with one solid per cell, in the order of the cells.

    Edges shorter than OpenCascade can tell are closed, and what they bounded goes.
    """
    stream.write(_Text(cells).assembled().encode("ascii"))


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
        text, step = Path(folder) / "cells.brep", Path(folder) / "cells.step"
        with text.open("wb") as out:
            write_cells(cells, out)
        shape, writer = TopoDS_Shape(), STEPControl_Writer()
        if not BRepTools.Read_s(shape, str(text), BRep_Builder()):
            raise TetraError("OpenCascade cannot read the cells", "write .brep and report the part")
        writer.Transfer(shape, STEPControl_StepModelType.STEPControl_AsIs)
        if writer.Write(str(step)) != IFSelect_ReturnStatus.IFSelect_RetDone:
            raise TetraError("OpenCascade cannot write the cells as STEP", "write .brep instead")
        stream.write(step.read_bytes())


class _Text:
    """Tables of one BREP file; shapes count from 1 in the order they are made."""

    def __init__(self, cells: ConvexCells) -> None:
        self._cells = cells
        self._curves: list[str] = []
        self._surfaces: list[str] = []
        self._shapes: list[tuple[str, str, list[int]]] = []
        self._edges: dict[tuple[int, int], int] = {}
        self._faces: dict[tuple[int, ...], int] = {}
        self._loops = _loops_without_short_edges(cells)
        self._planes = [_plane(cells.points[loop]) for loop in self._loops]
        self._slack = self._deviations()
        self._vertices = self._make_vertices()

    def assembled(self) -> str:
        """Return the whole file."""
        solids = [self._solid(k) for k in range(len(self._cells)) if self._is_solid(k)]
        self._add("Co", "", solids)
        total = len(self._shapes)
        rows = [
            f"{kind}\n{body}\n{_FLAGS[kind]}\n"
            + "".join(f"{'+' if s > 0 else '-'}{total - abs(s) + 1} 0 " for s in parts)
            + "*\n"
            for kind, body, parts in self._shapes
        ]
        return (
            "DBRep_DrawableShape\n\nCASCADE Topology V1, (c) Matra-Datavision\n"
            f"Locations 0\nCurve2ds 0\nCurves {len(self._curves)}\n{''.join(self._curves)}"
            "Polygon3D 0\nPolygonOnTriangulations 0\n"
            f"Surfaces {len(self._surfaces)}\n{''.join(self._surfaces)}Triangulations 0\n\n"
            f"TShapes {total}\n{''.join(rows)}\n+1 0 \n"
        )

    def _add(self, kind: str, body: str, parts: list[int]) -> int:
        self._shapes.append((kind, body, parts))
        return len(self._shapes)

    def _deviations(self) -> FloatArray:
        """Return per point how far it lies from the planes of its facets, (p,) float64."""
        slack = np.full(len(self._cells.points), _TOLERANCE)
        for f, (origin, normal, _) in enumerate(self._planes):
            loop = self._loops[f]
            if len(loop) < 3:
                continue
            off = np.abs((self._cells.points[loop] - origin) @ normal).max()
            slack[loop] = np.maximum(slack[loop], 1.1 * off)
        return slack

    def _make_vertices(self) -> list[int]:
        points = zip(self._cells.points.tolist(), self._slack.tolist())
        return [
            self._add("Ve", f"{slack:.17g}\n{x:.17g} {y:.17g} {z:.17g}\n0 0\n", [])
            for (x, y, z), slack in points
        ]

    def _is_solid(self, k: int) -> bool:
        return sum(len(self._loops[f]) > 2 for f in self._cells.cell_facets(k)) > 3

    def _solid(self, k: int) -> int:
        kept = [f for f in self._cells.cell_facets(k) if len(self._loops[f]) > 2]
        faces = [self._face(f) for f in kept]
        return self._add("So", "", [self._add("Sh", "", faces)])

    def _face(self, f: int) -> int:
        """Return a face, negative when it is the other side of one made before."""
        loop = self._loops[f]
        back = self._faces.get(_cycle(loop[::-1]))
        if back is not None:
            return -back
        edges = [self._edge(int(a), int(b)) for a, b in zip(loop, np.roll(loop, -1))]
        wire = self._add("Wi", "", edges)
        origin, normal, x = self._planes[f]
        rows = (origin, normal, x, np.cross(normal, x))
        self._surfaces.append("1 " + " ".join(_words(r) for r in rows) + "\n")
        slack = self._slack[loop].max()
        face = self._add("Fa", f"0  {slack:.17g} {len(self._surfaces)} 0\n", [wire])
        self._faces[_cycle(loop)] = face
        return face

    def _edge(self, a: int, b: int) -> int:
        low, high = min(a, b), max(a, b)
        known = self._edges.get((low, high))
        if known is None:
            start, stop = self._cells.points[low], self._cells.points[high]
            length = float(np.linalg.norm(stop - start))
            self._curves.append(f"1 {_words(start)} {_words((stop - start) / length)}\n")
            slack = min(self._slack[low], self._slack[high])
            body = f" {slack:.17g} 1 1 0\n1  {len(self._curves)} 0 0 {length:.17g}\n0\n"
            ends = [self._vertices[low], -self._vertices[high]]
            known = self._edges[low, high] = self._add("Ed", body, ends)
        return known if a == low else -known


def _loops_without_short_edges(cells: ConvexCells) -> list[IntArray]:
    """Return the loop of every facet with the ends of short edges made one."""
    parent = np.arange(len(cells.points), dtype=np.int32)
    loops = [cells.facet(f) for f in range(len(cells.facet_offsets) - 1)]
    start = np.concatenate(loops) if loops else np.zeros(0, np.int32)
    stop = np.concatenate([np.roll(x, -1) for x in loops]) if loops else start
    lengths = np.linalg.norm(cells.points[start] - cells.points[stop], axis=1)
    for i in np.flatnonzero(lengths < _SHORT):
        a, b = _root(parent, int(start[i])), _root(parent, int(stop[i]))
        parent[max(a, b)] = min(a, b)
    root = np.array([_root(parent, i) for i in range(len(parent))], np.int32)
    closed = [root[loop] for loop in loops]
    return [loop[loop != np.roll(loop, 1)] for loop in closed]


def _root(parent: IntArray, i: int) -> int:
    while parent[i] != i:
        i = int(parent[i])
    return i


def _words(values: Any) -> str:
    return " ".join(f"{v:.17g}" for v in values)


def _cycle(loop: IntArray) -> tuple[int, ...]:
    """Return the loop turned so that its smallest id leads."""
    return tuple(np.roll(loop, -int(np.argmin(loop))).tolist())


def _plane(loop: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Return (origin, unit normal, unit x) of a loop, by Newell's rule."""
    if len(loop) < 3:
        return np.zeros(3), np.array([0.0, 0.0, 1.0]), np.array([1.0, 0.0, 0.0])
    shifted = loop - loop[0]
    normal = np.cross(shifted, np.roll(shifted, -1, axis=0)).sum(axis=0)
    sides = np.roll(loop, -1, axis=0) - loop
    x = sides[int(np.argmax(np.linalg.norm(sides, axis=1)))]
    x = x / np.linalg.norm(x)
    # A sliver's normal is noise: it has at least to be perpendicular to its long side.
    normal = normal - (normal @ x) * x
    if not np.linalg.norm(normal) > 0:
        normal = np.cross(x, np.eye(3)[int(np.argmin(np.abs(x)))])
    return loop.mean(axis=0), normal / np.linalg.norm(normal), x
