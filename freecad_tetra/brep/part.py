# SPDX-License-Identifier: LGPL-2.1-or-later
"""One tessellation of a FreeCAD Part.Shape, whose faces meet in the nodes of their shared edges.

OpenCascade meshes the whole shape at once. Which nodes are one comes from its dump; their
coordinates, which the dump rounds, from ``Face.tessellate``, which hands out the mesh that is
there, in the same order of triangles.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

import numpy as np

from freecad_tetra.brep import Deflection, part_dump
from freecad_tetra.brep.part_dump import Dump, Place
from freecad_tetra.brep.weld import Nodes, compact
from freecad_tetra.errors import Defect, InvalidSolid, TetraError
from freecad_tetra.model import Solid

Numbers = np.ndarray[Any, Any]

_COARSER = 100.0


@dataclass(frozen=True)
class PartShape:
    """A Part.Shape that `freecad_tetra.brep.tessellate` can tessellate in FreeCAD's process.

    Attributes
    ----------
    shape : Part.Shape
        Never changed and never meshed: copies are.
    """

    shape: Any

    def tessellated(self, deflection: Deflection, name: str = "", only: int | None = None) -> Solid:
        """Return all solids of the shape; see `freecad_tetra.brep.tessellate`."""
        return tessellate(self.shape, deflection, name, only)


def tessellate(shape: Any, deflection: Deflection, name: str, only: int | None) -> Solid:
    """Tessellate the solids of a Part.Shape; see `freecad_tetra.brep.tessellate`."""
    import MeshPart

    _require_solid(shape, only)
    shape = shape.copy(True, False)  # spares the caller's shape the mesh
    linear = deflection.chord(_diagonal(shape))
    MeshPart.meshFromShape(
        Shape=shape, LinearDeflection=linear, AngularDeflection=deflection.angle(), Relative=False
    )
    # A coarser mesh than the one at hand is never made anew.
    given = [_Given(face, _COARSER * linear) for face in shape.Faces]
    found = _Walk(part_dump.read(shape.dumpToString()), given)
    rows, face_ids, solid_ids = found.triangles(only)
    if found.bare:
        names = tuple(f"Face{i + 1}" for i in sorted(found.bare))
        raise InvalidSolid([Defect("no_mesh", "OpenCascade cannot tessellate them", faces=names)])
    notes = {
        "linear_deflection": linear,
        "angular_deflection": deflection.angular,
        "brep_volume": _volume(shape, only),
        "solids": len(shape.Solids) if only is None else 1,
    }
    names = tuple(f"Face{i + 1}" for i in range(len(given)))
    return compact(
        found.nodes.points(), found.nodes.welded(rows), face_ids, solid_ids, names, name, notes
    )


def _require_solid(shape: Any, only: int | None) -> None:
    count = 0 if shape is None or shape.isNull() else len(shape.Solids)
    if count == 0:
        defect = Defect("no_solid", "the shape holds no solid, only faces, shells or wires")
        raise InvalidSolid([defect], defect.message, "make a solid of it and try again")
    if only is not None and not 1 <= only <= count:
        defect = Defect("no_solid", f"there is no solid {only}, the shape has {count}")
        raise InvalidSolid([defect], defect.message, f"choose a solid from 1 to {count}")


def _diagonal(shape: Any) -> float:
    length = float(shape.BoundBox.DiagonalLength)
    return length if math.isfinite(length) and length > 0 else 1.0


def _volume(shape: Any, only: int | None) -> float:
    solids = shape.Solids if only is None else [shape.Solids[only - 1]]
    return math.fsum(abs(s.Volume) for s in solids)


class _Given:
    """The triangles of one face as FreeCAD hands them out: welded by distance, flat ones left
    out, in the order of OpenCascade's own."""

    def __init__(self, face: Any, deflection: float) -> None:
        points, triangles = face.tessellate(deflection)
        self.points: Numbers = np.array([tuple(p) for p in points], np.float64).reshape(-1, 3)
        self.triangles: Numbers = np.array(triangles, np.int64).reshape(-1, 3)
        if face.Orientation != "Forward":  # FreeCAD has turned them
            self.triangles = self.triangles[:, [1, 0, 2]]

    def merged(self, own: Numbers, count: int, same: Numbers) -> Numbers:
        """Return which of `points` each node is, (count,) int64, -1 where no triangle tells.

        Parameters
        ----------
        own : (t, 3) int64
            OpenCascade's triangles.
        count : int
            Nodes of OpenCascade.
        same : (count,) int64
            Class of each node by topology; triangles with two corners in one class are flat.
        """
        if len(own) == len(self.triangles):
            rows: Numbers = np.arange(len(own))
        else:
            classes = same[own]
            rows = np.flatnonzero((classes != np.roll(classes, 1, axis=1)).all(axis=1))
        if len(rows) != len(self.triangles):
            rows = self._aligned(own, rows, count)
        out = np.full(count, -1, np.int64)
        out[own[rows].ravel()] = self.triangles.ravel()
        if not np.array_equal(out[own[rows]], self.triangles):
            raise TetraError(
                "FreeCAD and OpenCascade disagree about the triangles of a face",
                "please report the part and the version of FreeCAD",
            )
        return out

    def _aligned(self, own: Numbers, rows: Numbers, count: int) -> Numbers:
        """Return which of `rows` FreeCAD has kept: those that contradict no earlier one."""
        known = [-1] * count
        kept: list[int] = []
        for row in rows.tolist():
            if len(kept) == len(self.triangles):
                break
            corners, told = own[row].tolist(), self.triangles[len(kept)].tolist()
            if all(known[c] in (-1, t) for c, t in zip(corners, told)):
                kept.append(row)
                for c, t in zip(corners, told):
                    known[c] = t
        return np.array(kept, np.int64)


