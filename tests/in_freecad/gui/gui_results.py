# SPDX-License-Identifier: LGPL-2.1-or-later
"""What can be done with the pieces: pick, draw apart, report, mesh, save and open again."""

from __future__ import annotations

import tempfile
from itertools import pairwise
from pathlib import Path
from typing import Any
from unittest import mock

import FreeCAD
import FreeCADGui
import Part
from window import (
    QtCore,
    QtWidgets,
    WindowTest,
    pump,
    read,
    select,
    take_picture,
    tip,
    wait_for,
    widen_panel,
    widget,
)

from freecad_tetra.errors import TetraError
from freecad_tetra.workbench import facts, feature, worst_elements


def press(button: Any) -> None:
    """Press a standard button of the open task panel."""
    boxes = FreeCADGui.getMainWindow().findChildren(QtWidgets.QDialogButtonBox)
    found = [box.button(button) for box in boxes]
    next(b for b in found if b is not None and b.isVisible()).click()
    pump(0.2)


def open_panel(command: str, obj: Any) -> None:
    select(obj)
    FreeCADGui.runCommand(command)
    pump(0.3)


class Results(WindowTest):
    def corner(self) -> Any:
        """Return the convex cells of a box that lacks a corner, shown from the front."""
        shape = Part.makeBox(9, 9, 9).cut(Part.makeBox(5, 5, 5))
        made = feature.make_convex_cells(self.doc, self.add(shape))
        self.finish(made)
        return made

    def bracket(self, make: Any, **properties: Any) -> Any:
        made = make(self.doc, self.add(read("resources/parts/bracket.step")), **properties)
        self.finish(made)
        return made

    def finish(self, made: Any) -> None:
        self.doc.recompute()
        made.Source.ViewObject.Visibility = False
        FreeCADGui.SendMsgToActiveView("ViewFit")
        pump(0.3)

    def picked(self, step: int = 12) -> dict[str, list[tuple[int, int]]]:
        """Return what can be picked in the 3D view, by name."""
        view = FreeCADGui.ActiveDocument.ActiveView
        width, height = view.getSize()
        found: dict[str, list[tuple[int, int]]] = {}
        for x in range(0, width, step):
            for y in range(0, height, step):
                info = view.getObjectInfo((x, y))
                if info is not None:
                    found.setdefault(info["Component"], []).append((x, y))
        return found

    def test_every_piece_is_picked_as_a_solid(self) -> None:
        made = self.corner()
        self.assertEqual(made.ViewObject.DisplayMode, "Pieces")
        names = {f"Solid{i + 1}" for i in range(made.Pieces)}
        found: set[str] = set()
        for view in ("viewIsometric", "viewRear", "viewLeft", "viewBottom"):
            getattr(FreeCADGui.ActiveDocument.ActiveView, view)()
            FreeCADGui.SendMsgToActiveView("ViewFit")
            pump(0.5)
            found |= set(self.picked())
        self.assertEqual(found, names)

    def test_a_picked_piece_is_selected_whole(self) -> None:
        made = self.corner()
        FreeCADGui.Selection.addSelection(made, "Solid2")
        chosen = FreeCADGui.Selection.getSelectionEx()[0]
        self.assertEqual(chosen.SubElementNames, ("Solid2",))
        volumes = feature.pieces_of(made).volumes()
        self.assertAlmostEqual(chosen.SubObjects[0].Volume, volumes[1])
        take_picture("picked")

    def test_pieces_differ_in_colour(self) -> None:
        from freecad_tetra.workbench import piece_scene

        found = piece_scene.colours(1000)
        self.assertEqual(len(set(found)), 1000)
        for one, two in pairwise(found):
            self.assertGreater(sum(abs(a - b) for a, b in zip(one, two)), 0.15)

    def test_other_display_modes_pick_faces(self) -> None:
        made = self.corner()
        made.ViewObject.DisplayMode = "Flat Lines"
        pump(0.3)
        kinds = {name.rstrip("0123456789") for name in self.picked(24)}
        self.assertLessEqual(kinds, {"Face", "Edge", "Vertex"})
        self.assertIn("Face", kinds)

    def test_explode_is_live_and_one_step(self) -> None:
        made = self.bracket(feature.make_convex_cells)
        steps, before = self.doc.UndoCount, self.extent(made)
        open_panel("Tetra_Explode", made)
        widget("TetraFactor").setValue(100)
        pump(0.2)
        self.assertAlmostEqual(made.Explode, 1.0)
        self.assertGreater(self.extent(made), 1.3 * before)
        take_picture("exploded")
        press(QtWidgets.QDialogButtonBox.Ok)
        self.assertEqual(self.doc.UndoCount, steps + 1)
        self.assertEqual(self.doc.UndoNames[0], "Explode")
        FreeCADGui.runCommand("Std_Undo")
        pump(0.2)
        self.assertEqual(made.Explode, 0.0)
        self.assertAlmostEqual(self.extent(made), before)

    def test_cancelled_explode_brings_the_pieces_back(self) -> None:
        made = self.corner()
        steps, before = self.doc.UndoCount, self.extent(made)
        open_panel("Tetra_Explode", made)
        widget("TetraFactor").setValue(200)
        pump(0.2)
        press(QtWidgets.QDialogButtonBox.Cancel)
        self.assertEqual((made.Explode, self.doc.UndoCount), (0.0, steps))
        self.assertAlmostEqual(self.extent(made), before)

    def test_document_closed_while_pieces_are_drawn_apart(self) -> None:
        open_panel("Tetra_Explode", self.corner())
        FreeCAD.closeDocument(self.doc.Name)
        pump(0.3)
        if FreeCADGui.Control.activeDialog():
            widget("TetraFactor").setValue(50)
            press(QtWidgets.QDialogButtonBox.Cancel)
        self.assertFalse(FreeCADGui.Control.activeDialog())

    def extent(self, made: Any) -> float:
        """Return the length of the diagonal of what the 3D view shows of an object."""
        scene = made.ViewObject.Proxy.scene
        box = scene.box()
        return float(sum((b - a) ** 2 for a, b in zip(*box)) ** 0.5)

    def test_report(self) -> None:
        made = self.bracket(feature.make_tetrahedra)
        names, steps = self.names(), self.doc.UndoCount
        open_panel("Tetra_Report", made)
        rows = [w.text() for w in widget("TetraFigures").findChildren(QtWidgets.QLabel)]
        shown = dict(zip(rows[::2], rows[1::2]))
        self.assertEqual(shown["Pieces"], str(made.Pieces))
        self.assertEqual(shown["Notches"], "88")
        self.assertEqual(shown["Verdict"], "verified")
        self.assertEqual(shown["Volume"], "75919.67 mm³")
        widen_panel()
        take_picture("report")
        widget("TetraCopy").click()
        self.assertIn("Notches\t88", QtWidgets.QApplication.clipboard().text())
        press(QtWidgets.QDialogButtonBox.Close)
        self.assertEqual((self.names(), self.doc.UndoCount), (names, steps))

    def test_commands_for_results_are_on(self) -> None:
        made = self.corner()
        select(made)
        for name in ("Tetra_Explode", "Tetra_Report"):
            self.assertTrue(FreeCADGui.Command.get(name).isActive(), tip(name))

    def test_error_is_shown_in_a_box(self) -> None:
        made = self.corner()
        told: list[str] = []

        def look() -> None:
            box = QtWidgets.QApplication.activeModalWidget()
            told.extend([box.text(), box.informativeText()])
            box.accept()

        QtCore.QTimer.singleShot(800, look)
        error = TetraError("the document is damaged", "open an older copy")
        with mock.patch.object(facts, "report", side_effect=error):
            open_panel("Tetra_Report", made)
        self.assertEqual(told, ["The document is damaged.", "Open an older copy."])
        self.assertFalse(FreeCADGui.Control.activeDialog())

    def fem(self, source: Any) -> Any:
        steps = self.doc.UndoCount
        open_panel("Tetra_ToFemMesh", source)
        widget("TetraCompute").click()
        wait_for(lambda: widget("TetraMessage").text(), "the mesh")
        pump(0.2)
        self.assertEqual(self.doc.UndoCount, steps + 1)
        press(QtWidgets.QDialogButtonBox.Close)
        return self.doc.Objects[-1]

    def test_fem_mesh_of_a_solid(self) -> None:
        mesh = self.fem(self.add(read("resources/parts/bracket.step")))
        self.assertTrue(mesh.isDerivedFrom("Fem::FemMeshObject"))
        self.assertGreater(mesh.FemMesh.VolumeCount, 100)
        self.assertEqual(len(mesh.FemMesh.getElementNodes(1)), 10)
        take_picture("fem_mesh")
        worst = worst_elements.show(mesh, 5)
        self.assertEqual(worst.Mesh.CountFacets, 20)
        take_picture("fem_mesh_worst")
        worst_elements.hide(mesh, worst)
        FreeCADGui.runCommand("Std_Undo")
        pump(0.2)
        self.assertEqual(len(self.doc.Objects), 1)

    def test_fem_mesh_of_tetrahedra(self) -> None:
        made = self.bracket(feature.make_tetrahedra)
        mesh = self.fem(made)
        self.assertGreaterEqual(mesh.FemMesh.VolumeCount, made.Pieces)
        self.assertEqual(mesh.Source, made)

    def test_above_the_limit_pieces_are_drawn_until_solids_are_asked_for(self) -> None:
        made = self.bracket(feature.make_tetrahedra, MaxPieces=10)
        self.assertEqual(made.Shape.Solids, [])
        self.assertGreater(len(self.picked(24)), 5)
        take_picture("light")
        from freecad_tetra.workbench import view

        view.make_solids(made)
        self.assertEqual(len(made.Shape.Solids), made.Pieces)
        FreeCADGui.runCommand("Std_Undo")
        pump(0.2)
        self.assertEqual(made.Shape.Solids, [])

    def test_saved_and_opened_again(self) -> None:
        made = self.bracket(feature.make_convex_cells)
        name, pieces = made.Name, made.Pieces
        made.Explode = 0.5
        self.doc.recompute()
        extent = self.extent(made)
        with tempfile.TemporaryDirectory() as folder:
            path = str(Path(folder) / "saved.FCStd")
            self.doc.saveAs(path)
            FreeCAD.closeDocument(self.doc.Name)
            self.doc = FreeCAD.openDocument(path)
            pump(0.3)
        again = self.doc.getObject(name)
        self.assertEqual(again.ViewObject.DisplayMode, "Pieces")
        self.assertEqual(again.Pieces, pieces)
        self.assertAlmostEqual(self.extent(again), extent, places=4)
        FreeCADGui.ActiveDocument.ActiveView.viewIsometric()
        FreeCADGui.SendMsgToActiveView("ViewFit")
        pump(0.5)
        self.assertGreater(len(self.picked(24)), 10)
        self.assertEqual([o.Name for o in again.ViewObject.claimChildren()], [again.Source.Name])

    def test_copy_shows_its_own_pieces(self) -> None:
        made = self.bracket(feature.make_convex_cells)
        copy = self.doc.copyObject(made, False)
        copy.Explode = 1.0
        pump(0.3)
        self.assertEqual(type(copy.ViewObject.Proxy), type(made.ViewObject.Proxy))
        self.assertGreater(self.extent(copy), 1.3 * self.extent(made))

    def test_look_can_be_changed(self) -> None:
        made = self.corner()
        made.ViewObject.Transparency = 60
        made.ViewObject.LineWidth = 3.0
        made.ViewObject.LineColor = (1.0, 0.0, 0.0)
        take_picture("transparent")
        self.assertAlmostEqual(made.ViewObject.Proxy.scene.transparency(), 0.6, places=5)

    def test_deleting_the_pieces_shows_the_solid(self) -> None:
        made = self.corner()
        source = made.Source
        self.assertFalse(source.ViewObject.Visibility)
        select(made)
        FreeCADGui.runCommand("Std_Delete")
        pump(0.3)
        self.assertEqual(self.names(), [source.Name])
        self.assertTrue(source.ViewObject.Visibility)
