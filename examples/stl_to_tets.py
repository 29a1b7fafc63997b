# SPDX-License-Identifier: LGPL-2.1-or-later
"""STL in, tetrahedra out: the triangles of the file are kept, and defects are told.

Usage: ``python stl_to_tets.py PART.stl OUT.vtu``   (also .msh .inp .mesh .vtk)
"""

import sys

from freecad_tetra import InvalidSolid, tetrahedralize, validate

part, out = sys.argv[1:]
found = validate(part)
for defect in found.defects:
    print(defect, file=sys.stderr)
try:
    mesh = tetrahedralize(found)
except InvalidSolid as error:
    sys.exit(f"{part}: {error}")
mesh.write(out)
steiner = int((mesh.point_source < 0).sum())
print(f"{len(mesh)} tetrahedra, {len(mesh.points)} points, {steiner} of them new")
print(f"volume {mesh.report.volume:.12g}, off by {mesh.report.volume_error:.1e}")
