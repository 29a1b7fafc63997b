# SPDX-License-Identifier: LGPL-2.1-or-later
"""Check solid says what is wrong in words and selects the faces at fault in the 3D view."""

from __future__ import annotations

from typing import Any

import FreeCADGui
import Part
from window import (
    WindowTest,
    dented_through,
    pump,
    select,
    take_picture,
    wait_for,
    widen_panel,
    widget,
)


def selected_faces() -> set[str]:
    return {name for s in FreeCADGui.Selection.getSelectionEx() for name in s.SubElementNames}


class Check(WindowTest):
    def check(self, shape: Any) -> str:
        """Check a shape and return the verdict; the document stays as it was."""
        part = self.add(shape)
        select(part)
        before = (self.doc.UndoCount, self.names())
        FreeCADGui.runCommand("Tetra_CheckSolid")
        wait_for(lambda: "Checking" not in widget("TetraMessage").text(), "the verdict")
        pump(0.2)
        self.assertEqual((self.doc.UndoCount, self.names()), before)
        return widget("TetraMessage").text()

    def test_valid_solid(self) -> None:
        self.assertIn("is a valid solid", self.check(Part.makeCylinder(2, 3)))
        self.assertFalse(widget("TetraDefects").isVisible())

    def test_crossing_faces_are_selected(self) -> None:
        self.assertTrue(dented_through().isValid())  # FreeCAD's own check does not see it
        self.assertIn("not a valid solid", self.check(dented_through()))
        faces = selected_faces()
        # The bottom and the four faces of the dent that go through it.
        self.assertEqual(len(faces), 5)
        defects = widget("TetraDefects")
        self.assertGreaterEqual(defects.count(), 1)
        self.assertIn("crosses itself", defects.item(0).text())
        widen_panel()
        take_picture("check")
        FreeCADGui.Selection.clearSelection()
        defects.setCurrentRow(0)
        pump(0.1)
        self.assertTrue(selected_faces() and selected_faces() <= faces)

    def test_open_shell(self) -> None:
        open_box = Part.makeSolid(Part.Shell(Part.makeBox(1, 1, 1).Faces[:5]))
        self.assertIn("not a valid solid", self.check(open_box))
        self.assertIn("Open edge", widget("TetraDefects").item(0).text())
        self.assertEqual(len(selected_faces()), 4)

    def test_solid_without_volume(self) -> None:
        face, back = Part.makePlane(4, 4), Part.makePlane(4, 4)
        back.reverse()
        self.assertIn("not a valid solid", self.check(Part.Solid(Part.Shell([face, back]))))
        self.assertIn("without volume", widget("TetraDefects").item(0).text())
