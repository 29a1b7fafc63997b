# SPDX-License-Identifier: LGPL-2.1-or-later
"""FreeCAD runs this when its window starts; it names the workbench, which has no commands yet."""

import FreeCADGui


class TetraWorkbench(FreeCADGui.Workbench):
    """Convex cells and tetrahedra of solids."""

    MenuText = "Tetra"
    ToolTip = "Exact convex cells and tetrahedra of solids"

    def Initialize(self):
        """Nothing to add: commands come with the workbench package."""

    def GetClassName(self):
        return "Gui::PythonWorkbench"


FreeCADGui.addWorkbench(TetraWorkbench())
