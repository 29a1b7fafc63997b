# SPDX-License-Identifier: LGPL-2.1-or-later
"""Analyses made as a macro makes them, solved by CalculiX, against textbooks."""

from __future__ import annotations

import os
from typing import Any

import numpy as np
import ObjectsFem
import Part
from FreeCAD import Vector
from parts import InDocument

from freecad_tetra.workbench import compat, feature, fem_mesh, solve

STEEL = {"Name": "Steel", "YoungsModulus": "210000 MPa", "PoissonRatio": "0.30"}


class InAnalysis(InDocument):
    """A test with an analysis: solver and material; the mesh and the constraints are its own."""

    def setUp(self) -> None:
        super().setUp()
        self.analysis = ObjectsFem.makeAnalysis(self.doc, "Analysis")
        make = getattr(ObjectsFem, "makeSolverCalculiXCcxTools", None)
        solver = (make or ObjectsFem.makeSolverCalculixCcxTools)(self.doc, "Solver")
        solver.AnalysisType = "static"
        solver.GeometricalNonlinearity = "linear"
        solver.IterationsControlParameterTimeUse = False
        self.analysis.addObject(solver)

    def material(self, name: str = "Material", references: Any = (), **changes: str) -> Any:
        made = ObjectsFem.makeMaterialSolid(self.doc, name)
        made.Material = {**made.Material, **STEEL, **changes}
        made.References = list(references)
        self.analysis.addObject(made)
        return made

    def fixed(self, obj: Any, *faces: str) -> Any:
        made = ObjectsFem.makeConstraintFixed(self.doc, "Fixed")
        made.References = [(obj, face) for face in faces]
        self.analysis.addObject(made)
        return made

    def held(self, obj: Any, axis: str, *faces: str) -> Any:
        """Hold faces along one axis."""
        made = ObjectsFem.makeConstraintDisplacement(self.doc, f"Held{axis}")
        made.References = [(obj, face) for face in faces]
        for name in "xyz":
            setattr(made, f"{name}Free", name != axis)
            if hasattr(made, "xFix"):  # until FreeCAD 0.21
                setattr(made, f"{name}Fix", name == axis)
        self.analysis.addObject(made)
        return made

    def force(self, obj: Any, face: str, size: float, along: str, backward: bool = False) -> Any:
        """Load a face along a straight edge or the normal of a planar face."""
        made = ObjectsFem.makeConstraintForce(self.doc, "Load")
        made.References = [(obj, face)]
        made.Force = size if compat.version() < (0, 21) else f"{size} N"
        made.Direction = (obj, [along])
        made.Reversed = backward
        self.analysis.addObject(made)
        return made

    def pressure(self, obj: Any, face: str, size: float) -> Any:
        made = ObjectsFem.makeConstraintPressure(self.doc, "Pressure")
        made.References = [(obj, face)]
        made.Pressure = abs(size) if compat.version() < (0, 21) else f"{abs(size)} MPa"
        made.Reversed = size < 0
        self.analysis.addObject(made)
        return made

    def solved(self, obj: Any, **properties: Any) -> tuple[solve.Solution, Any]:
        """Mesh and solve; return the solution and the mesh object."""
        if properties.get("Quality"):
            self.want_programs()
        mesh = feature.make_fem_mesh(self.doc, obj, self.analysis, **properties)
        self.doc.recompute()
        self.assertEqual(mesh.State, ["Up-to-date"], mesh.getStatusString())
        return self.solution(), mesh

    def solution(self) -> solve.Solution:
        """Solve the analysis."""
        self.want_programs()
        return solve.solve(self.analysis)

    def want_programs(self) -> None:
        """End the test where CALCULIX is empty: such a system has neither ccx nor mmg3d."""
        if os.environ.get("CALCULIX") == "":
            self.skipTest("this system has no CalculiX and no mmg3d")

    def fields(self, solution: solve.Solution, mesh: Any) -> tuple[Any, Any, Any]:
        """Return nodes (n + 1, 3), displacements (n + 1, 3), stresses (n + 1, 6) by node."""
        nodes = fem_mesh.nodes_table(mesh.FemMesh)
        result = solution.result
        numbers = np.array(result.NodeNumbers)
        moved, stress = np.full((len(nodes), 3), np.nan), np.full((len(nodes), 6), np.nan)
        moved[numbers] = [tuple(v) for v in result.DisplacementVectors]
        names = ("NodeStressXX", "NodeStressYY", "NodeStressZZ", "NodeStressXY", "NodeStressXZ",
                 "NodeStressYZ")  # fmt: skip
        stress[numbers] = np.stack([getattr(result, name) for name in names], axis=1)
        return nodes, moved, stress


