# SPDX-License-Identifier: LGPL-2.1-or-later
"""OFF: a count line, vertices, and polygons that may carry colours."""

from __future__ import annotations

import re

import numpy as np

from freecad_tetra.errors import UnsupportedFormat
from freecad_tetra.io.polygons import BadFile, Mesh, mesh
from freecad_tetra.io.text import integers, numbers, whole

_COMMENT = re.compile(rb"#[^\n]*")


def parse(data: bytes) -> Mesh:
    """Read ascii OFF, COFF or NOFF (colours and normals are skipped)."""
    if b"\0" in data:
        if data.lstrip()[:16].split()[1:2] == [b"BINARY"]:
            raise UnsupportedFormat("binary OFF is not handled", "save it as ascii OFF")
        raise BadFile("it holds binary data")
    clean = _COMMENT.sub(b"", data.replace(b"\r\n", b"\n").replace(b"\r", b"\n"))
    head = re.match(rb"\s*(C?N?OFF)\b", clean)
    if head is None:
        raise BadFile("it does not begin with OFF")
    counts = re.match(rb"\s*(\S+)\s+(\S+)(?:[ \t]+\S+)?[ \t]*(?:\n|\Z)", clean[head.end() :])
    if counts is None:
        raise BadFile("the counts are missing")
    vertex_count, face_count = (whole(w, "a count") for w in counts.groups())
    body = clean[head.end() + counts.end() :]
    if vertex_count * 6 + face_count * 8 > len(body) + 8:
        raise BadFile(f"it is too short for {vertex_count} vertices and {face_count} faces")
    if head.group(1) == b"OFF":
        fast = _plain(body, vertex_count, face_count)
        if fast is not None:
            return fast
    return _by_line(body, vertex_count, face_count)


def _plain(body: bytes, vertex_count: int, face_count: int) -> Mesh | None:
    """Read a file of bare triangles at once; None when it is something else."""
    values = numbers(body)
    if len(values) != 3 * vertex_count + 4 * face_count:
        return None
    faces = values[3 * vertex_count :].reshape(-1, 4)
    if not (faces[:, 0] == 3).all():
        return None
    return mesh(values[: 3 * vertex_count].reshape(-1, 3), integers(faces[:, 1:], "corners"))


def _by_line(body: bytes, vertex_count: int, face_count: int) -> Mesh:
    rows = [row for row in body.split(b"\n") if row.strip()]
    if len(rows) < vertex_count + face_count:
        raise BadFile(f"{vertex_count} vertices and {face_count} faces need as many lines")
    if len(rows) > vertex_count + face_count:
        raise BadFile("there are more lines than the counts say")
    points = np.zeros((vertex_count, 3))
    for i, row in enumerate(rows[:vertex_count]):
        values = numbers(row)
        if len(values) < 3:
            raise BadFile(f"vertex {i} has fewer than three coordinates")
        points[i] = values[:3]
    corners: list[int] = []
    sizes: list[int] = []
    for i, row in enumerate(rows[vertex_count:]):
        words = row.split()
        size = whole(words[0], "a corner count")
        if len(words) < size + 1:
            raise BadFile(f"face {i} has fewer corners than it says")
        corners.extend(whole(w, "a corner") for w in words[1 : size + 1])
        sizes.append(size)
    return mesh(points, corners, sizes)
