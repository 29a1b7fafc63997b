# SPDX-License-Identifier: LGPL-2.1-or-later
"""VTK XML unstructured grids (.vtu) in base64, for ParaView, meshio and pyvista."""

from __future__ import annotations

import base64
from typing import Any, BinaryIO

import numpy as np

from freecad_tetra.export.elements import Elements
from freecad_tetra.model import ConvexCells

_POLYHEDRON = 42
_TETRA, _TRIANGLE = {1: 10, 2: 24}, {1: 5, 2: 22}
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


def write_tets(grid: Elements, stream: BinaryIO) -> None:
    """Write tetrahedra, then the triangles of the skin.

    Cell data: ``solid`` (-1 on triangles) and ``face`` (-1 on tetrahedra); point data:
    ``source``, the input vertex or -1.
    """
    sizes = [grid.tets.shape[1]] * len(grid.tets) + [grid.skin.shape[1]] * len(grid.skin)
    kinds = [_TETRA[grid.order]] * len(grid.tets) + [_TRIANGLE[grid.order]] * len(grid.skin)
    arrays = {
        "connectivity": np.concatenate([grid.tets.reshape(-1), grid.skin.reshape(-1)]),
        "offsets": np.cumsum(np.array(sizes, np.int64)),
        "types": np.array(kinds, np.uint8),
    }
    data = {
        "solid": np.concatenate([grid.solid, np.full(len(grid.skin), -1)]),
        "face": np.concatenate([np.full(len(grid.tets), -1), grid.face]),
    }
    _write(stream, grid.points, arrays, data, {"source": grid.source})


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
    # meshio reads a column instead of a row when told about a single component.
    width = f'NumberOfComponents="{components}" ' if components > 1 else ""
    return f'<DataArray type="{kind}" Name="{name}" {width}format="binary">\n{text}\n</DataArray>\n'
