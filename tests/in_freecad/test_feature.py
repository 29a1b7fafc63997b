# SPDX-License-Identifier: LGPL-2.1-or-later
"""Parametric objects: properties, recompute, undo, copy, deletion, errors, limits."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any
from unittest import mock

import FreeCAD
import numpy as np
import Part
from FreeCAD import Vector
from parts import InDocument, angle_block, drilled_block, face_uses, placement

from freecad_tetra.errors import BadOption, InvalidSolid
from freecad_tetra.model import ConvexCells, TetMesh
from freecad_tetra.workbench import (
    feature,
    kernel_path,
    properties,
    runner,
    source,
    write_back,
)

MAKERS = {"Tetrahedra": feature.make_tetrahedra, "ConvexCells": feature.make_convex_cells}


@contextmanager
def counted_starts() -> Iterator[list[str]]:
    """Collect the tasks that are started meanwhile."""
    started: list[str] = []
    true_start = runner.start

    def start(task: str, *arguments: Any) -> runner.Job:
        started.append(task)
        return true_start(task, *arguments)

    with mock.patch.object(runner, "start", start):
        yield started


class Made(InDocument):
    def setUp(self) -> None:
        super().setUp()
        self.block = self.doc.addObject("Part::Box", "Box")
        self.hole = self.doc.addObject("Part::Cylinder", "Hole")
        self.hole.Placement = placement(5, 5, 0)
        self.cut = self.doc.addObject("Part::Cut", "Cut")
        self.cut.Base, self.cut.Tool = self.block, self.hole
        self.doc.recompute()

    def make(self, kind: str, **given: Any) -> Any:
        obj = MAKERS[kind](self.doc, self.cut, **given)
        self.doc.recompute()
        return obj

    def surface_volume(self, obj: Any) -> float:
        return source.solid_of(obj).volume()


class Properties(Made):
    def test_freecad_lists_these_tests(self) -> None:
        self.assertIn("freecad_tetra.workbench.selftest", FreeCAD.__unit_test__)

    def test_objects_have_units_choices_and_results(self) -> None:
        for kind in MAKERS:
            with self.subTest(kind):
                obj = self.make(kind)
                self.assertEqual(obj.TypeId, "Part::FeaturePython")
                self.assertEqual(type(obj.Proxy).__module__, "freecad_tetra.workbench.feature")
                self.assertEqual(type(obj.Proxy).__name__, kind)
                kinds = {name: obj.getTypeIdOfProperty(name) for name in obj.PropertiesList}
                self.assertEqual(kinds["LinearDeflection"], "App::PropertyLength")
                self.assertEqual(kinds["AngularDeflection"], "App::PropertyAngle")
                self.assertEqual(kinds["Method"], "App::PropertyEnumeration")
                self.assertEqual(kinds["Source"], "App::PropertyLinkGlobal")
                self.assertEqual(obj.SchemaVersion, properties.SCHEMA)
                for name in ("Pieces", "Notches", "SteinerPoints", "VolumeError", "Seconds"):
                    self.assertEqual(obj.getEditorMode(name), ["ReadOnly"], name)
                for name in ("PieceData", "PieceLayout", "ReportData", "Fingerprint"):
                    self.assertIn("Hidden", obj.getTypeOfProperty(name), name)
                self.assertFillsSource(obj, self.surface_volume(self.cut))
                self.assertGreater(obj.Seconds, 0.0)
                self.assertLess(obj.VolumeError, 1e-12)
                self.assertEqual(obj.Notches, feature.pieces_of(obj).report.counts["notches"])

    def test_given_properties_are_set(self) -> None:
        obj = self.make(
            "Tetrahedra", Direction="z", LinearDeflection=0.5, AngularDeflection="30 deg",
            MaxPieces=7, Explode=0.5, Label="Mine",
        )  # fmt: skip
        self.assertEqual(obj.Direction, "z")
        self.assertEqual(obj.LinearDeflection.UserString[:3], "0.5")
        self.assertAlmostEqual(obj.AngularDeflection.Value, 30.0)
        self.assertEqual((obj.MaxPieces, obj.Explode, obj.Label), (7, 0.5, "Mine"))
        self.assertEqual(feature.pieces_of(obj).report.direction, "z")

    def test_limit_comes_from_the_preferences(self) -> None:
        stored = FreeCAD.ParamGet("User parameter:BaseApp/Preferences/Mod/Tetra")
        stored.SetInt("MaxPieces", 123)
        try:
            self.assertEqual(self.make("ConvexCells").MaxPieces, 123)
        finally:
            stored.RemInt("MaxPieces")
        self.assertEqual(self.make("ConvexCells").MaxPieces, 10_000)

    def test_wrong_properties_add_nothing(self) -> None:
        before = len(self.doc.Objects)
        wrong = [{"Colour": 1}, {"Pieces": 5}, {"Method": "magic"}, {"Direction": "up"},
                 {"LinearDeflection": "far"}]  # fmt: skip
        for given in wrong:
            with self.subTest(given), self.assertRaises(BadOption) as caught:
                feature.make_tetrahedra(self.doc, self.cut, **given)
            self.assertTrue(caught.exception.next_step)
            self.assertEqual(len(self.doc.Objects), before)

    def test_directions_are_read(self) -> None:
        self.assertEqual(feature.direction(" X "), "x")
        self.assertEqual(feature.direction(""), "auto")
        self.assertEqual(feature.direction("1, -2,3"), [1, -2, 3])
        for text in ("w", "1,2", "0,0,0", "1.5,2,3"):
            with self.assertRaises(BadOption):
                feature.direction(text)


class Recompute(Made):
    def test_change_of_the_source_is_followed(self) -> None:
        for kind in MAKERS:
            obj = self.make(kind)
            self.block.Length = 15
            self.doc.recompute()
            self.assertFillsSource(obj, self.surface_volume(self.cut))
            self.block.Length = 10
            self.doc.recompute()

    def test_nothing_is_computed_twice(self) -> None:
        obj = self.make("ConvexCells")
        with counted_starts() as started:
            self.cut.Label = "Other"
            self.cut.touch()
            obj.Explode = 0.5
            self.doc.recompute()
            obj.MaxPieces = 1
            self.doc.recompute()
            self.assertEqual(started, [])
            obj.AngularDeflection = 10
            self.doc.recompute()
            self.assertEqual(started, ["convex_cells"])

    def test_coarser_chords_give_fewer_pieces(self) -> None:
        fine = self.make("ConvexCells", AngularDeflection=10)
        coarse = self.make("ConvexCells", AngularDeflection=60, LinearDeflection=1)
        self.assertLess(coarse.Pieces, fine.Pieces)

    def test_placement_of_the_source_is_honoured_and_of_the_result_kept(self) -> None:
        obj = self.make("Tetrahedra")
        self.cut.Placement = placement(100, 0, 0, 30)
        self.doc.recompute()
        near = source.shape_of(self.cut).BoundBox
        self.assertLess((obj.Shape.BoundBox.Center - near.Center).Length, 1e-6)
        obj.Placement = placement(0, 0, 50)
        self.block.Width = 11
        self.doc.recompute()
        self.assertEqual(obj.Placement.Base, Vector(0, 0, 50))
        self.assertAlmostEqual(obj.Shape.BoundBox.ZMin, 50.0)

    def test_explode_moves_pieces_apart(self) -> None:
        obj = self.make("ConvexCells", Explode=1.0)
        self.assertEqual(set(face_uses(obj.Shape)), {1})
        self.assertGreater(obj.Shape.BoundBox.XLength, 10.5)
        self.assertAlmostEqual(obj.Shape.Volume / self.surface_volume(self.cut), 1.0, delta=1e-9)

    def test_body_link_and_container(self) -> None:
        body = self.doc.addObject("PartDesign::Body", "Body")
        body.addObject(self.doc.addObject("PartDesign::AdditiveBox", "Pad"))
        link = self.doc.addObject("App::Link", "Link")
        link.LinkedObject = self.cut
        link.Placement = placement(0, 0, 40)
        part = self.doc.addObject("App::Part", "Part")
        part.addObject(body)
        part.Placement = placement(7, 0, 0)
        for of in (body, link, part):
            with self.subTest(of.Name):
                self.doc.recompute()
                obj = feature.make_convex_cells(self.doc, of)
                self.doc.recompute()
                self.assertFillsSource(obj, self.surface_volume(of))
                box = source.shape_of(of).BoundBox
                self.assertLess((obj.Shape.BoundBox.Center - box.Center).Length, 1e-6)


class Kept(Made):
    def test_undo_and_redo(self) -> None:
        self.doc.openTransaction("make")
        obj = self.make("ConvexCells")
        name, pieces = obj.Name, obj.Pieces
        self.doc.commitTransaction()
        self.doc.openTransaction("change")
        obj.AngularDeflection = 60
        obj.LinearDeflection = 2
        self.doc.recompute()
        self.doc.commitTransaction()
        coarse = obj.Pieces
        self.assertNotEqual(coarse, pieces)
        with counted_starts() as started:
            self.doc.undo()
            self.assertEqual((obj.Pieces, len(obj.Shape.Solids)), (pieces, pieces))
            self.assertEqual(len(feature.pieces_of(obj)), pieces)
            self.doc.undo()
            self.assertIsNone(self.doc.getObject(name))
            self.doc.redo()
            self.doc.redo()
            obj = self.doc.getObject(name)
            self.assertEqual((obj.Pieces, len(obj.Shape.Solids)), (coarse, coarse))
            self.assertEqual(len(feature.pieces_of(obj)), coarse)
            self.assertEqual(started, [])

    def test_copy_lives_on_its_own(self) -> None:
        obj = self.make("Tetrahedra")
        with counted_starts() as started:
            copy = self.doc.copyObject(obj)
            self.doc.recompute()
            self.assertEqual(started, [])
        self.assertEqual((copy.Source, copy.Pieces), (self.cut, obj.Pieces))
        self.assertIsNot(copy.Proxy, obj.Proxy)
        np.testing.assert_array_equal(feature.pieces_of(copy).points, feature.pieces_of(obj).points)
        copy.AngularDeflection = 60
        copy.LinearDeflection = 1
        self.doc.recompute()
        self.assertNotEqual(copy.Pieces, obj.Pieces)

    def test_deleted_source_leaves_the_pieces(self) -> None:
        obj = self.make("ConvexCells")
        pieces = obj.Pieces
        self.doc.removeObject(self.cut.Name)
        self.doc.recompute()
        self.assertIn("Invalid", obj.State)
        self.assertIn("deleted", obj.getStatusString())
        self.assertEqual((obj.Pieces, len(obj.Shape.Solids)), (pieces, pieces))
        obj.Source = self.block
        self.doc.recompute()
        self.assertEqual((obj.State, obj.Pieces), (["Up-to-date"], 1))

    def test_bad_source_is_told_and_harms_nothing_else(self) -> None:
        good = self.make("ConvexCells")
        bad = MAKERS["Tetrahedra"](self.doc, self.feature_of(Part.makeBox(1, 1, 1).Shells[0]))
        self.block.Length = 12
        self.doc.recompute()
        self.assertIn("Invalid", bad.State)
        self.assertIn("no solid", bad.getStatusString())
        self.assertTrue(bad.Shape.isNull())
        self.assertFillsSource(good, self.surface_volume(self.cut))


class Limits(Made):
    def test_too_many_pieces_have_no_shape_until_asked(self) -> None:
        for kind, result in (("Tetrahedra", TetMesh), ("ConvexCells", ConvexCells)):
            obj = self.make(kind, MaxPieces=3)
            self.assertEqual(obj.State, ["Up-to-date"])
            self.assertTrue(obj.Shape.isNull())
            self.assertIsInstance(feature.pieces_of(obj), result)
            self.assertEqual(len(feature.pieces_of(obj)), obj.Pieces)
            feature.make_compound(obj)
            self.assertFillsSource(obj, self.surface_volume(self.cut))
            self.block.Length = 13
            self.doc.recompute()
            self.assertFillsSource(obj, self.surface_volume(self.cut))

    def test_pieces_before_the_first_run(self) -> None:
        obj = feature.make_tetrahedra(self.doc, self.cut)
        self.assertIsNone(feature.pieces_of(obj))

    def test_stored_numbers_are_exact(self) -> None:
        obj = self.make("Tetrahedra")
        kept = feature.pieces_of(obj)
        obj.Proxy.pieces = None
        read = feature.pieces_of(obj)
        for name in ("points", "tets", "skin", "skin_face", "skin_source", "point_source"):
            np.testing.assert_array_equal(getattr(read, name), getattr(kept, name))
        self.assertEqual(read.face_names, kept.face_names)
        self.assertEqual(read.report.to_dict(), kept.report.to_dict())


class InBackground(Made):
    """The task panel's way: the work first, the object when it is done."""

    def test_accepted_pieces_are_not_computed_again(self) -> None:
        for kind in MAKERS:
            pieces = feature.start(kind, self.cut, {"AngularDeflection": 15.0}).wait()
            with counted_starts() as started:
                obj = self.make_unfilled(kind, AngularDeflection=15.0)
                feature.accept(obj, pieces)
                self.doc.recompute()
                self.assertEqual(started, [])
            self.assertFillsSource(obj, self.surface_volume_at(15.0))

    def test_the_child_makes_the_text_of_the_shape(self) -> None:
        for kind in MAKERS:
            job = feature.start(kind, self.cut, {})
            pieces = job.wait()
            assert job.text is not None
            self.assertEqual(len(job.text.kept), len(pieces))
            obj = self.make_unfilled(kind)
            feature.accept(obj, pieces)
            with mock.patch.object(write_back, "piece_text", side_effect=AssertionError("here")):
                self.doc.recompute()
            self.assertFillsSource(obj, self.surface_volume(self.cut))
        for given in ({"MaxPieces": 2}, {"Explode": 0.5}):
            job = feature.start("ConvexCells", self.cut, given)
            job.wait()
            self.assertIsNone(job.text)

    def test_pieces_of_another_source_are_computed_again(self) -> None:
        pieces = feature.start("ConvexCells", self.cut, {}).wait()
        self.block.Length = 20
        self.doc.recompute()
        obj = self.make_unfilled("ConvexCells")
        feature.accept(obj, pieces)
        self.doc.recompute()
        self.assertFillsSource(obj, self.surface_volume(self.cut))

    def test_errors_come_before_anything_is_made(self) -> None:
        before = len(self.doc.Objects)
        with self.assertRaises(InvalidSolid):
            feature.start("Tetrahedra", self.feature_of(Part.makeBox(1, 1, 1).Faces[0]), {})
        with self.assertRaises(BadOption):
            feature.start("Tetrahedra", self.cut, {"Flatness": 3})
        self.assertEqual(len(self.doc.Objects), before + 1)

    def make_unfilled(self, kind: str, **given: Any) -> Any:
        return MAKERS[kind](self.doc, self.cut, **given)

    def surface_volume_at(self, angular: float) -> float:
        return source.solid_of(self.cut, angular=angular).volume()


