# SPDX-License-Identifier: LGPL-2.1-or-later
"""FreeCAD macro: the selected solid, or a sample, as a compound of convex cells in a new object.

Usage: as a macro, or ``freecadcmd freecad_macro.py``. The command freecad-tetra does the work in a
process of its own; set FREECAD_TETRA to its path when it is not found.
"""

import os
import shutil
import subprocess
import tempfile
from pathlib import Path

import FreeCAD
import Part

command = os.environ.get("FREECAD_TETRA") or shutil.which("freecad-tetra") or "freecad-tetra"
document = FreeCAD.ActiveDocument or FreeCAD.newDocument("Cells")
chosen = FreeCAD.Gui.Selection.getSelection() if FreeCAD.GuiUp else []
if chosen:
    shape = chosen[0].Shape
else:
    shape = Part.makeBox(40, 30, 20).cut(Part.makeBox(20, 10, 20, FreeCAD.Vector(10, 10, 10)))

with tempfile.TemporaryDirectory() as folder:
    part, cells = Path(folder) / "part.brep", Path(folder) / "cells.brep"
    shape.exportBrep(str(part))
    done = subprocess.run([command, "cells", part, "-o", cells], capture_output=True, text=True)
    if done.returncode:
        raise RuntimeError(done.stderr)
    compound = Part.read(str(cells))

made = document.addObject("Part::Feature", "ConvexCells")
made.Shape = compound
document.recompute()
FreeCAD.Console.PrintMessage(done.stdout)
FreeCAD.Console.PrintMessage(f"{len(compound.Solids)} solids, {compound.Volume:.9g} mm3\n")
