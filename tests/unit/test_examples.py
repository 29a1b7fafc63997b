# SPDX-License-Identifier: LGPL-2.1-or-later
"""The scripts below examples/ and the README's lines do what they say, each in its process."""

import os
import re
import subprocess
import sys
from pathlib import Path

import meshio
import mujoco
import numpy as np
import pytest
import shapes
import trimesh

from freecad_tetra import api

ROOT = Path(__file__).resolve().parents[2]
EXAMPLES = ROOT / "examples"
# OpenCascade's own volume of the B-rep; the round bore is the one curved face.
BRACKET_VOLUME = 75917.1243
TETRA = Path(sys.executable).with_name("freecad-tetra")


def run(*command: object, cwd: Path = ROOT, **settings: str) -> str:
    done = subprocess.run(
        [*map(str, command)],
        cwd=cwd,
        capture_output=True,
        text=True,
        timeout=300,
        check=False,
        env={**os.environ, "PYTHONPATH": str(ROOT), **settings},
    )
    assert done.returncode == 0, done.stderr
    return done.stdout


def example(name: str, *words: object) -> str:
    return run(sys.executable, EXAMPLES / name, *words)


def test_there_are_six_scripts_of_forty_lines_at_most() -> None:
    files = sorted(f for f in EXAMPLES.glob("*.py") if f.name != "bracket_stress.py")  # docs/fem.md
    assert len(files) == 6
    assert all(len(file.read_text().splitlines()) <= 40 for file in files)


def test_cadquery_script_writes_groups_and_cells(tmp_path: Path) -> None:
    told = example("cadquery_mesh.py", tmp_path)
    tets, cells = (float(v) for v in re.findall(r"([\d.]+) mm3", told))
    assert tets == pytest.approx(cells, rel=1e-9)
    assert '2 8 "clamped"' in (tmp_path / "plate.msh").read_text()
    assert "*SURFACE, NAME=clamped_surface" in (tmp_path / "plate.inp").read_text()
    assert api.as_solid(tmp_path / "cells.step").volume() == pytest.approx(tets, rel=1e-6)


def test_build123d_script_keeps_labels(tmp_path: Path) -> None:
    told = example("build123d_cells.py", tmp_path)
    assert re.search(r"^\d+ convex cells of block, pin$", told, re.MULTILINE)
    block = [float(v) for v in re.findall(r"^block_cell_\d+ +([\d.]+) mm3$", told, re.MULTILINE)]
    assert sum(block) == pytest.approx(40 * 30 * 20 - 20 * 10 * 10, rel=1e-9)
    assert (tmp_path / "cells.step").stat().st_size > 1000


def test_trimesh_script_gives_exact_parts(tmp_path: Path) -> None:
    told = example("trimesh_decomposition.py", tmp_path)
    assert "25 exact parts, all convex: True" in told
    cup, parts = re.findall(r"[\d.]+", told.splitlines()[1])
    assert cup == parts
    assert len(trimesh.load(tmp_path / "cup.glb").geometry) == 13


def test_mujoco_script_drops_the_peg(tmp_path: Path) -> None:
    told = example("mujoco_peg.py", tmp_path)
    hole, wall = (float(v) for v in re.findall(r"at (-?[\d.]+) m", told))
    assert hole < -0.5 and 0.01 < wall < 0.03
    assert mujoco.MjModel.from_xml_path(str(tmp_path / "plate.xml")).ngeom > 8


def test_stl_script_meshes_and_names_defects(tmp_path: Path) -> None:
    shape = shapes.square_frame()
    part, out = tmp_path / "frame.stl", tmp_path / "frame.vtu"
    trimesh.Trimesh(shape.vertices, shape.triangles, process=False).export(part)
    assert re.match(
        r"\d+ tetrahedra, \d+ points, 0 of them new\n", example("stl_to_tets.py", part, out)
    )
    tets = meshio.read(out).points[meshio.read(out).cells_dict["tetra"]]
    volume = np.linalg.det(tets[:, 1:] - tets[:, :1]).sum() / 6
    assert volume == pytest.approx(float(shape.volume), rel=1e-12)
    trimesh.Trimesh(shape.vertices, shape.triangles[1:], process=False).export(part)
    command = [sys.executable, EXAMPLES / "stl_to_tets.py", part, tmp_path / "none.vtu"]
    done = subprocess.run(command, capture_output=True, text=True, timeout=120, check=False)
    assert done.returncode == 1 and "open_edge" in done.stderr and "Traceback" not in done.stderr
    assert not (tmp_path / "none.vtu").exists()


def test_freecad_macro_makes_a_compound_in_the_real_freecad(tmp_path: Path) -> None:
    told = run(
        "freecadcmd", EXAMPLES / "freecad_macro.py", cwd=tmp_path,
        FREECAD_TETRA=str(TETRA), FREECAD_USER_HOME=str(tmp_path), PYTHONPATH="",
    )  # fmt: skip
    assert "5 solids, 22000 mm3" in told  # 40 x 30 x 20 without 20 x 10 x 10


def readme() -> list[str]:
    return re.findall(r"```python\n(.*?)```", (ROOT / "README.md").read_text(), re.DOTALL)


def test_readme_begins_with_six_lines_of_cadquery_that_write_a_mesh(tmp_path: Path) -> None:
    code = readme()[0]
    lines = [line for line in code.splitlines() if line]
    assert len(lines) == 6 and code.startswith("import cadquery")
    output = run(sys.executable, "-c", code, cwd=tmp_path)
    found = re.match(r"(\d+) tetrahedra, ([\d.]+) mm3\n", output)
    assert found
    mesh = meshio.read(tmp_path / "part.msh")
    assert len(mesh.cells_dict["tetra"]) == int(found[1])
    exact = 60 * 40 * 9 - np.pi * 36 * 9
    assert float(found[2]) == pytest.approx(exact, rel=1e-3)
    assert "fixed" in mesh.field_data


def test_readme_s_cells_run() -> None:
    output = run(sys.executable, "-c", readme()[1])
    found = re.match(r"(\d+) convex cells, ([\d.]+) mm3\n", output)
    assert found
    assert float(found[2]) == pytest.approx(BRACKET_VOLUME, rel=1e-3)
    assert len(output.splitlines()) == 1 + int(found[1])
