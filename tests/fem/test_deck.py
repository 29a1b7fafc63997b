# SPDX-License-Identifier: LGPL-2.1-or-later
"""``tets part.step -o part.inp --order 2`` gives a deck that CalculiX solves, with all groups."""

from __future__ import annotations

import json
import subprocess
import sys
from pathlib import Path

import calculix as cx
import numpy as np
import pytest

from freecad_tetra import fem_mesh

BRACKET = Path(__file__).resolve().parents[2] / "resources" / "parts" / "bracket.step"
meshio = pytest.importorskip("meshio", reason="meshio is not installed")


def run(*words: object) -> subprocess.CompletedProcess[str]:
    command = [sys.executable, "-m", "freecad_tetra", *map(str, words)]
    return subprocess.run(command, capture_output=True, text=True, timeout=300, check=False)


def test_deck_of_the_command_line_is_solved(tmp_path: Path) -> None:
    done = run("tets", BRACKET, "-o", tmp_path / "part.inp", "--order", "2", "--size", "15")
    assert done.returncode == 0, done.stderr
    assert "dihedral angle below 8 degrees" in done.stderr, "poor elements are told"
    steps = ["*INCLUDE, INPUT=part.inp", "*MATERIAL, NAME=STEEL", "*ELASTIC", "210000, 0.3",
             "*SOLID SECTION, ELSET=Eall, MATERIAL=STEEL", "*BOUNDARY", "Face1, 1, 3", "*STEP",
             "*STATIC", "*DSLOAD", "Face41_surface, P, 2", "*NODE PRINT, NSET=Face1, TOTALS=ONLY",
             "RF", "*END STEP", ""]  # fmt: skip
    (tmp_path / "job.inp").write_text("\n".join(steps))
    solved = subprocess.run(
        ["ccx", "-i", "job"], cwd=tmp_path, capture_output=True, text=True, timeout=300, check=False
    )
    assert solved.returncode == 0 and "ERROR" not in solved.stdout, solved.stdout[-1000:]
    # The pad is 608 mm2, under 2 MPa.
    assert cx.reactions(tmp_path / "job.dat")["FACE1"] == pytest.approx([0, 0, 1216], abs=1)


def test_groups_survive_inp_and_msh(tmp_path: Path) -> None:
    gmsh = pytest.importorskip("gmsh", reason="gmsh is not installed")
    for name in ("part.inp", "part.msh", "part.vtu"):
        assert run("tets", BRACKET, "-o", tmp_path / name, "--order", "2").returncode == 0
    vtu = meshio.read(tmp_path / "part.vtu")
    (skin,) = [i for i, block in enumerate(vtu.cells) if block.type == "triangle6"]
    face, rows = vtu.cell_data["face"][skin], vtu.cells[skin].data
    wanted = {f"Face{f + 1}": rounded(vtu.points[np.unique(rows[face == f])]) for f in set(face)}
    inp = meshio.read(tmp_path / "part.inp")
    for name, centres in wanted.items():
        assert rounded(inp.points[inp.point_sets[name]]) == centres
    gmsh.initialize()
    try:
        gmsh.option.setNumber("General.Terminal", 0)
        gmsh.open(str(tmp_path / "part.msh"))
        found = {}
        for dimension, tag in gmsh.model.getPhysicalGroups(2):
            _, flat = gmsh.model.mesh.getNodesForPhysicalGroup(dimension, tag)
            found[gmsh.model.getPhysicalName(dimension, tag)] = rounded(flat.reshape(-1, 3))
        solids = [gmsh.model.getPhysicalName(*g) for g in gmsh.model.getPhysicalGroups(3)]
    finally:
        gmsh.finalize()
    assert found == wanted and solids == ["Solid1"]


def rounded(points: np.ndarray) -> set[tuple[float, ...]]:
    return {tuple(p) for p in (np.round(points, 7) + 0.0).tolist()}


def test_quality_of_a_file(tmp_path: Path) -> None:
    out, report = tmp_path / "fine.vtu", tmp_path / "quality.json"
    assert run("tets", BRACKET, "-o", out, "--order", "2", "--quality").returncode == 0
    done = run("quality", out, "--report", report)
    assert done.returncode == 0 and "tet10" in done.stdout and "from 40" in done.stdout
    told = json.loads(report.read_text())["quality"]
    assert told["min_dihedral_degrees"] > 8 and told["nonpositive_jacobians"] == 0
    assert told["proven_positive"] == told["elements"]
    assert run("quality", tmp_path / "none.msh").returncode == 4
    (tmp_path / "bad.msh").write_text("nonsense")
    assert run("quality", tmp_path / "bad.msh").returncode == 4


@pytest.mark.parametrize("words", [("--refine", "9"), ("--face-size", "3=1"), ("--size", "-1")])
def test_wrong_words_are_usage(tmp_path: Path, words: tuple[str, ...]) -> None:
    assert run("tets", BRACKET, "-o", tmp_path / "a.vtu", *words).returncode == 2


def test_unknown_face_is_named(tmp_path: Path) -> None:
    done = run("tets", BRACKET, "-o", tmp_path / "a.vtu", "--quality", "--face-size", "Face99=1")
    assert done.returncode == 2 and "there is no face Face99; choose Face1 to Face52" in done.stderr


def test_mesh_input_keeps_its_facets(tmp_path: Path) -> None:
    path = tmp_path / "surface.off"
    assert run("info", BRACKET, "--surface", path).returncode == 0
    made = fem_mesh(path, size=0)
    assert made.report.details["fem"]["curved_middles"] == 0
    assert made.report.volume == pytest.approx(75919.67, rel=1e-6)
