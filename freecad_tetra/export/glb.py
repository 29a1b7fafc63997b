# SPDX-License-Identifier: LGPL-2.1-or-later
"""Binary glTF 2.0: one node per convex cell, each in a colour of its own."""

from __future__ import annotations

import json
import struct
from typing import Any, BinaryIO

import numpy as np

from freecad_tetra.model import ConvexCells, FloatArray

_FLOAT, _UINT, _ARRAY, _ELEMENTS = 5126, 5125, 34962, 34963
_COLOURS = 12
# CAD has z up, glTF has y up: a quarter turn about x at the root.
_Z_UP = [-(0.5**0.5), 0.0, 0.0, 0.5**0.5]


def write_cells(cells: ConvexCells, stream: BinaryIO) -> None:
    """Write flat-shaded cells; positions are float32 in the unit of the model."""
    positions, normals, starts = _corners(cells)
    indices, index_starts = _fans(cells, starts)
    blobs = [positions.tobytes(), normals.tobytes(), indices.tobytes()]
    scene = _scene(cells, positions, starts, index_starts, [len(b) for b in blobs])
    body = b"".join(blobs)
    text = json.dumps(scene, separators=(",", ":")).encode("ascii")
    text += b" " * (-len(text) % 4)
    total = 12 + 8 + len(text) + 8 + len(body)
    stream.write(struct.pack("<4sII", b"glTF", 2, total))
    stream.write(struct.pack("<I4s", len(text), b"JSON") + text)
    stream.write(struct.pack("<I4s", len(body), b"BIN\0") + body)


def _corners(cells: ConvexCells) -> tuple[Any, Any, Any]:
    """Return corner positions and normals (c, 3) float32, and the first corner of each cell."""
    positions = cells.points[cells.facet_vertices]
    sizes = np.diff(cells.facet_offsets)
    first = np.repeat(cells.facet_offsets[:-1], sizes)
    following = np.arange(len(positions)) + 1
    ends = np.repeat(cells.facet_offsets[1:], sizes)
    following = np.where(following == ends, first, following)
    origin = positions[first]
    parts = np.cross(positions - origin, positions[following] - origin)
    normals: FloatArray = np.add.reduceat(parts, cells.facet_offsets[:-1]) if len(sizes) else parts
    size = np.linalg.norm(normals, axis=1, keepdims=True)
    normals = normals / np.where(size > 0, size, 1.0)
    starts = cells.facet_offsets[cells.cell_offsets]
    return positions.astype("<f4"), np.repeat(normals, sizes, axis=0).astype("<f4"), starts


def _fans(cells: ConvexCells, starts: Any) -> tuple[Any, Any]:
    """Return triangle indices relative to each cell's first corner, and where cells begin."""
    sizes = np.diff(cells.facet_offsets) - 2
    facet = np.repeat(np.arange(len(sizes)), sizes)
    step = np.arange(len(facet)) - np.repeat(np.cumsum(sizes) - sizes, sizes)
    cell = np.repeat(np.arange(len(cells)), np.diff(cells.cell_offsets))[facet]
    first = cells.facet_offsets[:-1][facet] - starts[cell]
    indices = np.stack([first, first + step + 1, first + step + 2], axis=1)
    before = np.concatenate([[0], np.cumsum(sizes)])[cells.cell_offsets] * 3
    return indices.astype("<u4"), before


def _scene(
    cells: ConvexCells, positions: Any, starts: Any, index_starts: Any, sizes: list[int]
) -> dict[str, Any]:
    count = len(cells)
    accessors: list[dict[str, Any]] = []
    meshes = []
    for k in range(count):
        a, b = int(starts[k]), int(starts[k + 1])
        i, j = int(index_starts[k]), int(index_starts[k + 1])
        low, high = positions[a:b].min(axis=0), positions[a:b].max(axis=0)
        place = {"componentType": _FLOAT, "count": b - a, "type": "VEC3", "byteOffset": 12 * a}
        bounds = {"min": low.tolist(), "max": high.tolist()}
        accessors.append({"bufferView": 0, **place, **bounds})
        accessors.append({"bufferView": 1, **place})
        accessors.append({"bufferView": 2, "componentType": _UINT, "count": j - i,
                          "type": "SCALAR", "byteOffset": 4 * i})  # fmt: skip
        attributes = {"POSITION": 3 * k, "NORMAL": 3 * k + 1}
        primitive = {"attributes": attributes, "indices": 3 * k + 2, "material": k % _COLOURS}
        meshes.append({"name": f"cell_{k}", "primitives": [primitive]})
    offsets = [0, sizes[0], sizes[0] + sizes[1]]
    views = [
        {"buffer": 0, "byteOffset": o, "byteLength": s, "target": _ELEMENTS if n == 2 else _ARRAY}
        for n, (o, s) in enumerate(zip(offsets, sizes))
    ]
    nodes: list[dict[str, Any]] = [
        {"name": f"cell_{k}", "mesh": k, "extras": {"solid": int(cells.cell_solid[k])}}
        for k in range(count)
    ]
    nodes.append({"name": "cells", "rotation": _Z_UP, "children": list(range(count))})
    return {
        "asset": {"version": "2.0", "generator": "freecad_tetra"},
        "scene": 0,
        "scenes": [{"nodes": [count]}],
        "nodes": nodes,
        "meshes": meshes,
        "materials": [_material(i) for i in range(_COLOURS)],
        "accessors": accessors,
        "bufferViews": views,
        "buffers": [{"byteLength": sum(sizes)}],
    }


def _material(index: int) -> dict[str, Any]:
    """Return one of the colours, spread over the hues by the golden ratio."""
    hue = (index * 0.6180339887498949) % 1.0
    rgb = [0.25 + 0.65 * max(0.0, min(1.0, abs((hue * 6 + k) % 6 - 3) - 1)) for k in (0, 4, 2)]
    colour = {"baseColorFactor": [*rgb, 1.0], "metallicFactor": 0.1, "roughnessFactor": 0.7}
    return {"name": f"colour_{index}", "pbrMetallicRoughness": colour}
