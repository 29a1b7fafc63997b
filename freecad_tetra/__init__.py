# SPDX-License-Identifier: LGPL-2.1-or-later
"""Exact convex cells and face-to-face tetrahedra of CAD solids.

    from freecad_tetra import convex_cells, tetrahedralize, validate
    cells = convex_cells("bracket.step")

Any input will do: a path, a cadquery or build123d object, an OCP shape, a trimesh,
or ``(vertices, triangles)``.
"""

from freecad_tetra._version import __version__
from freecad_tetra.api import (
    as_solid,
    convex_cells,
    fem_mesh,
    place_guards,
    tetrahedralize,
    triangulate_polygon,
    validate,
    write,
)
from freecad_tetra.errors import (
    BadOption,
    Cancelled,
    Defect,
    InvalidPolygon,
    InvalidSolid,
    KernelMissing,
    MissingDependency,
    TetraError,
    UnreadableFile,
    UnsupportedFormat,
    VerificationFailed,
)
from freecad_tetra.model import Cell, ConvexCells, Labels, Report, Solid, Tet10Mesh, TetMesh

__all__ = [
    "BadOption",
    "Cancelled",
    "Cell",
    "ConvexCells",
    "Defect",
    "InvalidPolygon",
    "InvalidSolid",
    "KernelMissing",
    "Labels",
    "MissingDependency",
    "Report",
    "Solid",
    "Tet10Mesh",
    "TetMesh",
    "TetraError",
    "UnreadableFile",
    "UnsupportedFormat",
    "VerificationFailed",
    "__version__",
    "as_solid",
    "convex_cells",
    "fem_mesh",
    "place_guards",
    "tetrahedralize",
    "triangulate_polygon",
    "validate",
    "write",
]