class _Walk:
    """The faces of all solids in FreeCAD's order, their nodes welded."""

    def __init__(self, dump: Dump, given: list[_Given]) -> None:
        self.nodes = Nodes()
        self.bare: set[int] = set()
        self._dump = dump
        self._given = given
        self._faces: dict[tuple[int, Place], int] = {}
        self._loaded: dict[int, Numbers] = {}
        for number, place, _ in self._explore(dump.root, (), "+", "FACE"):
            self._faces.setdefault((number, place), len(self._faces))
        if len(self._faces) != len(given):
            raise TetraError(
                f"FreeCAD counts {len(given)} faces, OpenCascade {len(self._faces)}",
                "please report the part and the version of FreeCAD",
            )

    def triangles(self, only: int | None) -> tuple[Numbers, Numbers, Numbers]:
        """Return triangles (t, 3), their faces and solids (t,), 0-based; fills `bare`."""
        rows, face_ids, solid_ids = [np.zeros((0, 3), np.int64)], [np.zeros(0)], [np.zeros(0)]
        solids: dict[tuple[int, Place], str] = {}
        for number, place, sign in self._explore(self._dump.root, (), "+", "SOLID"):
            solids.setdefault((number, place), sign)
        for k, ((number, place), sign) in enumerate(solids.items()):
            if only is not None and k != only - 1:
                continue
            for face, at, side in self._explore(number, place, sign, "FACE"):
                if side not in "+-":
                    continue
                own = self._face(face, at)
                rows.append(own if side == "+" else own[:, ::-1])
                face_ids.append(np.full(len(own), self._faces[face, at]))
                solid_ids.append(np.full(len(own), k))
        return np.concatenate(rows), np.concatenate(face_ids), np.concatenate(solid_ids)

    def _explore(
        self, number: int, place: Place, sign: str, kind: str
    ) -> Iterator[tuple[int, Place, str]]:
        """Yield (number, place, sign) of all parts of a kind, depth first as OpenCascade does."""
        shape = self._dump.shapes[number]
        if shape.kind == kind:
            yield number, place, sign
            return
        for side, part, at in shape.parts:
            yield from self._explore(
                part, part_dump.product(place, at), _composed(sign, side), kind
            )

    def _face(self, number: int, place: Place) -> Numbers:
        """Return the triangles of a face in its own sense."""
        index = self._faces[number, place]
        if index not in self._loaded:
            self._loaded[index] = self._load(number, place, self._given[index])
            if not len(self._loaded[index]):
                self.bare.add(index)
        return self._loaded[index]

    def _load(self, number: int, place: Place, given: _Given) -> Numbers:
        mesh = self._dump.shapes[number].triangulation
        if not mesh or not len(given.triangles):
            return np.zeros((0, 3), np.int64)
        own, count = self._dump.triangles[mesh - 1], self._dump.node_counts[mesh - 1]
        edges = list(self._edges(number, place, mesh))
        local = Nodes()
        local.add(np.zeros((count, 3)))
        for nodes, names, point in edges:
            local.weld_edge(nodes, *names, point)
        which = given.merged(own, count, local.welded(np.arange(count)))
        # A node in flat triangles only lies where its class lies; nothing else uses it.
        base = self.nodes.add(given.points[np.maximum(which, 0)])
        for nodes, names, point in edges:
            self.nodes.weld_edge([base + n for n in nodes], *names, point)
        for node in np.flatnonzero(which >= 0).tolist():
            self.nodes.join((base, int(which[node]), "given"), base + node)
        kept = (which[own] >= 0).all(axis=1)
        return own[kept] + base

    def _edges(
        self, number: int, place: Place, mesh: int
    ) -> Iterator[tuple[list[int], tuple[Any, Any, Any], bool]]:
        """Yield (nodes, (edge, first vertex, last vertex), degenerate) of the edges of a face."""
        for edge, at, _ in self._explore(number, place, "+", "EDGE"):
            shape = self._dump.shapes[edge]
            ends = {
                side: (part, part_dump.product(at, p)) for side, part, p in shape.parts
                if side in "+-"
            }  # fmt: skip
            seen = part_dump.product(part_dump.inverse(at), place)
            own = [p for p in shape.polygons if p.triangulation == mesh]
            own = [p for p in own if p.place == seen] or own[:1]
            for polygon in own:
                for which in (polygon.first, polygon.second):
                    if which and len(ends) == 2:
                        names = ((edge, at), ends["+"], ends["-"])
                        yield self._dump.polygons[which - 1], names, shape.degenerate


def _composed(outer: str, inner: str) -> str:
    """Return the orientation of a part of a part, as TopAbs::Compose."""
    if inner in "ie":
        return inner
    if outer in "ie":
        return outer
    return "+" if outer == inner else "-"
