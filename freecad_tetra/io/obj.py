# SPDX-License-Identifier: LGPL-2.1-or-later
"""Wavefront OBJ: the lines ``v`` and ``f``; the rest says nothing about the solid."""

from __future__ import annotations

import re
from typing import Any

import numpy as np
import numpy.typing as npt

from freecad_tetra.io.polygons import BadFile, Mesh, mesh
from freecad_tetra.io.text import integers, numbers

_Array = npt.NDArray[Any]

_VERTEX = re.compile(rb"^[ \t]*v[ \t]+([^\n]*)$", re.MULTILINE)
_FACE = re.compile(rb"^[ \t]*f[ \t]+([^\n]*)$", re.MULTILINE)
_TEXTURE = re.compile(rb"/[^\s]*")
_COMMENT = re.compile(rb"#[^\n]*")
_LINE = re.compile(
    rb"^[ \t]*(?:$|(?:v|vt|vn|vp|f|fo|l|p|o|g|s|usemtl|mtllib|usemap|maplib|bevel|lod|shadow_obj|"
    rb"trace_obj|c_interp|d_interp|mg|cstype|deg|curv|curv2|surf|parm|trim|hole|scrv|sp|end|con|"
    rb"bmat|step|call|csh|ctech|stech|c_interp|matlib)(?:[ \t][^\n]*)?$)",
    re.MULTILINE,
)


def parse(data: bytes) -> Mesh:
    """Read OBJ; negative indices count back from the vertices read so far."""
    if b"\0" in data:
        raise BadFile("it holds binary data")
    text = data.replace(b"\r\n", b"\n").replace(b"\r", b"\n").replace(b"\\\n", b" ")
    text = _COMMENT.sub(b"", text)
    if len(_LINE.findall(text)) != text.count(b"\n") + 1:
        raise BadFile("a line begins with an unknown word")
    if text.rstrip(b" \t") and not text.rstrip(b" \t").endswith(b"\n") and _cut(text):
        raise BadFile("the last line is cut short")
    points = _points(_VERTEX.findall(text))
    faces = _FACE.findall(text)
    if not len(points):
        raise BadFile("it has no vertices")
    return _faces(text, points, [_TEXTURE.sub(b"", row) for row in faces])


def _cut(text: bytes) -> bool:
    """Return whether a last line without its end is a face with fewer than three corners."""
    words = text[text.rfind(b"\n") + 1 :].split()
    return bool(words) and words[0] in (b"v", b"f") and len(words) < 4


def _points(rows: list[bytes]) -> _Array:
    values = numbers(b"\n".join(rows))
    if len(values) == 3 * len(rows):
        return values.reshape(-1, 3)
    out = np.zeros((len(rows), 3))
    for i, row in enumerate(rows):
        line = numbers(row)
        if len(line) not in (3, 4, 6, 7):
            raise BadFile(f"vertex {i + 1} has {len(line)} coordinates")
        out[i] = line[:3]
    return out


def _faces(text: bytes, points: _Array, rows: list[bytes]) -> Mesh:
    sizes = np.array([len(row.split()) for row in rows], np.int64)
    flat = integers(numbers(b"\n".join(rows)), "corners")
    if len(flat) != sizes.sum():
        raise BadFile("a face is malformed")
    if len(flat) and flat.min() < 0:
        flat = _absolute(text, flat, sizes)
    elif (flat == 0).any():
        raise BadFile("indices begin with 1, there is a 0")
    else:
        flat = flat - 1
    return mesh(points, flat, sizes)


def _absolute(text: bytes, flat: _Array, sizes: _Array) -> _Array:
    """Resolve negative indices, which count from the line that they stand in."""
    seen, faces = 0, []
    for word in re.findall(rb"^[ \t]*([vf])[ \t]", text, re.MULTILINE):
        if word == b"v":
            seen += 1
        else:
            faces.append(seen)
    before = np.repeat(np.array(faces, np.int64), sizes)
    return np.where(flat < 0, before + flat, flat - 1)
