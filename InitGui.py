# SPDX-License-Identifier: LGPL-2.1-or-later
"""FreeCAD runs this when its window starts; it names the workbench and loads nothing heavy."""

import FreeCAD
import FreeCADGui

from freecad_tetra.workbench import places


class TetraWorkbench(FreeCADGui.Workbench):
    """Convex cells and tetrahedra of solids."""

    def Initialize(self):
        """FreeCAD calls this when the workbench is opened for the first time."""
        from freecad_tetra.workbench import gui

        gui.fill(self)

    def Activated(self):
        """FreeCAD calls this whenever the workbench is opened."""
        from freecad_tetra.workbench import gui

        gui.watch(True)

    def Deactivated(self):
        """FreeCAD calls this whenever another workbench is opened."""
        from freecad_tetra.workbench import gui

        gui.watch(False)

    def ContextMenu(self, recipient):
        """FreeCAD calls this before a context menu of the tree or the 3D view."""
        from freecad_tetra.workbench import gui

        gui.fill_context_menu(self)

    def GetClassName(self):
        """FreeCAD asks for the C++ class behind."""
        return "Gui::PythonWorkbench"


# FreeCAD runs this file by exec: a class body does not see the names imported above.
TetraWorkbench.MenuText = "Tetra"
TetraWorkbench.ToolTip = FreeCAD.Qt.translate(
    "Workbench", "Exact convex cells and tetrahedra of solids"
)
TetraWorkbench.Icon = places.icon("tetra")

FreeCADGui.addIconPath(places.ICONS)
FreeCADGui.addLanguagePath(places.TRANSLATIONS)
FreeCADGui.updateLocale()
FreeCADGui.addPreferencePage(places.PREFERENCES, "Tetra")
FreeCADGui.addWorkbench(TetraWorkbench())
