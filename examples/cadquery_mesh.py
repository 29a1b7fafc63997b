# SPDX-License-Identifier: LGPL-2.1-or-later
"""cadquery: a plate with a hole becomes a mesh whose tagged faces are groups, for gmsh or a solver.

Usage: ``python cadquery_mesh.py [FOLDER]``
"""

import sys
from pathlib import Path

import cadquery as cq

import freecad_tetra.cq  # noqa: F401  adds tetrahedralize() and convexCells() to cadquery

folder = Path(sys.argv[1] if len(sys.argv) > 1 else ".")
plate = cq.Workplane().box(60, 40, 10).faces("<X").tag("clamped").end()
plate = plate.faces(">Z").workplane().hole(12)

mesh = plate.tetrahedralize()
mesh.write(folder / "plate.msh")
mesh.write(folder / "plate.inp")
print(f"{len(mesh)} tetrahedra, {mesh.report.volume:.6f} mm3, groups {list(mesh.labels.faces)}")

# Cells come back as cadquery solids that share their faces; chain on as usual.
cells = plate.convexCells()
print(f"{cells.size()} convex cells, {sum(c.Volume() for c in cells.vals()):.6f} mm3")
cq.exporters.export(cells, str(folder / "cells.step"))