def face_where(obj: Any, test: Any) -> str:
    """Return the name of the one face of an object that passes a test."""
    found = [f"Face{i}" for i, face in enumerate(obj.Shape.Faces, 1) if test(face)]
    assert len(found) == 1, found
    return found[0]


def plane_at(axis: str, at: float) -> Any:
    """Return a test for planar faces across an axis."""

    def test(face: Any) -> bool:
        flat = face.Surface.TypeId == "Part::GeomPlane"
        return flat and abs(getattr(face.Surface.Axis, axis)) > 0.99 and near(face, axis, at)

    def near(face: Any, axis: str, at: float) -> bool:
        return abs(getattr(face.CenterOfMass, axis) - at) < 1e-6

    return test


def cylinder_of(radius: float) -> Any:
    """Return a test for faces of a cylinder."""
    return lambda face: (
        face.Surface.TypeId == "Part::GeomCylinder" and abs(face.Surface.Radius - radius) < 1e-9
    )


class Cantilever(InAnalysis):
    def check(self, **properties: Any) -> None:
        beam = self.feature_of(Part.makeBox(80, 10, 10))
        root, tip = face_where(beam, plane_at("x", 0)), face_where(beam, plane_at("x", 80))
        self.material()
        self.fixed(beam, root)
        self.force(beam, tip, 1000, face_where(beam, plane_at("z", 0)), True)
        solution, mesh = self.solved(beam, **properties)
        nodes, moved, _ = self.fields(solution, mesh)
        theory = 1000 * 80**3 / (3 * 210_000 * 10**4 / 12)
        at_tip = np.abs(nodes[:, 0] - 80) < 1e-9
        self.assertAlmostEqual(-moved[at_tip, 2].mean() / theory, 1, delta=0.01)
        np.testing.assert_allclose(solution.reactions["FIXED"], [0, 0, 1000], atol=1)

    def test_is_within_a_hundredth_of_beam_theory(self) -> None:
        self.check()

    def test_with_quality(self) -> None:
        self.check(Quality=True)


