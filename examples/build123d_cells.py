# SPDX-License-Identifier: LGPL-2.1-or-later
"""build123d: labelled parts of an assembly become labelled convex cells.

Usage: ``python build123d_cells.py [FOLDER]``
"""

import sys
from pathlib import Path

from build123d import Box, BuildPart, Compound, Cylinder, Locations, Mode, Pos, export_step

from freecad_tetra import convex_cells

folder = Path(sys.argv[1] if len(sys.argv) > 1 else ".")

with BuildPart() as block:
    Box(40, 30, 20)
    with Locations((0, 0, 10)):
        Box(20, 10, 20, mode=Mode.SUBTRACT)
block.part.label = "block"
pin = Pos(60, 0, 0) * Cylinder(5, 30)
pin.label = "pin"
assembly = Compound(label="assembly", children=[block.part, pin])

cells = convex_cells(assembly)
print(f"{len(cells)} convex cells of {', '.join(cells.labels.solids)}")

solids = cells.to_build123d()
for solid in solids.children:
    print(f"{solid.label:16s} {solid.volume:12.4f} mm3")
export_step(solids, str(folder / "cells.step"))
