# SPDX-License-Identifier: LGPL-2.1-or-later
"""Whatever a user may click on is decomposed where the 3D view shows it."""

from __future__ import annotations

from typing import Any

import FreeCAD
import FreeCADGui
import Part
from window import WindowTest, pump, take_picture, wait_for, widget

L_SHAPE = Part.makeBox(4, 4, 4).cut(Part.makeBox(2, 2, 4))


class Sources(WindowTest):
    def cells(self, obj: Any, element: str = "") -> Any:
        """Click on an object, make its cells by the panel, and return them."""
        before = set(self.names())
        FreeCADGui.Selection.clearSelection()
        FreeCADGui.Selection.addSelection(self.doc.Name, obj.Name, element)
        pump(0.1)
        FreeCADGui.runCommand("Tetra_ConvexCells")
        widget("TetraCompute").click()
        wait_for(lambda: widget("TetraMessage").text(), "the cells")
        said = widget("TetraMessage").text()
        FreeCADGui.Control.closeDialog()
        pump(0.1)
        made = [o for o in self.doc.Objects if o.Name not in before]
        self.assertEqual(len(made), 1, said)
        return made[0]

    def body(self) -> Any:
        body = self.doc.addObject("PartDesign::Body", "Body")
        sketch = body.newObject("Sketcher::SketchObject", "Sketch")
        corners = [(0, 0), (4, 0), (4, 2), (2, 2), (2, 4), (0, 4)]
        points = [FreeCAD.Vector(x, y, 0) for x, y in corners]
        for one, two in zip(points, points[1:] + points[:1]):
            sketch.addGeometry(Part.LineSegment(one, two))
        pad = body.newObject("PartDesign::Pad", "Pad")
        pad.Profile = sketch
        pad.Length = 3
        body.Placement.Base = FreeCAD.Vector(10, 20, 30)
        self.doc.recompute()
        return body

    def test_face_of_a_solid(self) -> None:
        part = self.add(L_SHAPE)
        made = self.cells(part, "Face3")
        self.assertEqual((made.Source, made.Pieces), (part, 2))

    def test_face_of_a_body(self) -> None:
        body = self.body()
        made = self.cells(body, "Pad.Face1")
        self.assertEqual((made.Source, made.Pieces), (body, 2))
        self.assertAlmostEqual(made.Shape.Volume, 36)
        self.assertAlmostEqual(made.Shape.BoundBox.XMin, 10)
        self.assertAlmostEqual(made.Shape.BoundBox.ZMax, 33)

    def test_feature_of_a_body(self) -> None:
        body = self.body()
        made = self.cells(self.doc.getObject("Pad"))
        self.assertEqual(made.Source, body)

    def test_link_that_stands_elsewhere(self) -> None:
        link = self.doc.addObject("App::Link", "Link")
        link.LinkedObject = self.add(L_SHAPE)
        link.Placement.Base = FreeCAD.Vector(0, 50, 0)
        self.doc.recompute()
        made = self.cells(link)
        self.assertEqual((made.Source, made.Pieces), (link, 2))
        self.assertAlmostEqual(made.Shape.BoundBox.YMin, 50)
        take_picture("link")

    def test_compound_of_solids(self) -> None:
        far = L_SHAPE.translated(FreeCAD.Vector(10, 0, 0))
        made = self.cells(self.add(Part.makeCompound([L_SHAPE, far])))
        self.assertEqual(made.Pieces, 4)

    def test_solid_in_a_container_that_stands_elsewhere(self) -> None:
        part = self.add(L_SHAPE)
        group = self.doc.addObject("App::Part", "Group")
        group.addObject(part)
        group.Placement.Base = FreeCAD.Vector(0, 0, 7)
        self.doc.recompute()
        made = self.cells(group, "Part.")
        self.assertEqual((made.Source, made.Pieces), (part, 2))
        self.assertAlmostEqual(made.Shape.BoundBox.ZMin, 7)
