# SPDX-License-Identifier: LGPL-2.1-or-later
"""``tets part.step -o part.inp --order 2`` gives a deck that CalculiX solves, with all groups."""

from __future__ import annotations

import json
import subprocess
import sys
from pathlib import Path

import calculix as cx
import numpy as np
import parts
import pytest

from freecad_tetra import export, fem_mesh
from freecad_tetra.fem.groups import face_groups, solid_groups

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


def test_elements_of_groups_survive_inp_and_msh(tmp_path: Path) -> None:
    """Triangles of every face and tetrahedra of both solids, found again by their centres."""
    mesh = fem_mesh(parts.bonded_bar())
    faces = {g.name: centres(mesh.points[mesh.skin[g.elements, :3]]) for g in face_groups(mesh)}
    solids = {g.name: centres(mesh.points[mesh.tets[g.elements, :4]]) for g in solid_groups(mesh)}
    assert len(faces) == 11 and len(solids) == 2
    export.write(mesh, tmp_path / "bar.inp")
    assert groups_of_inp(tmp_path / "bar.inp") == faces | solids
    export.write(mesh, tmp_path / "bar.msh")
    assert groups_of_msh(tmp_path / "bar.msh") == faces | solids


def groups_of_inp(path: Path) -> dict[str, set[tuple[float, ...]]]:
    """Return the centres of the members of *ELEMENT, ELSET and *SURFACE."""
    sides = {"S1": [0, 1, 2], "S2": [0, 3, 1], "S3": [1, 3, 2], "S4": [2, 3, 0]}  # CalculiX's
    nodes: dict[int, list[float]] = {}
    corners: dict[int, np.ndarray] = {}
    found = {}
    for block in path.read_text().split("*")[1:]:
        head, *rows = [[word.strip() for word in line.split(",")] for line in block.splitlines()]
        options = dict(word.split("=") for word in head[1:])
        if head[0] == "NODE":
            nodes = {int(row[0]): [float(x) for x in row[1:]] for row in rows}
        elif head[0] == "ELEMENT":
            new = {int(row[0]): np.array([nodes[int(n)] for n in row[1:5]]) for row in rows}
            found[options["ELSET"]] = centres(np.array(list(new.values())))
            corners |= new
        elif head[0] == "SURFACE":
            triangles = np.array([corners[int(row[0])][sides[row[1]]] for row in rows])
            found[options["NAME"].removesuffix("_surface")] = centres(triangles)
    return found


def groups_of_msh(path: Path) -> dict[str, set[tuple[float, ...]]]:
    """Return the centres of the members of physical groups, as gmsh reads them."""
    gmsh = pytest.importorskip("gmsh", reason="gmsh is not installed")
    gmsh.initialize()
    try:
        gmsh.option.setNumber("General.Terminal", 0)
        gmsh.open(str(path))
        tags, flat, _ = gmsh.model.mesh.getNodes()
        points = np.zeros((int(tags.max()) + 1, 3))
        points[tags.astype(int)] = flat.reshape(-1, 3)
        found: dict[str, set[tuple[float, ...]]] = {}
        for group in gmsh.model.getPhysicalGroups():
            members = found.setdefault(gmsh.model.getPhysicalName(*group), set())
            for entity in gmsh.model.getEntitiesForPhysicalGroup(*group):
                _, (ids,), (rows,) = gmsh.model.mesh.getElements(group[0], entity)
                corners = rows.reshape(len(ids), -1)[:, : group[0] + 1].astype(int)
                members |= centres(points[corners])
    finally:
        gmsh.finalize()
    return found


def centres(corners: np.ndarray) -> set[tuple[float, ...]]:
    return rounded(corners.mean(axis=1))


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
