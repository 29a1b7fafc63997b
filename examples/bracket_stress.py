# SPDX-License-Identifier: LGPL-2.1-or-later
"""From a STEP file to von Mises stress, in FreeCAD without a window, solved by CalculiX.

Usage: ``freecadcmd bracket_stress.py``; wants the packages freecad and calculix-ccx. The wall side
of the bundled bracket is fixed, its pad carries 1000 N downwards.
"""

import sys
from pathlib import Path

import FreeCAD
import ObjectsFem
import Part

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))

from freecad_tetra.fem import mmg
from freecad_tetra.kernel_file import checkout_packages
from freecad_tetra.workbench import feature, solve

PART = Path(__file__).resolve().parents[1] / "resources/parts/bracket.step"


def main() -> None:
    """Build the analysis, solve it and print its figures."""
    doc = FreeCAD.newDocument("Bracket")
    bracket = doc.addObject("Part::Feature", "Bracket")
    bracket.Shape = Part.read(str(PART))
    analysis = ObjectsFem.makeAnalysis(doc, "Analysis")
    solver = ObjectsFem.makeSolverCalculixCcxTools(doc, "Solver")
    solver.GeometricalNonlinearity = "linear"
    steel = ObjectsFem.makeMaterialSolid(doc, "Steel")
    steel.Material = {"Name": "Steel", "YoungsModulus": "210000 MPa", "PoissonRatio": "0.30"}
    fixed = ObjectsFem.makeConstraintFixed(doc, "Fixed")
    fixed.References = [(bracket, "Face1")]
    load = ObjectsFem.makeConstraintForce(doc, "Load")
    load.References = [(bracket, "Face41")]
    load.Force, load.Direction, load.Reversed = 1000.0, (bracket, ["Face41"]), True
    for member in (solver, steel, fixed, load):
        analysis.addObject(member)
    quality = mmg.find(checkout_packages()) is not None  # better elements, where mmg3d is at hand
    mesh = feature.make_fem_mesh(doc, bracket, analysis, Quality=quality)
    doc.recompute()
    solution = solve.solve(analysis)
    print(f"{mesh.FemMesh.VolumeCount} tetrahedra, {mesh.FemMesh.NodeCount} nodes")
    for row in solution.rows:
        print(row)
    print("reaction of the wall", [round(x, 2) for x in solution.reactions["FIXED"]], "N")
    print(f"largest von Mises stress {max(solution.result.vonMises):.2f} MPa")
    print(f"largest displacement {max(solution.result.DisplacementLengths):.4f} mm")
    doc.saveAs(str(Path.cwd() / "bracket_stress.FCStd"))


main()
