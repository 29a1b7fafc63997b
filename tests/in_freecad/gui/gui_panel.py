# SPDX-License-Identifier: LGPL-2.1-or-later
"""The task panel makes objects, shows how far it is, and leaves no trace when it is stopped."""

from __future__ import annotations

import os
import signal
import time
from typing import Any
from unittest import mock

import FreeCAD
import FreeCADGui
import Part
from window import (
    QtWidgets,
    WindowTest,
    children_at_work,
    dented_through,
    pump,
    read,
    report_view,
    select,
    status,
    take_picture,
    wait_for,
    widen_panel,
    widget,
)

from freecad_tetra.errors import TetraError
from freecad_tetra.workbench import feature, write_back


def message() -> str:
    return widget("TetraMessage").text()


def open_panel(command: str, obj: Any) -> None:
    select(obj)
    FreeCADGui.runCommand(command)
    pump(0.2)


def compute() -> None:
    """Press Compute and wait for the end."""
    widget("TetraCompute").click()
    wait_for(lambda: widget("TetraCompute").isEnabled(), "the end of the work")
    pump(0.1)


class Panel(WindowTest):
    def long_work(self) -> Any:
        """Open the panel on a solid whose cells take long, and start."""
        torus = self.add(Part.makeTorus(10, 3))
        open_panel("Tetra_ConvexCells", torus)
        widget("AngularDeflection").setProperty("rawValue", 5.0)
        widget("TetraCompute").click()
        wait_for(lambda: self.stages()[-1:] == ["cutting notches"], "the cutting of notches", 120)
        pump(0.5)
        wait_for(lambda: len(children_at_work()) == 1, "the end of counting facts", 60)
        return torus

    def stages(self) -> list[str]:
        bars = widget("TetraPanel").findChildren(QtWidgets.QProgressBar)
        return [bar.objectName() for bar in bars]

    def untouched(self, before: tuple[Any, ...]) -> None:
        self.assertEqual((self.doc.UndoCount, self.names(), self.doc.RedoCount), before)

    def state(self) -> tuple[Any, ...]:
        return (self.doc.UndoCount, self.names(), self.doc.RedoCount)

    def make(self, command: str, shape: Any) -> Any:
        """Run a command to its end and return the object that it made."""
        part = self.add(shape)
        open_panel(command, part)
        compute()
        made = [obj for obj in self.doc.Objects if obj is not part]
        self.assertEqual(len(made), 1, message())
        return made[0]

    def test_tetrahedra_of_a_bracket(self) -> None:
        shape = read("resources/parts/bracket.step")
        made = self.make("Tetra_Tetrahedralize", shape)
        pieces = feature.pieces_of(made)
        self.assertEqual(made.Pieces, len(pieces))
        self.assertEqual(len(made.Shape.Solids), len(pieces))
        self.assertTrue(made.Shape.isValid())
        self.assertLess(abs(made.Shape.Volume / pieces.report.volume - 1), 1e-6)
        self.assertIn(str(len(pieces)), message())
        widen_panel()
        take_picture("tetrahedra")

    def test_cells_of_a_bracket(self) -> None:
        made = self.make("Tetra_ConvexCells", read("resources/parts/bracket.step"))
        self.assertEqual(len(made.Shape.Solids), made.Pieces)
        self.assertGreater(made.Pieces, 10)
        self.assertFalse(made.Source.ViewObject.Visibility)
        self.assertEqual(made.ViewObject.DisplayMode, "Pieces")
        widen_panel()
        take_picture("cells")

    def test_facts_are_told_before_the_work(self) -> None:
        part = self.add(read("resources/parts/bracket.step"))
        before = self.state()
        open_panel("Tetra_Tetrahedralize", part)
        form = widget("TetraPanel")
        labels = lambda: [w.text() for w in form.findChildren(QtWidgets.QLabel)]  # noqa: E731
        wait_for(lambda: "valid" in labels(), "the facts")
        shown = labels()
        self.assertEqual(shown[shown.index("Notches") + 1], "88")
        self.assertEqual(shown[shown.index("Triangles") + 1], "332")
        self.assertIn("Expected time", shown)
        widen_panel()
        take_picture("facts")
        self.untouched(before)

    def test_facts_follow_the_choices(self) -> None:
        open_panel("Tetra_Tetrahedralize", self.add(Part.makeSphere(5)))
        form = widget("TetraPanel")

        def triangles() -> int:
            shown = [w.text() for w in form.findChildren(QtWidgets.QLabel)]
            if "valid" not in shown:
                return 0
            return int(shown[shown.index("Triangles") + 1].replace("\u2009", ""))

        wait_for(triangles, "the facts")
        before = triangles()
        widget("AngularDeflection").setProperty("rawValue", 6.0)
        wait_for(lambda: triangles() > 2 * before, "the facts of a finer surface")

    def test_one_step_to_undo_and_to_redo(self) -> None:
        made = self.make("Tetra_ConvexCells", Part.makeBox(3, 3, 3).cut(Part.makeBox(1, 1, 1)))
        name, count, source = made.Name, made.Pieces, made.Source
        self.assertEqual(self.doc.UndoNames[0], "Convex cells")
        FreeCADGui.Control.closeDialog()
        steps = self.doc.UndoCount
        FreeCADGui.runCommand("Std_Undo")
        pump(0.2)
        self.assertEqual(self.names(), [source.Name])
        self.assertTrue(source.ViewObject.Visibility)
        self.assertEqual(self.doc.UndoCount, steps - 1)
        FreeCADGui.runCommand("Std_Redo")
        pump(0.2)
        again = self.doc.getObject(name)
        self.assertEqual(len(again.Shape.Solids), count)
        self.assertEqual(len(feature.pieces_of(again)), count)
        take_picture("redone")

    def test_cancel_within_half_a_second(self) -> None:
        before_part = self.state()
        self.assertEqual(before_part[1], [])
        self.long_work()
        before = self.state()
        self.assertEqual(len(children_at_work()), 1)
        take_picture("at_work")
        start = time.monotonic()
        widget("TetraCancel").click()
        wait_for(lambda: not children_at_work(), "the end of the child", 5)
        seconds = time.monotonic() - start
        self.assertLess(seconds, 0.5)
        self.assertIn("Cancelled", message())
        self.assertTrue(widget("TetraCompute").isEnabled())
        self.untouched(before)

    def test_panel_that_freecad_closes_ends_the_work(self) -> None:
        self.long_work()
        before = self.state()
        FreeCADGui.Control.closeDialog()
        pump(0.1)
        wait_for(lambda: not children_at_work(), "the end of the child", 2)
        self.untouched(before)

    def test_close_button_ends_the_work(self) -> None:
        self.long_work()
        before = self.state()
        boxes = FreeCADGui.getMainWindow().findChildren(QtWidgets.QDialogButtonBox)
        buttons = [box.button(QtWidgets.QDialogButtonBox.Close) for box in boxes]
        next(button for button in buttons if button and button.isVisible()).click()
        wait_for(lambda: not children_at_work(), "the end of the child", 2)
        self.assertFalse(FreeCADGui.Control.activeDialog())
        self.untouched(before)

    def test_window_lives_while_the_work_goes_on(self) -> None:
        self.long_work()
        longest, last = 0.0, time.monotonic()
        end = last + 2.0
        while last < end:
            QtWidgets.QApplication.processEvents()
            now = time.monotonic()
            longest, last = max(longest, now - last), now
        self.assertLess(longest, 1.0)  # blocked, it would be many
        self.assertEqual(len(children_at_work()), 1)

    def test_killed_child_leaves_freecad_and_the_document_whole(self) -> None:
        torus = self.long_work()
        before = self.state()
        os.kill(children_at_work()[0], signal.SIGKILL)
        wait_for(lambda: widget("TetraCompute").isEnabled(), "the news", 10)
        self.assertIn("killed", message())
        self.assertIn("killed", status())
        self.untouched(before)
        take_picture("killed")
        widget("AngularDeflection").setProperty("rawValue", 60.0)
        compute()
        self.assertEqual(len(self.doc.Objects), 2, message())
        self.assertEqual(self.doc.Objects[1].Source.Name, torus.Name)

    def test_solid_deleted_while_the_work_goes_on(self) -> None:
        torus = self.long_work()
        self.doc.removeObject(torus.Name)
        widget("TetraCancel").click()
        pump(0.2)
        self.assertEqual(self.names(), [])

    def test_document_closed_while_the_work_goes_on(self) -> None:
        self.long_work()
        FreeCAD.closeDocument(self.doc.Name)
        pump(0.5)
        if FreeCADGui.Control.activeDialog():
            widget("TetraCancel").click()
            pump(0.2)
        self.assertEqual(children_at_work(), [])

    def test_shape_that_cannot_be_made_leaves_the_document_whole(self) -> None:
        part = self.add(Part.makeBox(2, 2, 2))
        before = self.state()
        open_panel("Tetra_ConvexCells", part)
        error = TetraError("there is no room", "try less")
        with mock.patch.object(write_back, "shape_of_pieces", side_effect=error):
            compute()
        self.assertIn("there is no room", message().lower())
        self.untouched(before)
        self.told = len(report_view())  # FreeCAD itself reports a failed recompute in its way

    def test_undone_object_is_made_anew(self) -> None:
        made = self.make("Tetra_ConvexCells", Part.makeBox(2, 2, 2))
        source = made.Source
        self.doc.undo()
        self.assertEqual(self.names(), [source.Name])
        compute()
        self.assertEqual(len(self.doc.Objects), 2, message())
        self.assertEqual(self.doc.Objects[1].Pieces, 1)

    def test_computing_again_changes_the_same_object(self) -> None:
        made = self.make("Tetra_ConvexCells", Part.makeCylinder(5, 5))
        self.assertEqual(made.Pieces, 1)
        steps, skin = self.doc.UndoCount, len(made.Shape.Faces)
        widget("AngularDeflection").setProperty("rawValue", 5.0)
        compute()
        self.assertEqual(len(self.doc.Objects), 2)
        self.assertGreater(len(made.Shape.Faces), skin)
        self.assertEqual(self.doc.UndoCount, steps + 1)

    def test_double_click_opens_the_panel_of_an_object(self) -> None:
        made = self.make("Tetra_Tetrahedralize", Part.makeBox(1, 1, 1))
        FreeCADGui.Control.closeDialog()
        FreeCADGui.ActiveDocument.setEdit(made.Name)
        pump(0.3)
        box = widget("Direction", QtWidgets.QComboBox)
        box.setCurrentIndex(box.findData("x"))
        compute()
        self.assertEqual(made.Direction, "x")
        self.assertEqual(len(self.doc.Objects), 2)
        FreeCADGui.ActiveDocument.resetEdit()
        pump(0.2)
        self.assertFalse(FreeCADGui.Control.activeDialog())


class BadSolids(WindowTest):
    """Solids by type that are none: a clear message, and the document untouched."""

    def refused(self, shape: Any, *words: str) -> None:
        part = self.add(shape)
        before = (self.doc.UndoCount, self.names())
        for command in ("Tetra_Tetrahedralize", "Tetra_ConvexCells"):
            open_panel(command, part)
            compute()
            for word in words:
                self.assertIn(word, message())
            FreeCADGui.Control.closeDialog()
            pump(0.1)
        self.assertEqual((self.doc.UndoCount, self.names()), before)

    def test_solid_of_an_open_shell(self) -> None:
        self.refused(Part.makeSolid(Part.Shell(Part.makeBox(1, 1, 1).Faces[:5])), "Open edge")

    def test_solid_without_volume(self) -> None:
        face = Part.makePlane(4, 4)
        back = face.copy()
        back.reverse()
        self.refused(Part.Solid(Part.Shell([face, back])), "without volume")

    def test_solid_that_crosses_itself(self) -> None:
        self.refused(dented_through(), "crosses itself")
