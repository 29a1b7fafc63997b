# SPDX-License-Identifier: LGPL-2.1-or-later
"""The workbench is there, its commands are on when they can work, and say why not otherwise."""

from __future__ import annotations

from typing import Any
from unittest import mock

import FreeCAD
import FreeCADGui
import Part
from window import (
    QtCore,
    QtGui,
    QtWidgets,
    WindowTest,
    pump,
    report_view,
    select,
    status,
    take_picture,
    tip,
    wait_for,
)

from freecad_tetra.workbench import kernel_path

COMMANDS = [
    "Tetra_Tetrahedralize",
    "Tetra_ConvexCells",
    "Tetra_ToFemMesh",
    "Tetra_CheckSolid",
    "Tetra_Explode",
    "Tetra_Report",
]
ON_SOLIDS = COMMANDS[:4]


class Commands(WindowTest):
    def active(self) -> list[str]:
        return [name for name in COMMANDS if FreeCADGui.Command.get(name).isActive()]

    def test_workbench_is_listed_with_its_icon(self) -> None:
        self.assertEqual(FreeCADGui.activeWorkbench().name(), "TetraWorkbench")
        workbench = FreeCADGui.listWorkbenches()["TetraWorkbench"]
        self.assertTrue(workbench.Icon.endswith("tetra.svg"))

    def test_every_command_has_icon_text_and_tip(self) -> None:
        for name in COMMANDS:
            action = FreeCADGui.Command.get(name).getAction()[0]
            self.assertFalse(action.icon().isNull(), name)
            self.assertTrue(action.text(), name)
            self.assertIn(name, action.toolTip())

    def test_tool_bar_and_menu_hold_all_commands(self) -> None:
        workbench = FreeCADGui.activeWorkbench()
        items = workbench.getToolbarItems()
        self.assertEqual(items["Tetra"], COMMANDS)
        self.assertIn("Tetra", [m.strip("&") for m in workbench.listMenus()])

    def test_nothing_selected(self) -> None:
        select()
        self.assertEqual(self.active(), [])
        for name in ON_SOLIDS:
            self.assertIn("Select a solid", tip(name))
        for name in COMMANDS[4:]:
            self.assertIn("Select an object made by", tip(name))

    def test_a_solid_is_selected(self) -> None:
        box = self.add(Part.makeBox(10, 10, 10))
        select(box)
        self.assertEqual(self.active(), ON_SOLIDS)
        self.assertIn("Fills the selected solid", tip("Tetra_Tetrahedralize"))
        take_picture("commands")

    def trees(self) -> list[Any]:
        """Return the trees that are seen; when none is, bring those to the front that are hidden.

        The Tasks tab may hide the document's, or the window may have closed the panel of both.
        """
        trees = FreeCADGui.getMainWindow().findChildren(QtWidgets.QTreeWidget)
        seen = [tree for tree in trees if tree.isVisible()]
        for tree in trees if not seen else []:
            inner, outer = tree, tree.parentWidget()
            while outer is not None:
                if isinstance(outer, QtWidgets.QStackedWidget):
                    outer.setCurrentWidget(inner)
                if isinstance(outer, QtWidgets.QTabWidget):
                    outer.setCurrentIndex(max(0, outer.indexOf(self.page_of(outer, tree))))
                if isinstance(outer, QtWidgets.QDockWidget):
                    outer.show()
                    outer.raise_()
                inner, outer = outer, outer.parentWidget()
        return seen

    def page_of(self, tabs: Any, widget: Any) -> Any:
        """Return the page of a tab widget that holds a widget."""
        pages = (tabs.widget(i) for i in range(tabs.count()))
        return next((page for page in pages if page.isAncestorOf(widget)), None)

    def context_menu(self) -> list[str]:
        """Return what a click with the right button on the object in the tree offers for it."""
        wait_for(lambda: self.trees(), "the tree of the document", 10)
        tree = max(self.trees(), key=lambda t: t.height())
        item = tree.findItems("Part", QtCore.Qt.MatchContains | QtCore.Qt.MatchRecursive)[0]
        place = tree.visualItemRect(item).center()
        found: list[str] = []

        def look() -> None:
            menu = QtWidgets.QApplication.activePopupWidget()
            try:
                for own in menu.findChildren(QtWidgets.QMenu):
                    if own.title() == "Tetra":
                        found.extend(action.text() for action in own.actions())
            finally:
                menu.close()

        QtCore.QTimer.singleShot(500, look)
        event = QtGui.QContextMenuEvent(
            QtGui.QContextMenuEvent.Mouse, place, tree.viewport().mapToGlobal(place)
        )
        QtWidgets.QApplication.sendEvent(tree.viewport(), event)
        pump(0.7)
        return found

    def test_context_menu_offers_what_can_work(self) -> None:
        select(self.add(Part.makeBox(1, 1, 1)))
        texts = ["Tetrahedralize", "Convex cells", "To FEM mesh", "Check solid"]
        self.assertEqual(self.context_menu(), texts)

    def refused(self, obj: object, word: str) -> None:
        """Nothing happens, the status bar says why, the document is as it was."""
        undo, names, told = self.doc.UndoCount, self.names(), report_view()
        select(obj)
        self.assertEqual(self.active(), [])
        self.assertIn(word, status())
        for name in COMMANDS:
            FreeCADGui.runCommand(name)
        pump(0.2)
        for name in ON_SOLIDS:
            self.assertIn(word, tip(name))
        self.assertFalse(FreeCADGui.Control.activeDialog())
        self.assertEqual((self.doc.UndoCount, self.names()), (undo, names))
        self.assertEqual(report_view(), told)

    def test_a_shell_is_selected(self) -> None:
        self.refused(self.add(Part.makeBox(10, 10, 10).Shells[0]), "shell")

    def test_a_wire_is_selected(self) -> None:
        self.refused(self.add(Part.makePolygon([FreeCAD.Vector(*p) for p in
                     ((0, 0, 0), (9, 0, 0), (0, 9, 0))])), "no volume")  # fmt: skip

    def test_an_object_without_shape_is_selected(self) -> None:
        self.refused(self.doc.addObject("App::DocumentObjectGroup", "Group"), "no shape")

    def test_a_mesh_is_selected(self) -> None:
        import Mesh

        mesh = self.doc.addObject("Mesh::Feature", "Mesh")
        mesh.Mesh = Mesh.createBox(1, 1, 1)
        self.refused(mesh, "mesh")

    def test_two_solids_are_selected(self) -> None:
        one, two = self.add(Part.makeBox(1, 1, 1)), self.add(Part.makeBox(2, 2, 2))
        select(one, two)
        self.assertEqual(self.active(), [])
        self.assertIn("one object only", tip("Tetra_ConvexCells"))

    def test_missing_kernel_says_what_to_run(self) -> None:
        advice = "The compiled kernel is missing. Run `make install-freecad`."
        select(self.add(Part.makeBox(1, 1, 1)))
        with mock.patch.object(kernel_path, "problem", return_value=advice):
            self.assertEqual(self.active(), [])
            self.assertEqual({tip(name) for name in ON_SOLIDS}, {advice})
            FreeCADGui.runCommand("Tetra_ConvexCells")
            self.assertFalse(FreeCADGui.Control.activeDialog())
        self.assertEqual(self.active(), ON_SOLIDS)