class Tube(InAnalysis):
    """A quarter tube of radii 10 and 20 mm, 10 MPa inside, plane strain: Lame."""

    def check(self, **properties: Any) -> None:
        ring = Part.makeCylinder(20, 10, Vector(), Vector(0, 0, 1), 90).cut(
            Part.makeCylinder(10, 10)
        )
        tube = self.feature_of(ring)
        bore = face_where(tube, cylinder_of(10))
        self.material()
        self.held(tube, "x", face_where(tube, plane_at("x", 0)))
        self.held(tube, "y", face_where(tube, plane_at("y", 0)))
        self.held(
            tube, "z", face_where(tube, plane_at("z", 0)), face_where(tube, plane_at("z", 10))
        )
        self.pressure(tube, bore, 10)
        solution, mesh = self.solved(tube, **properties)
        (row,) = [row for row in solution.rows if row.what == "pressed area"]
        self.assertAlmostEqual(row.found / row.wanted, 1, delta=0.01)
        nodes, _, stress = self.fields(solution, mesh)
        inner = np.abs(np.hypot(nodes[:, 0], nodes[:, 1]) - 10) < 1e-7
        x, y = nodes[inner, 0] / 10, nodes[inner, 1] / 10
        s = stress[inner]
        hoop = s[:, 0] * y**2 + s[:, 1] * x**2 - 2 * s[:, 3] * x * y
        radial = s[:, 0] * x**2 + s[:, 1] * y**2 + 2 * s[:, 3] * x * y
        np.testing.assert_allclose(hoop, 10 * 500 / 300, rtol=0.03)
        self.assertAlmostEqual(radial.mean(), -10, delta=0.3)
        np.testing.assert_allclose(radial, -10, atol=0.03 * 10 * 500 / 300)
        # The pressure on a quarter of the bore pushes with p r l each way.
        self.assertAlmostEqual(solution.reactions["HELDX"][0] / -1000, 1, delta=1e-3)
        self.assertAlmostEqual(solution.reactions["HELDY"][1] / -1000, 1, delta=1e-3)

    def test_is_within_3_percent_of_lame_after_refinement(self) -> None:
        # Few wide facets, whose refinements follow the CAD: many narrow ones would stay narrow.
        coarse = {"LinearDeflection": 5, "AngularDeflection": 30, "ElementSize": 4}
        self.check(Refinement=1, **coarse)

    def test_with_quality(self) -> None:
        self.check(Quality=True)


class Plate(InAnalysis):
    def check(self, **properties: Any) -> None:
        """A quarter of a plate 200 x 100 x 4 mm with a hole of 20 mm, pulled with 100 MPa."""
        plate = self.feature_of(Part.makeBox(100, 50, 4).cut(Part.makeCylinder(10, 4)))
        self.material()
        for axis in "xyz":
            self.held(plate, axis, face_where(plate, plane_at(axis, 0)))
        self.pressure(plate, face_where(plate, plane_at("x", 100)), -100)
        solution, mesh = self.solved(plate, **properties)
        nodes, _, stress = self.fields(solution, mesh)
        top = (np.abs(nodes[:, 0]) < 1e-7) & (np.abs(nodes[:, 1] - 10) < 1e-7)
        known = 3 - 3.14 * 0.2 + 3.667 * 0.2**2 - 1.527 * 0.2**3  # Heywood, on the net section
        self.assertAlmostEqual(stress[top, 0].mean() / (100 / 0.8) / known, 1, delta=0.05)
        self.assertAlmostEqual(solution.reactions["HELDX"][0] / -20_000, 1, delta=1e-3)

    def test_has_the_known_stress_concentration(self) -> None:
        self.check(Quality=True, ElementsPerTurn=24)


class Bar(InAnalysis):
    """Two bars of 40 x 10 x 10 mm end to end, the second three times as soft, pulled by 1000 N."""

    def check(self, **properties: Any) -> None:
        both, _ = Part.makeBox(40, 10, 10).generalFuse([Part.makeBox(40, 10, 10, Vector(40, 0, 0))])
        bar = self.feature_of(both)
        self.material("Hard", [(bar, "Solid1")], PoissonRatio="0.0")
        self.material("Soft", [(bar, "Solid2")], PoissonRatio="0.0", YoungsModulus="70000 MPa")
        self.fixed(bar, face_where(bar, plane_at("x", 0)))
        self.pressure(bar, face_where(bar, plane_at("x", 80)), -10)
        solution, mesh = self.solved(bar, **properties)
        nodes, moved, stress = self.fields(solution, mesh)
        first = 10 / 210_000 * 40
        for at, wanted in ((40, first), (80, first + 3 * first)):
            section = np.abs(nodes[:, 0] - at) < 1e-7
            np.testing.assert_allclose(moved[section, 0], wanted, rtol=1e-4)
        np.testing.assert_allclose(stress[1:, 0], 10, rtol=1e-3)
        np.testing.assert_allclose(solution.reactions["FIXED"], [-1000, 0, 0], atol=1)

    def test_strain_is_inverse_to_the_modulus(self) -> None:
        self.check()

    def test_with_quality(self) -> None:
        self.check(Quality=True)
