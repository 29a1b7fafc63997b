# SPDX-License-Identifier: LGPL-2.1-or-later
"""Groups of faces, solids, constraints and materials, and that files keep them."""

from __future__ import annotations

import tempfile
from pathlib import Path
from typing import Any

import Fem
import FreeCAD
import numpy as np
import Part
from parts import drilled_block, two_boxes_with_common_face
from test_fem_analysis import InAnalysis, cylinder_of, face_where, plane_at

from freecad_tetra.workbench import constraints, feature, fem_feature, fem_mesh, load_check, solve


def contents(made: Any) -> dict[str, tuple[str, set[tuple[float, ...]]]]:
    """Return kind and centres of the members of every group: numbers may change in files."""
    nodes = {number: np.array(tuple(point)) for number, point in made.Nodes.items()}
    out = {}
    for number in made.Groups:
        kind = made.getGroupElementType(number)
        centres = set()
        for element in made.getGroupElements(number):
            ids = (element,) if kind == "Node" else made.getElementNodes(element)
            centre = np.mean([nodes[i] for i in ids], axis=0)
            centres.add(tuple(np.round(centre, 6) + 0.0))
        out[made.getGroupName(number)] = (kind, centres)
    return out


class Groups(InAnalysis):
    def block(self) -> tuple[Any, Any]:
        """Return a drilled block, fixed and pressed, and its mesh."""
        block = self.feature_of(drilled_block())
        self.material()
        self.fixed(block, face_where(block, plane_at("x", 0)))
        self.pressure(block, face_where(block, cylinder_of(3)), 5)
        mesh = feature.make_fem_mesh(self.doc, block, self.analysis)
        self.doc.recompute()
        self.assertEqual(mesh.State, ["Up-to-date"], mesh.getStatusString())
        return block, mesh

    def test_of_faces_solids_constraints_and_material(self) -> None:
        block, mesh = self.block()
        found = contents(mesh.FemMesh)
        for number in range(1, len(block.Shape.Faces) + 1):
            self.assertIn(f"Face{number}_Faces", found)
            self.assertEqual(found[f"Face{number}_Nodes"][0], "Node")
        self.assertEqual(len(found["Material_Volumes"][1]), mesh.FemMesh.VolumeCount)
        self.assertEqual(found["Solid1_Volumes"], found["Material_Volumes"])
        bore = face_where(block, cylinder_of(3))
        self.assertEqual(found["Pressure_Nodes"], found[f"{bore}_Nodes"])
        self.assertEqual(found["Pressure_Faces"], found[f"{bore}_Faces"])
        held = np.array(sorted(found["Fixed_Nodes"][1]))
        self.assertLess(np.abs(held[:, 0]).max(), 1e-9)

    def test_groups_are_those_that_freecad_finds_by_distance(self) -> None:
        block, mesh = self.block()
        for number, face in enumerate(block.Shape.Faces, 1):
            ours = fem_mesh.group_ids(mesh.FemMesh, f"Face{number}_Nodes").tolist()
            self.assertEqual(ours, sorted(mesh.FemMesh.getNodesByFace(face)))

    def test_follow_the_constraints(self) -> None:
        block, mesh = self.block()
        nodes = mesh.FemMesh.NodeCount
        fixed = self.doc.getObject("Fixed")
        other = face_where(block, plane_at("x", 10))
        fixed.References = [(block, other)]
        self.doc.recompute()
        found = contents(mesh.FemMesh)
        self.assertEqual(found["Fixed_Nodes"], found[f"{other}_Nodes"])
        self.assertEqual(mesh.FemMesh.NodeCount, nodes)
        late = self.fixed(block, face_where(block, plane_at("y", 0)))
        fem_feature.update_groups(mesh)
        self.assertIn(f"{late.Name}_Nodes", contents(mesh.FemMesh))

    def test_reference_to_another_object_is_found_by_geometry(self) -> None:
        block, mesh = self.block()
        copy = self.feature_of(block.Shape.copy(), "Copy")
        fixed = self.doc.getObject("Fixed")
        fixed.References = [(copy, face_where(copy, plane_at("y", 10)))]
        self.doc.recompute()
        found = contents(mesh.FemMesh)
        self.assertEqual(
            found["Fixed_Nodes"], found[f"{face_where(block, plane_at('y', 10))}_Nodes"]
        )
        self.assertEqual(constraints.faces_of(fixed, Part.makeBox(1, 1, 1)), None)

    def test_survive_documents_and_files(self) -> None:
        _, mesh = self.block()
        before = contents(mesh.FemMesh)
        with tempfile.TemporaryDirectory() as folder:
            for suffix in ("unv", "med"):
                path = str(Path(folder, f"mesh.{suffix}"))
                mesh.FemMesh.write(path)
                self.assertEqual(contents(Fem.read(path)), before, suffix)
            path = str(Path(folder, "mesh.FCStd"))
            self.doc.saveAs(path)
            name = mesh.Name
            FreeCAD.closeDocument(self.doc.Name)
            again = FreeCAD.openDocument(path)
            self.assertEqual(contents(again.getObject(name).FemMesh), before)

    def test_load_on_a_face_that_is_not_meshed_is_told(self) -> None:
        _, mesh = self.block()
        pressure = self.doc.getObject("Pressure")
        far = self.feature_of(Part.makeBox(1, 1, 1, FreeCAD.Vector(50, 0, 0)), "Far")
        pressure.References = [(far, "Face1")]
        self.doc.recompute()
        rows = [row for row in load_check.areas(self.analysis) if row.constraint == "Pressure"]
        self.assertEqual([row.found for row in rows], [0.0])
        self.assertFalse(rows[0].arrives)
        with self.assertRaises(load_check.LoadsLost) as caught:
            solve.solve(self.analysis)
        self.assertIn("Pressure: area of Far.Face1 0 of 1, 0.0 %", str(caught.exception))
        mesh.LoadCheck = "Error"
        pressure.References = [(far, "Face2")]
        self.doc.recompute()
        self.assertIn("Far.Face2", mesh.getStatusString())


class Materials(InAnalysis):
    def test_two_materials_have_a_group_each(self) -> None:
        pair = self.feature_of(two_boxes_with_common_face())
        first = self.material("Hard", [(pair, "Solid1")])
        rest = self.material("Soft")
        mesh = feature.make_fem_mesh(self.doc, pair, self.analysis)
        self.doc.recompute()
        self.assertEqual(mesh.State, ["Up-to-date"], mesh.getStatusString())
        found = contents(mesh.FemMesh)
        self.assertEqual(found[f"{first.Name}_Volumes"], found["Solid1_Volumes"])
        self.assertEqual(found[f"{rest.Name}_Volumes"], found["Solid2_Volumes"])
        self.assertFalse(found["Solid1_Volumes"][1] & found["Solid2_Volumes"][1])
