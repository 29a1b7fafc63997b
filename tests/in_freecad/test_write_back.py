# SPDX-License-Identifier: LGPL-2.1-or-later
"""Pieces become valid shapes whose neighbours share their faces."""

from __future__ import annotations

import unittest
from typing import Any

import numpy as np
import Part
from FreeCAD import Vector
from parts import angle_block, drilled_block, face_uses, two_boxes_with_common_face

from freecad_tetra import convex_cells, tetrahedralize
from freecad_tetra.workbench import kernel_path, write_back


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
        inner = int((self.cells.facet_source < 0).sum())
        self.assertLessEqual(uses.count(2), inner // 2)
        self.assert_volumes(shape, self.cells)

    def test_cells_face_to_face_are_a_compsolid(self) -> None:
        cells = convex_cells(angle_block())
        shape = write_back.shape_of_pieces(cells)
        self.assertEqual((shape.ShapeType, len(shape.Solids)), ("CompSolid", 2))
        self.assertTrue(shape.isValid())
        self.assertEqual(face_uses(shape).count(2), 1)

    def test_ragged_cells_are_a_compound(self) -> None:
        post = Part.makeBox(4, 4, 1).fuse(Part.makeBox(1, 1, 3, Vector(1, 1, 1))).removeSplitter()
        cells = convex_cells(post, plain=True, merge=False)
        shape = write_back.shape_of_pieces(cells)
        self.assertTrue(shape.isValid())
        shared = face_uses(shape).count(2)
        inner = int((cells.facet_source < 0).sum())
        self.assertEqual(shape.ShapeType, "CompSolid" if 2 * shared == inner else "Compound")
        self.assertAlmostEqual(shape.Volume, post.Volume, delta=1e-9)

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

    def test_faces_know_their_pieces(self) -> None:
        for pieces in (self.mesh, self.cells):
            for explode in (0.0, 0.5):
                shape = write_back.shape_of_pieces(pieces, explode)
                sides = write_back.pieces_of_faces(pieces, explode)
                self.assertEqual(len(sides), len(shape.Faces))
                solids = [[f.hashCode() for f in s.Faces] for s in shape.Solids]
                for face, named in zip(shape.Faces, sides.tolist()):
                    for piece in (p for p in named if p >= 0):
                        self.assertIn(face.hashCode(), solids[piece])

    def assert_volumes(self, shape: Any, pieces: Any) -> None:
        volumes = [solid.Volume for solid in shape.Solids]
        np.testing.assert_allclose(volumes, pieces.volumes(), rtol=1e-9, atol=1e-12)
