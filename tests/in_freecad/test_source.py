# SPDX-License-Identifier: LGPL-2.1-or-later
"""Document objects become closed surfaces in global coordinates that know their faces."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import Part
from FreeCAD import Vector
from parts import (
    InDocument,
    angle_block,
    drilled_block,
    is_closed,
    placement,
    thin_tube,
    two_boxes_with_common_face,
)

from freecad_tetra import api
from freecad_tetra.errors import InvalidSolid
from freecad_tetra.model import Solid
from freecad_tetra.workbench import source


class Tessellation(InDocument):
    def test_planar_solid_keeps_its_corners_and_faces(self) -> None:
        solid = source.solid_of(self.feature_of(angle_block()))
        self.assertEqual(solid.volume(), 7.0)
        self.assertEqual(len(solid.vertices), 12)
        self.assertEqual(solid.face_names, tuple(f"Face{i}" for i in range(1, 9)))
        self.assert_triangles_lie_on_their_faces(angle_block(), solid)

    def test_round_solids_are_closed_and_near(self) -> None:
        shapes = {
            "cylinder": Part.makeCylinder(5, 10),
            "cone with apex": Part.makeCone(5, 0, 10),
            "sphere": Part.makeSphere(5),
            "torus": Part.makeTorus(10, 3),
            "part of a torus": Part.makeTorus(10, 3, Vector(), Vector(0, 0, 1), -90, 90, 200),
            "drilled": drilled_block(),
        }
        for name, shape in shapes.items():
            with self.subTest(name):
                solid = source.solid_of(shape, relative=0.001, angular=10.0)
                self.assertTrue(is_closed(solid.triangles))
                self.assertAlmostEqual(solid.volume() / shape.Volume, 1.0, delta=0.02)
                self.assertEqual(set(solid.face_ids.tolist()), set(range(len(shape.Faces))))
                self.assert_triangles_lie_on_their_faces(shape, solid)

    def test_finer_deflections_give_more_triangles(self) -> None:
        shape = drilled_block()
        by_height = [len(source.solid_of(shape, linear=h).triangles) for h in (0.5, 0.001)]
        by_angle = [len(source.solid_of(shape, angular=a).triangles) for a in (30, 3)]
        self.assertLess(by_height[0], by_height[1])
        self.assertLess(by_angle[0], by_angle[1])

    def test_what_is_below_opencascades_least_is_its_least(self) -> None:
        """A smaller deflection makes OpenCascade throw, and FreeCAD crash."""
        small = source.solid_of(Part.makeBox(1e-5, 1e-5, 1e-5))
        self.assertAlmostEqual(small.volume() / 1e-15, 1.0, delta=1e-9)
        box = source.solid_of(Part.makeBox(1, 1, 1), linear=1e-20, angular=1e-20)
        self.assertEqual(box.volume(), 1.0)

    def test_the_shape_is_left_as_it_was(self) -> None:
        shape = drilled_block()
        before = shape.dumpToString()
        source.solid_of(shape)
        self.assertEqual(shape.dumpToString(), before)

    def test_solids_share_the_nodes_of_a_common_face(self) -> None:
        solid = source.solid_of(two_boxes_with_common_face())
        self.assertEqual(len(solid.vertices), 12)
        self.assertEqual(sorted(set(solid.solid_ids.tolist())), [0, 1])
        for number in (0, 1):
            own = solid.triangles[solid.solid_ids == number]
            self.assertTrue(is_closed(own))
            self.assertEqual(Solid(solid.vertices, own).volume(), 8.0)

    def test_one_solid_of_several(self) -> None:
        both = Part.makeCompound([Part.makeBox(1, 1, 1), Part.makeBox(2, 2, 2, Vector(5, 0, 0))])
        self.assertAlmostEqual(api.as_solid(both, solid=2).volume(), 8.0, delta=1e-12)
        with self.assertRaises(InvalidSolid) as caught:
            api.as_solid(both, solid=3)
        self.assertEqual(caught.exception.next_step, "choose a solid from 1 to 2")

    def test_thin_walls_are_tessellated_finer(self) -> None:
        found = api.validate(thin_tube())
        self.assertEqual(found.defects, ())
        self.assertEqual(found.solid.notes["retried_for"], ["volume"])
        self.assertAlmostEqual(found.solid.volume() / thin_tube().Volume, 1.0, delta=0.01)

    def assert_triangles_lie_on_their_faces(self, shape: Any, solid: Solid) -> None:
        faces = shape.Faces
        for face in range(len(faces)):
            rows = solid.triangles[solid.face_ids == face]
            for corner in solid.vertices[np.unique(rows)].tolist():
                point = Vector(*corner)  # distToShape is wrong about tori
                near = faces[face].Surface.projectPoint(point).distanceToPoint(point)
                self.assertLess(near, 1e-6)


class Places(InDocument):
    """What the 3D view shows is what is decomposed."""

    def assertBox(self, obj: Any, *wanted: float) -> None:
        solid = source.solid_of(obj)
        low, high = solid.vertices.min(axis=0), solid.vertices.max(axis=0)
        np.testing.assert_allclose([*low, *high], wanted, atol=1e-9)
        self.assertTrue(is_closed(solid.triangles))

    def box(self) -> Any:
        obj = self.doc.addObject("Part::Box", "Box")
        obj.Length, obj.Width, obj.Height = 1, 2, 3
        return obj

    def test_placed_object(self) -> None:
        box = self.box()
        box.Placement = placement(10, 0, 0, 90)
        self.doc.recompute()
        self.assertBox(box, 8, 0, 0, 10, 1, 3)

    def test_object_in_containers(self) -> None:
        inner, outer = (self.doc.addObject("App::Part", name) for name in ("Inner", "Outer"))
        box = self.box()
        inner.addObject(box)
        outer.addObject(inner)
        box.Placement = placement(1, 0, 0)
        inner.Placement = placement(0, 10, 0, 90)
        outer.Placement = placement(0, 0, 100)
        self.doc.recompute()
        self.assertBox(box, -2, 11, 100, 0, 12, 103)
        self.assertBox(inner, -2, 11, 100, 0, 12, 103)
        self.assertBox(outer, -2, 11, 100, 0, 12, 103)

    def test_body_and_its_feature(self) -> None:
        body = self.doc.addObject("PartDesign::Body", "Body")
        feature = self.doc.addObject("PartDesign::AdditiveBox", "Pad")
        body.addObject(feature)
        body.Placement = placement(0, 0, 50)
        self.doc.recompute()
        self.assertBox(body, 0, 0, 50, 10, 10, 60)
        self.assertBox(feature, 0, 0, 50, 10, 10, 60)

    def test_links(self) -> None:
        box = self.box()
        link = self.doc.addObject("App::Link", "Link")
        link.LinkedObject = box
        link.Placement = placement(0, 0, 7)
        array = self.doc.addObject("App::Link", "Array")
        array.LinkedObject = box
        array.ShowElement = False
        array.ElementCount = 2
        array.PlacementList = [placement(0, 0, 0), placement(0, 0, 10)]
        self.doc.recompute()
        self.assertBox(link, 0, 0, 7, 1, 2, 10)
        self.assertBox(array, 0, 0, 0, 1, 2, 13)

    def test_link_to_a_container_inside_another(self) -> None:
        part, outer = (self.doc.addObject("App::Part", name) for name in ("Part", "Outer"))
        part.addObject(self.box())
        link = self.doc.addObject("App::Link", "Link")
        link.LinkedObject = part
        outer.addObject(link)
        link.Placement, outer.Placement = placement(5, 0, 0), placement(0, 5, 0, 90)
        self.doc.recompute()
        self.assertBox(link, -2, 10, 0, 0, 11, 3)

    def test_group_and_compound(self) -> None:
        group = self.doc.addObject("App::DocumentObjectGroup", "Group")
        group.addObject(self.box())
        far = self.box()
        far.Placement = placement(4, 0, 0)
        compound = self.doc.addObject("Part::Compound", "Compound")
        compound.Links = [far, *group.Group]
        self.doc.recompute()
        self.assertBox(group, 0, 0, 0, 1, 2, 3)
        self.assertBox(compound, 0, 0, 0, 5, 2, 3)


class NoSolid(InDocument):
    def test_what_holds_no_solid_is_refused(self) -> None:
        box = Part.makeBox(1, 1, 1)
        empty = self.doc.addObject("App::DocumentObjectGroup", "Empty")
        cases = {
            "shell": self.feature_of(box.Shells[0]),
            "face": self.feature_of(box.Faces[0]),
            "wire": self.feature_of(box.Wires[0]),
            "null": self.doc.addObject("Part::Feature", "Null"),
            "empty group": empty,
            "no shape": self.doc.addObject("App::FeaturePython", "Other"),
            "deleted": None,
        }
        for name, obj in cases.items():
            with self.subTest(name), self.assertRaises(InvalidSolid) as caught:
                source.solid_of(obj)
            self.assertEqual([d.kind for d in caught.exception.defects], ["no_solid"])
            self.assertTrue(caught.exception.next_step)

    def test_fingerprint_tells_geometry_and_not_meshes(self) -> None:
        shape = drilled_block()
        mark = source.fingerprint(shape, "a")
        shape.tessellate(0.01)
        self.assertEqual(source.fingerprint(shape, "a"), mark)
        self.assertNotEqual(source.fingerprint(shape, "b"), mark)
        moved = shape.copy()
        moved.translate(Vector(math.pi, 0, 0))
        self.assertNotEqual(source.fingerprint(moved, "a"), mark)
