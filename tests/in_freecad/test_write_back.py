# SPDX-License-Identifier: LGPL-2.1-or-later
"""Pieces become valid shapes whose neighbours share their faces."""

from __future__ import annotations

import unittest
from typing import Any

import numpy as np
import Part
from FreeCAD import Vector
from parts import angle_block, drilled_block, face_uses, two_boxes_with_common_face

from freecad_tetra import as_solid, convex_cells, tetrahedralize
from freecad_tetra.workbench import kernel_path, write_back


def surface_area(shape: Any) -> float:
    """Return the area of the triangles that are decomposed."""
    solid = as_solid(shape)
    corners = solid.vertices[solid.triangles]
    sides = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    return float(np.linalg.norm(sides, axis=1).sum() / 2)


class Pieces(unittest.TestCase):
    @classmethod
    def setUpClass(cls) -> None:
        kernel_path.bring_in()
        cls.mesh = tetrahedralize(drilled_block())
        cls.cells = convex_cells(drilled_block())

    def test_tetrahedra_are_one_compsolid(self) -> None:
        shape = write_back.shape_of_pieces(self.mesh)
        self.assertEqual(shape.ShapeType, "CompSolid")
        self.assertTrue(shape.isValid())
        self.assertEqual(len(shape.Solids), len(self.mesh))
        self.assertEqual(len(shape.Vertexes), len(self.mesh.points))
        self.assertEqual(len(shape.Faces), (4 * len(self.mesh) + len(self.mesh.skin)) // 2)
        uses = face_uses(shape)
        self.assertEqual(uses.count(1), len(self.mesh.skin))
        self.assertEqual(uses.count(2), len(shape.Faces) - len(self.mesh.skin))
        self.assert_volumes(shape, self.mesh)

    def test_cells_share_the_faces_they_have_in_common(self) -> None:
        shape = write_back.shape_of_pieces(self.cells)
        self.assertTrue(shape.isValid())
        self.assertEqual(len(shape.Solids), len(self.cells))
        uses = face_uses(shape)
        self.assertEqual(set(uses), {1, 2})
        self.assertEqual(shape.ShapeType, "CompSolid")
        skin = sum(face.Area for face, used in zip(shape.Faces, uses) if used == 1)
        self.assertAlmostEqual(skin / surface_area(drilled_block()), 1.0, delta=1e-9)
        self.assert_volumes(shape, self.cells)

    def test_cells_face_to_face_are_a_compsolid(self) -> None:
        cells = convex_cells(angle_block())
        shape = write_back.shape_of_pieces(cells)
        self.assertEqual((shape.ShapeType, len(shape.Solids)), ("CompSolid", 2))
        self.assertTrue(shape.isValid())
        self.assertEqual(face_uses(shape).count(2), 1)

    def test_cells_are_divided_where_they_meet(self) -> None:
        """A post stands on a plate: the face of the plate has a hole and what is in it."""
        post = Part.makeBox(4, 4, 1).fuse(Part.makeBox(1, 1, 3, Vector(1, 1, 1))).removeSplitter()
        shape = write_back.shape_of_pieces(convex_cells(post))
        self.assertEqual((shape.ShapeType, len(shape.Solids)), ("CompSolid", 2))
        self.assertTrue(shape.isValid())
        shared = [f for f, used in zip(shape.Faces, face_uses(shape)) if used == 2]
        self.assertEqual([face.Area for face in shared], [1.0])
        self.assertEqual(max(len(face.Wires) for face in shape.Faces), 2)
        self.assertEqual(len(shape.Faces), 12)
        self.assertAlmostEqual(shape.Volume, post.Volume, delta=1e-12)

    def test_crossing_cells_share_parts_of_faces(self) -> None:
        """Two bars cross: their common face is a part of both."""
        bars = Part.makeBox(5, 1, 1).fuse(Part.makeBox(1, 5, 1, Vector(2, -2, 1))).removeSplitter()
        for given in ({}, {"plain": True, "merge": False}):
            cells = convex_cells(bars, **given)
            shape = write_back.shape_of_pieces(cells)
            self.assertEqual((shape.ShapeType, len(shape.Solids)), ("CompSolid", len(cells)))
            self.assertTrue(shape.isValid())
            skin = sum(f.Area for f, used in zip(shape.Faces, face_uses(shape)) if used == 1)
            self.assertAlmostEqual(skin, bars.Area, delta=1e-9)

    def test_separate_solids_are_a_compound_of_compsolids(self) -> None:
        apart = Part.makeCompound([angle_block(), angle_block().translated(Vector(10, 0, 0))])
        shape = write_back.shape_of_pieces(tetrahedralize(apart))
        self.assertEqual((shape.ShapeType, len(shape.CompSolids)), ("Compound", 2))
        self.assertTrue(shape.isValid())
        self.assertAlmostEqual(shape.Volume, 14.0, delta=1e-12)

    def test_solids_with_a_common_face_hang_together(self) -> None:
        shape = write_back.shape_of_pieces(convex_cells(two_boxes_with_common_face()))
        self.assertEqual((shape.ShapeType, len(shape.Solids)), ("CompSolid", 2))
        self.assertEqual(face_uses(shape).count(2), 1)

    def test_a_single_piece_is_a_solid_in_a_compound(self) -> None:
        shape = write_back.shape_of_pieces(convex_cells(Part.makeBox(1, 2, 3)))
        self.assertEqual((shape.ShapeType, len(shape.Solids)), ("Compound", 1))
        self.assertAlmostEqual(shape.Volume, 6.0, delta=1e-12)

    def test_exploded_pieces_keep_their_shape_and_share_nothing(self) -> None:
        for pieces in (self.mesh, self.cells):
            whole = write_back.shape_of_pieces(pieces)
            apart = write_back.shape_of_pieces(pieces, 0.5)
            self.assertTrue(apart.isValid())
            self.assertEqual(set(face_uses(apart)), {1})
            self.assert_volumes(apart, pieces)
            middle = whole.BoundBox.Center
            for near, far in zip(whole.Solids, apart.Solids):
                centre, moved = near.BoundBox.Center, far.BoundBox.Center
                self.assertLess((centre - moved).Length, 0.51 * (10 + 10 + 4))
                if (centre - middle).Length > 1:
                    self.assertGreater((moved - middle).Length, (centre - middle).Length)

    def assert_volumes(self, shape: Any, pieces: Any) -> None:
        volumes = [solid.Volume for solid in shape.Solids]
        np.testing.assert_allclose(volumes, pieces.volumes(), rtol=1e-9, atol=1e-12)
