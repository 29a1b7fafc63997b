# SPDX-License-Identifier: LGPL-2.1-or-later
"""Documents: saved by one run and opened by another, older ones, damaged ones."""

from __future__ import annotations

import os
import subprocess
import sys
import tempfile
from pathlib import Path
from unittest import mock

import FreeCAD
import numpy as np
from parts import InDocument, drilled_block, placement

from freecad_tetra.workbench import (
    child_python,
    feature,
    fem_feature,
    preferences,
    properties,
    runner,
    source,
)

OLD = Path(__file__).resolve().parent / "documents"
_OTHER_RUN = """
import FreeCAD
doc = FreeCAD.openDocument({path!r})
cells = doc.getObject({name!r})
box = [o for o in doc.Objects if o.TypeId == "Part::Feature"][0]
told = [type(cells.Proxy).__name__, cells.State, cells.Pieces, len(cells.Shape.Solids)]
box.Shape = box.Shape.cut(FreeCAD.ActiveDocument.getObject("Tool").Shape)
doc.recompute()
told += [cells.State, cells.Pieces > told[2], cells.Shape.isValid()]
doc.save()
print("TOLD", told, flush=True)
"""


class Saved(InDocument):
    def setUp(self) -> None:
        super().setUp()
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.path = str(Path(folder.name) / "part.FCStd")

    def reopen(self) -> None:
        if self.doc.FileName:
            self.doc.save()
        else:
            self.doc.saveAs(self.path)
        FreeCAD.closeDocument(self.doc.Name)
        with mock.patch.object(runner, "start", side_effect=AssertionError("computed again")):
            self.doc = FreeCAD.openDocument(self.path)

    def test_objects_come_back_whole_without_a_recompute(self) -> None:
        block = self.feature_of(drilled_block())
        block.Placement = placement(1, 2, 3, 4)
        given = {"AngularDeflection": 15.0, "LinearDeflection": 0.05, "MaxPieces": 5000}
        made = {
            "Tetrahedra": feature.make_tetrahedra(self.doc, block, Direction="z", **given),
            "ConvexCells": feature.make_convex_cells(self.doc, block, Explode=0.25, **given),
        }
        self.doc.recompute()
        before = {}
        for kind, obj in made.items():
            values = {n: str(getattr(obj, n)) for n in obj.PropertiesList}
            for name in ("Proxy", "Shape", "Seconds", "VolumeError"):  # floats lose a digit
                values.pop(name)
            before[kind] = (obj.Name, values, feature.pieces_of(obj), obj.Shape.Volume)
        self.reopen()
        for kind, (name, values, pieces, volume) in before.items():
            obj = self.doc.getObject(name)
            self.assertEqual(type(obj.Proxy).__name__, kind)
            self.assertEqual(obj.State, ["Up-to-date"])
            again = {n: str(getattr(obj, n)) for n in values}
            self.assertEqual(again, values)
            read = feature.pieces_of(obj)
            np.testing.assert_array_equal(read.points, pieces.points)
            self.assertEqual(read.report.to_dict(), pieces.report.to_dict())
            self.assertAlmostEqual(obj.Shape.Volume, volume, delta=1e-9)
            self.assertEqual(len(obj.Shape.Solids), obj.Pieces)
        with mock.patch.object(runner, "start", side_effect=AssertionError("computed again")):
            for obj in self.doc.Objects:
                obj.touch()
            self.doc.recompute()
        self.assertEqual({tuple(obj.State) for obj in self.doc.Objects}, {("Up-to-date",)})

    def test_a_second_run_recomputes(self) -> None:
        self.feature_of(drilled_block(), "Block")
        tool = self.doc.addObject("Part::Box", "Tool")
        tool.Length = tool.Width = tool.Height = 1
        cells = feature.make_convex_cells(self.doc, self.doc.Block)
        self.doc.recompute()
        name = cells.Name
        self.doc.saveAs(self.path)
        self.doc.Tool.Placement = placement(0, 0, 0)
        self.doc.save()
        FreeCAD.closeDocument(self.doc.Name)
        script = Path(self.path).with_suffix(".py")
        script.write_text(_OTHER_RUN.format(path=self.path, name=name))
        done = subprocess.run(
            [sys.executable, str(script)], capture_output=True, text=True, timeout=120,
            stdin=subprocess.DEVNULL, env={**os.environ}, **child_python.no_window(),
        )  # fmt: skip
        told = [x for x in done.stdout.splitlines() if "TOLD" in x]
        self.assertTrue(told, done.stdout + done.stderr)
        self.assertIn("'ConvexCells', ['Up-to-date'], ", told[0])
        self.assertTrue(told[0].endswith("['Up-to-date'], True, True]"), told[0])
        self.doc = FreeCAD.openDocument(self.path)
        obj = self.doc.getObject(name)
        self.assertFillsSource(obj, source.solid_of(obj.Source).volume())

    def test_fem_mesh_comes_back(self) -> None:
        mesh = feature.make_fem_mesh(self.doc, self.feature_of(drilled_block()))
        self.doc.recompute()
        nodes, volumes = mesh.FemMesh.NodeCount, mesh.FemMesh.VolumeCount
        name = mesh.Name
        self.reopen()
        mesh = self.doc.getObject(name)
        self.assertIsInstance(mesh.Proxy, fem_feature.FemMesh)
        self.assertEqual((mesh.FemMesh.NodeCount, mesh.FemMesh.VolumeCount), (nodes, volumes))

    def test_damaged_pieces_are_told_and_computed_again(self) -> None:
        obj = feature.make_convex_cells(self.doc, self.feature_of(drilled_block()))
        self.doc.recompute()
        obj.PieceData = obj.PieceData[:-1]
        obj.Fingerprint = ""
        obj.Proxy.pieces = None
        with self.assertRaisesRegex(Exception, "damaged"):
            feature.pieces_of(obj)
        obj.touch()
        self.doc.recompute()
        self.assertFillsSource(obj, source.solid_of(obj.Source).volume())


class Older(InDocument):
    def test_schema_1_opens_and_recomputes(self) -> None:
        """Made by documents/make_schema_1.py: deflections without units, no angle, no limit."""
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        path = Path(folder.name) / "old.FCStd"
        path.write_bytes((OLD / "schema_1.FCStd").read_bytes())
        doc = FreeCAD.openDocument(str(path))
        for name, kind in (("Tetrahedra", "Tetrahedra"), ("Cells", "ConvexCells")):
            obj = doc.getObject(name)
            self.assertEqual(type(obj.Proxy).__name__, kind)
            self.assertEqual(obj.SchemaVersion, properties.SCHEMA)
            known = properties.TETRAHEDRA if kind == "Tetrahedra" else properties.CONVEX_CELLS
            for prop, wanted in known.items():
                self.assertEqual(obj.getTypeIdOfProperty(prop), wanted.kind, prop)
            self.assertEqual((obj.LinearDeflection.Value, obj.Source.Name), (0.25, "Box"))
            self.assertEqual((obj.AngularDeflection.Value, obj.Explode), (0.0, 0.0))
            self.assertEqual(obj.MaxPieces, preferences.max_pieces())
        self.assertEqual(doc.getObject("Cells").Method, "bajaj-dey")
        self.assertEqual(doc.getObject("Tetrahedra").Direction, "z")
        for obj in doc.Objects:
            obj.touch()
        doc.recompute()
        for name in ("Tetrahedra", "Cells"):
            self.assertFillsSource(doc.getObject(name), 1000.0)