class Facts(InDocument):
    def test_facts_of_a_solid(self) -> None:
        from freecad_tetra.workbench import facts

        told = facts.facts(self.feature_of(angle_block()))
        self.assertEqual((told["faces"], told["notches"], told["bound"]), (8, 1, 2))
        self.assertEqual((told["solids"], told["genus"], told["valid"]), (1, 0, True))
        self.assertAlmostEqual(told["volume"], 7.0)
        for kind in MAKERS:
            self.assertGreater(told["expected"][kind]["pieces"], 0)
            self.assertGreater(told["expected"][kind]["seconds"], 0)
        self.assertEqual(facts.facts(drilled_block())["genus"], 1)

    def test_defects_name_faces(self) -> None:
        from freecad_tetra.workbench import facts

        self.assertEqual(facts.check(drilled_block()), [])
        crossing = Part.makeCompound(
            [Part.makeBox(2, 2, 2), Part.makeBox(2, 2, 2, Vector(1, 1, 1))]
        )
        defects = facts.check(self.feature_of(crossing))
        self.assertTrue(defects)
        self.assertTrue(any(d.faces for d in defects))
        names = {f"Face{i + 1}" for i in range(len(crossing.Faces))}
        self.assertTrue(all(set(d.faces) <= names for d in defects))
        no_solid = facts.check(self.feature_of(Part.makeBox(1, 1, 1).Shells[0]))
        self.assertEqual([d.kind for d in no_solid], ["no_solid"])

    def test_report_of_an_object(self) -> None:
        from freecad_tetra.workbench import facts

        obj = feature.make_tetrahedra(self.doc, self.feature_of(drilled_block()))
        self.doc.recompute()
        told = facts.report(obj)
        self.assertEqual(told["counts"]["tets"], obj.Pieces)
        self.assertEqual(told["verdict"], "verified")
        self.assertIn("histogram", told["quality"])


class WithoutKernel(Made):
    def test_a_missing_kernel_is_the_objects_error(self) -> None:
        with mock.patch.object(kernel_path, "problem", lambda: "It is missing. Run make."):
            obj = feature.make_convex_cells(self.doc, self.cut)
            self.doc.recompute()
        self.assertEqual(obj.getStatusString(), "It is missing; Run make.")
