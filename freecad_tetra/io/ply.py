# SPDX-License-Identifier: LGPL-2.1-or-later
"""PLY, ascii and binary of either byte order; only positions and polygons are kept."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from freecad_tetra.errors import UnsupportedFormat
from freecad_tetra.io.polygons import BadFile, Mesh, mesh
from freecad_tetra.io.text import integers, numbers, whole

_TYPES = {
    "char": "i1", "uchar": "u1", "short": "i2", "ushort": "u2", "int": "i4", "uint": "u4",
    "float": "f4", "double": "f8", "int8": "i1", "uint8": "u1", "int16": "i2", "uint16": "u2",
    "int32": "i4", "uint32": "u4", "float32": "f4", "float64": "f8",
}  # fmt: skip


@dataclass(frozen=True)
class _Property:
    name: str
    kind: str
    count_kind: str = ""  # not empty for a list


@dataclass(frozen=True)
class _Element:
    name: str
    count: int
    properties: tuple[_Property, ...]

    def has_list(self) -> bool:
        return any(p.count_kind for p in self.properties)


def parse(data: bytes) -> Mesh:
    """Read PLY."""
    form, elements, start = _header(data)
    body = memoryview(data)[start:]
    tables: dict[str, dict[str, Any]] = {}
    if form == "ascii":
        stream: Any = _Words(bytes(body))
    else:
        stream = _Bytes(body, "<" if form == "binary_little_endian" else ">")
    for element in elements:
        tables[element.name] = stream.read(element)
    vertex, face = tables.get("vertex"), tables.get("face")
    if vertex is None or not all(axis in vertex for axis in "xyz"):
        raise BadFile("it has no vertex positions")
    points = np.stack([np.asarray(vertex[a], np.float64) for a in "xyz"], axis=1)
    rows = (face or {}).get("vertex_indices", (face or {}).get("vertex_index"))
    if rows is None:
        raise BadFile("it has no faces")
    return mesh(points, rows[0], rows[1])


def _header(data: bytes) -> tuple[str, list[_Element], int]:
    if not data.startswith(b"ply"):
        raise BadFile("it does not begin with ply")
    end = data.find(b"end_header")
    stop = data.find(b"\n", end)
    if end < 0 or stop < 0:
        raise BadFile("the header has no end")
    form, elements = "", []
    for line in data[:end].decode("ascii", "replace").splitlines()[1:]:
        words = line.split()
        if not words or words[0] in ("comment", "obj_info"):
            continue
        if words[0] == "format" and len(words) == 3:
            form = words[1]
        elif words[0] == "element" and len(words) == 3:
            elements.append(_Element(words[1], whole(words[2], "a count"), ()))
        elif words[0] == "property" and elements:
            last = elements.pop()
            more = (*last.properties, _property(words))
            elements.append(_Element(last.name, last.count, more))
        else:
            raise BadFile(f"the header line {line.strip()[:40]!r} is not understood")
    if form not in ("ascii", "binary_little_endian", "binary_big_endian"):
        raise UnsupportedFormat(f"PLY format {form or '(none)'} is not handled", "save as ascii")
    return form, elements, stop + 1


def _property(words: list[str]) -> _Property:
    try:
        if words[1] == "list":
            return _Property(words[4], _TYPES[words[3]], _TYPES[words[2]])
        return _Property(words[2], _TYPES[words[1]])
    except (IndexError, KeyError) as error:
        raise BadFile(f"the property {' '.join(words)[:60]!r} is not understood") from error


class _Words:
    """Ascii body: a stream of numbers."""

    def __init__(self, body: bytes) -> None:
        self._values = numbers(body)
        self._at = 0

    def read(self, element: _Element) -> dict[str, Any]:
        if not element.has_list():
            width = len(element.properties)
            rows = self._take(element.count * width).reshape(element.count, width)
            return {p.name: rows[:, i] for i, p in enumerate(element.properties)}
        return self._lists(element)

    def _take(self, count: int) -> Any:
        if self._at + count > len(self._values):
            raise BadFile("it is truncated")
        self._at += count
        return self._values[self._at - count : self._at]

    def _lists(self, element: _Element) -> dict[str, Any]:
        columns: dict[str, tuple[list[Any], list[int]]] = {
            p.name: ([], []) for p in element.properties
        }
        if element.count > len(self._values) - self._at:
            raise BadFile("it is truncated")
        if len(element.properties) == 1 and element.count:
            table = self._values[self._at :].reshape(-1)
            size = int(table[0]) if np.isfinite(table[0]) and table[0] >= 0 else 0
            regular = table[: element.count * (size + 1)]
            if len(regular) == element.count * (size + 1):
                rows = regular.reshape(element.count, size + 1)
                if (rows[:, 0] == size).all():
                    self._at += rows.size
                    flat = integers(rows[:, 1:], "list entries").reshape(-1)
                    return {element.properties[0].name: (flat, np.full(element.count, size))}
        for _ in range(element.count):
            for p in element.properties:
                size = int(integers(self._take(1), "a list size")[0]) if p.count_kind else 1
                if size < 0:
                    raise BadFile("a list has a negative size")
                columns[p.name][0].append(self._take(size))
                columns[p.name][1].append(size)
        return {
            p.name: (integers(np.concatenate(columns[p.name][0]), "list entries"),
                     np.array(columns[p.name][1])) if p.count_kind and columns[p.name][0]
            else (np.zeros(0, np.int64), np.zeros(0, np.int64))
            for p in element.properties
        }  # fmt: skip


class _Bytes:
    """Binary body: records, or one record after the other where lists vary."""

    def __init__(self, body: memoryview, order: str) -> None:
        self._body = body
        self._order = order
        self._at = 0

    def read(self, element: _Element) -> dict[str, Any]:
        if not element.has_list():
            fields = [(p.name, self._order + p.kind) for p in element.properties]
            return self._records(element.count, fields)
        sizes = self._first_sizes(element)
        table = self._regular(element, sizes) if sizes is not None else None
        return table if table is not None else self._lists(element)

    def _records(self, count: int, fields: list[Any]) -> dict[str, Any]:
        kind = np.dtype(fields)
        if self._at + count * kind.itemsize > len(self._body):
            raise BadFile("it is truncated")
        rows = np.frombuffer(self._body, kind, count, self._at)
        self._at += count * kind.itemsize
        return {name: rows[name] for name in kind.names or ()}

    def _first_sizes(self, element: _Element) -> list[int] | None:
        """Return the list sizes of the first record, which most files repeat in all."""
        at, sizes = self._at, []
        for p in element.properties if element.count else ():
            size = 1
            if p.count_kind:
                raw, at = self._scalar(p.count_kind, at)
                size = int(raw)
            if size < 0:
                raise BadFile("a list has a negative size")
            sizes.append(size)
            at += size * np.dtype(p.kind).itemsize
        return sizes or None

    def _scalar(self, kind: str, at: int) -> tuple[Any, int]:
        size = np.dtype(kind).itemsize
        if at + size > len(self._body):
            raise BadFile("it is truncated")
        return np.frombuffer(self._body, self._order + kind, 1, at)[0], at + size

    def _regular(self, element: _Element, sizes: list[int]) -> dict[str, Any] | None:
        fields: list[Any] = []
        for p, size in zip(element.properties, sizes):
            if p.count_kind:
                fields.append((f"#{p.name}", self._order + p.count_kind))
                fields.append((p.name, self._order + p.kind, (size,)))
            else:
                fields.append((p.name, self._order + p.kind))
        if self._at + element.count * np.dtype(fields).itemsize > len(self._body):
            return None
        start = self._at
        rows = self._records(element.count, fields)
        lists = [(p, s) for p, s in zip(element.properties, sizes) if p.count_kind]
        if not all((rows[f"#{p.name}"] == s).all() for p, s in lists):
            self._at = start
            return None
        out: dict[str, Any] = {p.name: rows[p.name] for p in element.properties}
        for p, size in lists:
            flat = rows[p.name].reshape(-1).astype(np.int64)
            out[p.name] = (flat, np.full(element.count, size, np.int64))
        return out

    def _lists(self, element: _Element) -> dict[str, Any]:
        flat: dict[str, list[Any]] = {p.name: [] for p in element.properties}
        for _ in range(element.count):
            for p in element.properties:
                size = 1
                if p.count_kind:
                    raw, self._at = self._scalar(p.count_kind, self._at)
                    size = int(raw)
                width = np.dtype(p.kind).itemsize
                if size < 0 or self._at + size * width > len(self._body):
                    raise BadFile("it is truncated")
                flat[p.name].append(np.frombuffer(self._body, self._order + p.kind, size, self._at))
                self._at += size * width
        return {
            name: (np.concatenate(rows).astype(np.int64), np.array([len(r) for r in rows]))
            if rows else (np.zeros(0, np.int64), np.zeros(0, np.int64))
            for name, rows in flat.items()
        }  # fmt: skip
