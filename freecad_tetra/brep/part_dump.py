# SPDX-License-Identifier: LGPL-2.1-or-later
"""Reads OpenCascade's dump of a shape: its topology, and the triangles and edge nodes of its mesh.

FreeCAD's Part writes meshes nowhere else: its BREP files leave them out, and ``tessellate``
forgets which node belongs to which edge. Coordinates in the dump have six digits and are not
read here.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from freecad_tetra.errors import TetraError

# Elementary locations with their powers, the innermost first as OpenCascade lists them,
# neighbours different: equal tuples are equal locations.
Place = tuple[tuple[int, int], ...]

_SHAPE = re.compile(r"TShape # (\d+) : (\w+)")
_PART = re.compile(r"([+\-ie])(\d+)(?:\(L(\d+)\))?")
_POLYGON = re.compile(
    r"- PolygonOnTriangulation\s+(\d+)(?:\s+(\d+))?\s+on triangulation\s+(\d+)"
    r"(?:\s+location\s+(\d+))?"
)
_TRIANGULATION = re.compile(r"- Triangulation : (\d+)")
_LOCATION = re.compile(r"^ *(\d+) : *\n(Elementary location|Complex : (.*))$", re.MULTILINE)
_FACTOR = re.compile(r"L(\d+)(?:\^(-?\d+))?")


@dataclass(frozen=True)
class Polygon:
    """Where the nodes of an edge are: polygon `first` of `triangulation` (and `second`, at the
    other side of a seam), both 1-based; `place` is that of the face as the edge sees it."""

    first: int
    second: int
    triangulation: int
    place: Place


@dataclass
class TShape:
    """One shape without place and orientation.

    Attributes
    ----------
    kind : str
        COMPOUND, SOLID, SHELL, FACE, WIRE, EDGE, VERTEX ...
    parts : list of (sign, number, place)
        Sign is one of ``+ - i e``.
    triangulation : int
        Of a face, 1-based; 0 without.
    degenerate : bool
    polygons : list of Polygon
    """

    kind: str
    parts: list[tuple[str, int, Place]] = field(default_factory=list)
    triangulation: int = 0
    degenerate: bool = False
    polygons: list[Polygon] = field(default_factory=list)


@dataclass(frozen=True)
class Dump:
    """What a dump holds.

    Attributes
    ----------
    root : int
        Number of the whole shape in `shapes`.
    shapes : dict of int to TShape
    polygons : list of list of int
        Nodes of each polygon, 0-based in its triangulation.
    triangles : list of (t, 3) int64
        Of each triangulation, 0-based.
    node_counts : list of int
    """

    root: int
    shapes: dict[int, TShape]
    polygons: list[list[int]]
    triangles: list[np.ndarray[Any, Any]]
    node_counts: list[int]


def product(a: Place, b: Place) -> Place:
    """Return the location a * b, first b and then a; neighbours that cancel go."""
    out = list(b)
    for number, power in a:
        if out and out[-1][0] == number:
            power += out.pop()[1]
        if power:
            out.append((number, power))
    return tuple(out)


def inverse(a: Place) -> Place:
    """Return the location that undoes `a`."""
    return tuple((number, -power) for number, power in reversed(a))


def read(text: str) -> Dump:
    """Read what ``Part.Shape.dumpToString`` returns; O(length).

    Raises
    ------
    TetraError
        The text is not a dump, or of a version whose form is not known.
    """
    try:
        return _read(text)
    except (AttributeError, ValueError, IndexError, KeyError) as error:
        raise TetraError(
            f"the mesh of this OpenCascade cannot be read: {error}",
            "please report the version of FreeCAD and OpenCascade",
        ) from error


def _read(text: str) -> Dump:
    shapes_text = _section(text, "TShapes")
    places = _locations(_section(text, "Locations"))
    shapes = dict(_shapes(shapes_text, places))
    polygons = _polygons(_section(text, "PolygonOnTriangulations"))
    found = [_triangulation(block) for block in _blocks(_section(text, "Triangulations"))]
    heading = re.search(r"Shape : (\d+)", text)
    root = len(shapes) - int(heading.group(1)) + 1 if heading else 1
    return Dump(root, shapes, polygons, [t for _, t in found], [n for n, _ in found])


def _section(text: str, title: str) -> str:
    """Return the text of one table, up to the next."""
    start = re.search(rf"^ *Dump of \d+ {title}\b.*$", text, re.MULTILINE)
    if start is None:
        raise ValueError(f"no table of {title}")
    stop = re.compile(r"^ *Dump of \d+ ", re.MULTILINE).search(text, start.end())
    return text[start.end() : stop.start() if stop else len(text)]


def _locations(text: str) -> dict[int, Place]:
    places: dict[int, Place] = {}
    for match in _LOCATION.finditer(text):
        number = int(match.group(1))
        place: Place = ((number, 1),)
        if match.group(3) is not None:
            place = ()
            for factor, power in _FACTOR.findall(match.group(3)):
                place = product(_power(places[int(factor)], int(power or 1)), place)
        places[number] = place
    return places


def _power(place: Place, exponent: int) -> Place:
    base = place if exponent > 0 else inverse(place)
    out: Place = ()
    for _ in range(abs(exponent)):
        out = product(out, base)
    return out


def _shapes(text: str, places: dict[int, Place]) -> Iterator[tuple[int, TShape]]:
    heads = list(_SHAPE.finditer(text))
    for head, following in zip(heads, [*heads[1:], None]):
        body = text[head.end() : following.start() if following else len(text)]
        shape = TShape(head.group(2))
        lines = body.split("\n", 2)
        shape.parts = [
            (sign, int(number), places[int(at)] if at else ())
            for sign, number, at in _PART.findall(lines[1] if len(lines) > 1 else "")
        ]
        if shape.kind == "FACE":
            found = _TRIANGULATION.search(body)
            shape.triangulation = int(found.group(1)) if found else 0
        elif shape.kind == "EDGE":
            shape.degenerate = re.search(r"^ *degenerated", body, re.MULTILINE) is not None
            shape.polygons = [
                Polygon(int(a), int(b or 0), int(t), places[int(at)] if at else ())
                for a, b, t, at in _POLYGON.findall(body)
            ]
        yield int(head.group(1)), shape


def _polygons(text: str) -> list[list[int]]:
    blocks = re.split(r"^ *\d+ : PolygonOnTriangulation with (\d+) Nodes.*$", text, flags=re.M)
    out = []
    for count, body in zip(blocks[1::2], blocks[2::2]):
        nodes = [int(word) - 1 for word in body.split(None, int(count))[: int(count)]]
        out.append(nodes)
    return out


def _blocks(text: str) -> Iterator[tuple[int, int, str]]:
    head = re.compile(r"^ *\d+ : Triangulation with (\d+) Nodes and (\d+) Triangles", re.M)
    heads = list(head.finditer(text))
    for match, following in zip(heads, [*heads[1:], None]):
        body = text[match.end() : following.start() if following else len(text)]
        yield int(match.group(1)), int(match.group(2)), body


def _triangulation(block: tuple[int, int, str]) -> tuple[int, np.ndarray[Any, Any]]:
    nodes, count, body = block
    rows = body[body.index("Triangles :") + len("Triangles :") :].replace(":", " ").split()
    table = np.array(rows[: 4 * count], dtype=np.int64).reshape(count, 4)
    return nodes, table[:, 1:] - 1
