# SPDX-License-Identifier: LGPL-2.1-or-later
"""Takes the pictures of docs/freecad.md: `make pictures`, which runs this in FreeCAD."""

from __future__ import annotations

from typing import Any

import FreeCAD
import FreeCADGui
from gui_preferences import in_dialog
from window import (
    QtWidgets,
    WindowTest,
    dented_through,
    pump,
    read,
    select,
    take_picture,
    wait_for,
    widen_panel,
    widget,
)


class Pictures(WindowTest):
    """The story of the document, one picture for each step."""

    def setUp(self) -> None:
        view = FreeCAD.ParamGet("User parameter:BaseApp/Preferences/View")
        view.SetBool("Gradient", False)
        view.SetUnsigned("BackgroundColor", 0xF4F6F8FF)
        super().setUp()
        self.window = FreeCADGui.getMainWindow()
        self.window.showNormal()
        self.window.resize(1180, 760)
        self.window.move(0, 0)
        for dock in self.window.findChildren(QtWidgets.QDockWidget):
            if dock.windowTitle() in ("Report view", "Python console"):
                dock.hide()
        pump(0.5)

    def picture(self, name: str) -> None:
        widen_panel()
        FreeCADGui.SendMsgToActiveView("ViewFit")
        take_picture(f"freecad-{name}", self.window)

    def run_panel(self, command: str, obj: Any) -> None:
        select(obj)
        FreeCADGui.runCommand(command)
        pump(0.3)
        if command not in ("Tetra_Explode", "Tetra_Report"):
            wait_for(lambda: "counting" not in self.labels(), "the facts")

    def labels(self) -> str:
        form = widget("TetraPanel")
        return " ".join(label.text() for label in form.findChildren(QtWidgets.QLabel))

    def compute(self) -> None:
        widget("TetraCompute").click()
        wait_for(lambda: widget("TetraMessage").text(), "the pieces")
        pump(0.3)

    def close(self) -> None:
        FreeCADGui.Control.closeDialog()
        pump(0.3)

    def test_story(self) -> None:
        bracket = self.add(read("resources/parts/bracket.step"), "Bracket")
        select(bracket)
        self.picture("start")
        self.run_panel("Tetra_ConvexCells", bracket)
        FreeCADGui.Selection.clearSelection()
        self.picture("panel")
        self.compute()
        self.picture("cells")
        self.close()
        cells = self.doc.Objects[-1]
        self.run_panel("Tetra_Explode", cells)
        widget("TetraFactor").setValue(60)
        self.picture("explode")
        self.close()
        cells.Explode = 0.0
        cells.ViewObject.Visibility = False
        self.run_panel("Tetra_Tetrahedralize", bracket)
        self.compute()
        self.close()
        self.run_panel("Tetra_Report", self.doc.Objects[-1])
        self.picture("report")
        self.close()
        self.doc.Objects[-1].ViewObject.Visibility = False
        self.run_panel("Tetra_ToFemMesh", bracket)
        self.compute()
        self.picture("fem")

    def test_check(self) -> None:
        self.run_check(self.add(dented_through(), "Dented"))
        self.picture("check")

    def run_check(self, part: Any) -> None:
        select(part)
        FreeCADGui.runCommand("Tetra_CheckSolid")
        wait_for(lambda: widget("TetraDefects", QtWidgets.QListWidget).count(), "the defects")

    def test_preferences(self) -> None:
        in_dialog(lambda dialog: take_picture("freecad-preferences", dialog))
