# SPDX-License-Identifier: LGPL-2.1-or-later
"""FEM meshes: nodes, tetrahedra as FreeCAD orients them, triangles on the skin."""

from __future__ import annotations

from typing import Any

import numpy as np
from parts import InDocument, angle_block, drilled_block, placement

from freecad_tetra.errors import BadOption
from freecad_tetra.workbench import feature


def tables(obj: Any) -> tuple[Any, Any, Any]:
    """Return nodes by number (n + 1, 3), tetrahedra and triangles by node numbers."""
    mesh = obj.FemMesh
    nodes = np.full((mesh.NodeCount + 1, 3), np.nan)
    for number, point in mesh.Nodes.items():
        nodes[number] = tuple(point)
    tets = np.array([mesh.getElementNodes(e) for e in mesh.Volumes])
    faces = np.array([mesh.getElementNodes(e) for e in mesh.Faces])
    return nodes, tets, faces


def determinants(nodes: Any, tets: Any) -> Any:
    corners = nodes[tets[:, :4]]
    return np.linalg.det(corners[:, 1:] - corners[:, :1])


class Mesh(InDocument):
    def test_of_a_solid_in_both_orders(self) -> None:
        block = self.feature_of(drilled_block())
        for order, of_tet, of_face in ((1, 4, 3), (2, 10, 6)):
            obj = feature.make_fem_mesh(self.doc, block, order=order)
            self.doc.recompute()
            self.assertEqual(obj.State, ["Up-to-date"], obj.getStatusString())
            nodes, tets, faces = tables(obj)
            self.assertEqual((tets.shape[1], faces.shape[1]), (of_tet, of_face))
            self.assertEqual(len(tets), obj.Pieces)
            signed = determinants(nodes, tets)
            self.assertTrue((signed < 0).all())
            if order == 1:
                self.assertAlmostEqual(
                    -signed.sum() / 6 / feature.source.solid_of(block).volume(), 1, delta=2e-3
                )
            else:
                self.assertTrue(np.isin(faces, tets).all())
                self.assertAlmostEqual(obj.FemMesh.Volume.Value / block.Shape.Volume, 1, delta=1e-3)

    def test_triangles_are_the_skin_and_look_outward(self) -> None:
        obj = feature.make_fem_mesh(self.doc, self.feature_of(angle_block()), order=1)
        self.doc.recompute()
        nodes, _, faces = tables(obj)
        corners = nodes[faces]
        enclosed = np.einsum("ij,ij->i", corners[:, 0], np.cross(corners[:, 1], corners[:, 2]))
        self.assertAlmostEqual(enclosed.sum() / 6, 7.0)

    def test_of_an_object_of_tetrahedra_where_it_lies(self) -> None:
        made = feature.make_tetrahedra(self.doc, self.feature_of(angle_block()))
        made.Placement = placement(0, 0, 30)
        self.doc.recompute()
        obj = feature.make_fem_mesh(self.doc, made)
        self.doc.recompute()
        nodes, tets, _ = tables(obj)
        self.assertGreaterEqual(len(tets), made.Pieces)
        self.assertAlmostEqual(np.nanmin(nodes[:, 2]), 30.0)

    def test_into_an_analysis(self) -> None:
        import ObjectsFem

        analysis = ObjectsFem.makeAnalysis(self.doc, "Analysis")
        obj = feature.make_fem_mesh(self.doc, self.feature_of(angle_block()), analysis)
        self.assertIn(obj, analysis.Group)

    def test_wrong_input_is_refused(self) -> None:
        block = self.feature_of(angle_block())
        for given in ({"order": 3}, {"Flatness": 1}):
            with self.assertRaises(BadOption):
                feature.make_fem_mesh(self.doc, block, **given)
        cells = feature.make_convex_cells(self.doc, block)
        self.doc.recompute()
        obj = feature.make_fem_mesh(self.doc, cells)
        self.doc.recompute()
        self.assertIn("holds no tetrahedra", obj.getStatusString())
