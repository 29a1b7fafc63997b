# SPDX-License-Identifier: LGPL-2.1-or-later
"""STL, ascii and binary; its triangle soup is welded where coordinates are exactly equal."""

from __future__ import annotations

import re
from typing import Any

import numpy as np
import numpy.typing as npt

from freecad_tetra.io.polygons import BadFile, Mesh, mesh
from freecad_tetra.io.text import numbers
from freecad_tetra.io.weld import compacted

_RECORD = np.dtype([("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("attribute", "<u2")])
_NAME_LINE = re.compile(rb"^[ \t]*(?:end)?solid\b[^\n]*$", re.MULTILINE | re.IGNORECASE)
# Longer words first, so that what remains of a file is its numbers.
_WORDS = ((b"endfacet", 1), (b"endloop", 1), (b"facet", 1), (b"normal", 1), (b"outer", 1),
          (b"loop", 1), (b"vertex", 3))  # fmt: skip


def parse(data: bytes) -> Mesh:
    """Read STL; float32 coordinates of binary files are taken as they are.

    The size decides between the variants: many binary files begin with "solid" as well.
    """
    if len(data) >= 84:
        count = int.from_bytes(data[80:84], "little")
        if len(data) == 84 + 50 * count:
            return _soup(np.frombuffer(data, _RECORD, count, 84)["corners"])
    if data[:512].lstrip()[:5].lower() == b"solid" and b"\0" not in data:
        return _ascii(data)
    if len(data) < 84:
        raise BadFile("it is too short for a binary STL and does not begin with solid")
    raise BadFile(f"a binary STL of {count} triangles has {84 + 50 * count} bytes, not {len(data)}")


def _ascii(data: bytes) -> Mesh:
    if not re.search(rb"\bendsolid\b[^\n]*\s*\Z", data, re.IGNORECASE):
        raise BadFile("it is truncated (endsolid is missing)")
    body = _NAME_LINE.sub(b"", data.replace(b"\r", b"\n")).lower()
    count = body.count(b"endfacet")
    for word, per_facet in _WORDS:
        found = body.count(word)
        if found != count * per_facet:
            raise BadFile(f"the word {word.decode()} occurs {found} times in {count} facets")
        body = body.replace(word, b" ")
    values = numbers(body)
    if len(values) != 12 * count:
        raise BadFile(f"{count} facets need {12 * count} numbers, there are {len(values)}")
    return _soup(values.reshape(-1, 4, 3)[:, 1:])


def _soup(corners: npt.NDArray[Any]) -> Mesh:
    points, triangles = compacted(corners.astype(np.float64).reshape(-1, 3))
    return mesh(points, triangles)
