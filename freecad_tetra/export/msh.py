# SPDX-License-Identifier: LGPL-2.1-or-later
"""Gmsh MSH in ascii, versions 4.1 and 2.2, with a physical group per B-rep face and solid.

Version 4.1 has the caller's groups of faces too; in 2.2 an element belongs to one group only.
"""

from __future__ import annotations

from typing import Any, BinaryIO

import numpy as np

from freecad_tetra.export.elements import Elements
from freecad_tetra.export.text import lines
from freecad_tetra.model import FloatArray

_TRIANGLE, _TET = {1: 2, 2: 9}, {1: 4, 2: 11}
_TET10 = [0, 1, 2, 3, 4, 5, 6, 7, 9, 8]  # gmsh swaps the last two middles


def write_tets(grid: Elements, stream: BinaryIO) -> None:
    """Write MSH 4.1; nodes and elements are numbered from 1, groups from 1 per dimension."""
    stream.write(b"$MeshFormat\n4.1 0 8\n$EndMeshFormat\n")
    _physical_names(grid, stream, _group_tags(grid))
    _entities(grid, stream)
    count = len(grid.points)
    first = next(iter(grid.solid_names)) + 1
    stream.write(f"$Nodes\n1 {count} 1 {count}\n3 {first} 0 {count}\n".encode())
    stream.write(lines("%d", np.arange(1, count + 1)))
    stream.write(lines("%.17g %.17g %.17g", grid.points))
    stream.write(b"$EndNodes\n")
    blocks = _blocks(grid)
    total = sum(len(rows) for *_, rows in blocks)
    stream.write(f"$Elements\n{len(blocks)} {total} 1 {total}\n".encode())
    tag = 1
    for dimension, group, kind, rows in blocks:
        stream.write(f"{dimension} {group} {kind} {len(rows)}\n".encode())
        numbered = np.column_stack([np.arange(tag, tag + len(rows)), rows + 1])
        stream.write(lines(" ".join(["%d"] * numbered.shape[1]), numbered))
        tag += len(rows)
    stream.write(b"$EndElements\n")


def write_tets_22(grid: Elements, stream: BinaryIO) -> None:
    """Write MSH 2.2, which older programs read."""
    stream.write(b"$MeshFormat\n2.2 0 8\n$EndMeshFormat\n")
    _physical_names(grid, stream, {})
    count = len(grid.points)
    stream.write(f"$Nodes\n{count}\n".encode())
    for start in range(0, count, 4096):
        block = grid.points[start : start + 4096].tolist()
        rows = [
            f"{start + i + 1} {x:.17g} {y:.17g} {z:.17g}\n" for i, (x, y, z) in enumerate(block)
        ]
        stream.write("".join(rows).encode())
    blocks = _blocks(grid)
    total = sum(len(rows) for *_, rows in blocks)
    stream.write(f"$EndNodes\n$Elements\n{total}\n".encode())
    tag = 1
    for _, group, kind, rows in blocks:
        head = np.zeros((len(rows), 5), np.int64) + np.array([0, kind, 2, group, group])
        head[:, 0] = np.arange(tag, tag + len(rows))
        table = np.hstack([head, rows + 1])
        stream.write(lines(" ".join(["%d"] * table.shape[1]), table))
        tag += len(rows)
    stream.write(b"$EndElements\n")


def _group_tags(grid: Elements) -> dict[str, int]:
    """Return the physical tag of each of the caller's groups, behind those of all faces."""
    first = max(grid.face_names, default=0) + 2
    return {name: first + i for i, name in enumerate(grid.face_groups)}


def _physical_names(grid: Elements, stream: BinaryIO, groups: dict[str, int]) -> None:
    rows = [f'2 {i + 1} "{name}"\n' for i, name in grid.face_names.items()]
    rows += [f'2 {tag} "{name}"\n' for name, tag in groups.items()]
    rows += [f'3 {i + 1} "{name}"\n' for i, name in grid.solid_names.items()]
    text = f"$PhysicalNames\n{len(rows)}\n{''.join(rows)}$EndPhysicalNames\n"
    stream.write(text.encode())


def _entities(grid: Elements, stream: BinaryIO) -> None:
    counts = f"0 0 {len(grid.face_names)} {len(grid.solid_names)}"
    rows = [f"$Entities\n{counts}\n"]
    tags = _group_tags(grid)
    for i in grid.face_names:
        box = _box(grid.points[grid.skin[grid.face == i]])
        groups = [i + 1, *(tags[name] for name, ids in grid.face_groups.items() if i in ids)]
        rows.append(f"{i + 1} {box} {len(groups)} {' '.join(map(str, groups))} 0\n")
    for i in grid.solid_names:
        box = _box(grid.points[grid.tets[grid.solid == i]])
        rows.append(f"{i + 1} {box} 1 {i + 1} 0\n")
    rows.append("$EndEntities\n")
    stream.write("".join(rows).encode())


def _box(points: FloatArray) -> str:
    flat = points.reshape(-1, 3)
    return " ".join(f"{v:.17g}" for v in (*flat.min(axis=0), *flat.max(axis=0)))


def _blocks(grid: Elements) -> list[tuple[int, int, int, Any]]:
    """Return (dimension, group from 1, gmsh type, rows of node ids from 0)."""
    tets = grid.tets if grid.order == 1 else grid.tets[:, _TET10]
    blocks = [(2, i + 1, _TRIANGLE[grid.order], grid.skin[grid.face == i]) for i in grid.face_names]
    blocks += [(3, i + 1, _TET[grid.order], tets[grid.solid == i]) for i in grid.solid_names]
    return blocks
