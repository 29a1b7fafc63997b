# SPDX-License-Identifier: LGPL-2.1-or-later
"""VTK XML unstructured grids (.vtu) in base64, for ParaView, meshio and pyvista."""

from __future__ import annotations

import base64
from typing import Any, BinaryIO

import numpy as np

from freecad_tetra.model import ConvexCells, TetMesh

_TETRA, _POLYHEDRON = 10, 42
_KINDS = {"f8": "Float64", "i8": "Int64", "i4": "Int32", "u1": "UInt8"}


def write_cells(cells: ConvexCells, stream: BinaryIO) -> None:
    """Write one polyhedral cell per convex cell, with cell data ``cell`` and ``solid``."""
    count = len(cells)
    used: list[Any] = []
    faces: list[Any] = []
    for k in range(count):
        loops = [cells.facet(f) for f in cells.cell_facets(k)]
        used.append(np.unique(np.concatenate(loops)))
        faces.append([len(loops)])
        for loop in loops:
            faces.append([len(loop)])
            faces.append(loop)
    flat_faces = np.concatenate(faces).astype(np.int64) if faces else np.zeros(0, np.int64)
    sizes = np.diff(cells.facet_offsets) + 1
    per_cell = np.add.reduceat(sizes, cells.cell_offsets[:-1]) + 1 if count else np.zeros(0, int)
    arrays = {
        "connectivity": np.concatenate(used).astype(np.int64) if used else np.zeros(0, np.int64),
        "offsets": np.cumsum([len(u) for u in used]).astype(np.int64),
        "types": np.full(count, _POLYHEDRON, np.uint8),
        "faces": flat_faces,
        "faceoffsets": np.cumsum(per_cell).astype(np.int64),
    }
    data = {"cell": np.arange(count, dtype=np.int64), "solid": cells.cell_solid.astype(np.int64)}
    _write(stream, cells.points, arrays, data, {"source": cells.point_source.astype(np.int64)})


def write_tets(mesh: TetMesh, stream: BinaryIO) -> None:
    """Write the tetrahedra with cell data ``solid`` and point data ``source`` (-1: Steiner)."""
    count = len(mesh)
    arrays = {
        "connectivity": mesh.tets.reshape(-1).astype(np.int64),
        "offsets": 4 * np.arange(1, count + 1, dtype=np.int64),
        "types": np.full(count, _TETRA, np.uint8),
    }
    data = {"solid": mesh.tet_solid.astype(np.int64)}
    _write(stream, mesh.points, arrays, data, {"source": mesh.point_source.astype(np.int64)})


def _write(
    stream: BinaryIO,
    points: Any,
    cells: dict[str, Any],
    cell_data: dict[str, Any],
    point_data: dict[str, Any],
) -> None:
    count = len(cells["types"])
    out = [
        '<?xml version="1.0"?>\n<VTKFile type="UnstructuredGrid" version="1.0" '
        'byte_order="LittleEndian" header_type="UInt64">\n<UnstructuredGrid>\n'
        f'<Piece NumberOfPoints="{len(points)}" NumberOfCells="{count}">\n',
        "<Points>\n" + _array("Points", points, 3) + "</Points>\n<Cells>\n",
        *(_array(name, values) for name, values in cells.items()),
        "</Cells>\n<CellData>\n",
        *(_array(name, values) for name, values in cell_data.items()),
        "</CellData>\n<PointData>\n",
        *(_array(name, values) for name, values in point_data.items()),
        "</PointData>\n</Piece>\n</UnstructuredGrid>\n</VTKFile>\n",
    ]
    for part in out:
        stream.write(part.encode("ascii"))


def _array(name: str, values: Any, components: int = 1) -> str:
    """Return one DataArray, base64 with a length header of 8 bytes."""
    little = np.ascontiguousarray(values, np.asarray(values).dtype.newbyteorder("<"))
    raw = little.tobytes()
    text = base64.b64encode(len(raw).to_bytes(8, "little") + raw).decode("ascii")
    kind = _KINDS[f"{little.dtype.kind}{little.dtype.itemsize}"]
    return (
        f'<DataArray type="{kind}" Name="{name}" NumberOfComponents="{components}" '
        f'format="binary">\n{text}\n</DataArray>\n'
    )
