# SPDX-License-Identifier: LGPL-2.1-or-later
"""Made schema_1.FCStd, a document with the first property set; kept to show what that was.

Usage: freecadcmd make_schema_1.py   (needs the workbench in the Mod folder)
"""

from pathlib import Path
from typing import Any

import FreeCAD

from freecad_tetra.workbench import feature


def first_set(obj: Any, kind: str) -> None:
    """Give an object the properties of schema 1."""
    obj.Proxy = getattr(feature, kind).__new__(getattr(feature, kind))
    obj.addProperty("App::PropertyLink", "Source", "Base", "")
    obj.addProperty("App::PropertyFloat", "LinearDeflection", "Tessellation", "")
    obj.addProperty("App::PropertyEnumeration", "Method", "Method", "")
    obj.Source = obj.Document.Box
    obj.LinearDeflection = 0.25


doc = FreeCAD.newDocument("schema_1")
doc.addObject("Part::Box", "Box")
tets = doc.addObject("Part::FeaturePython", "Tetrahedra")
first_set(tets, "Tetrahedra")
tets.Method = ["chazelle-palios"]
tets.addProperty("App::PropertyString", "Direction", "Method", "")
tets.Direction = "z"
cells = doc.addObject("Part::FeaturePython", "Cells")
first_set(cells, "ConvexCells")
cells.Method = ["auto", "bajaj-dey"]
cells.Method = "bajaj-dey"
doc.Box.recompute()
doc.saveAs(str(Path(__file__).with_name("schema_1.FCStd")))
