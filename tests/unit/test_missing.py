# SPDX-License-Identifier: LGPL-2.1-or-later
"""Without the optional packages there is one clear line with the pip command; the rest works."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
OPTIONAL = ["OCP", "cadquery", "build123d", "trimesh", "meshio", "pyvista", "vtk", "vtkmodules",
            "mujoco", "pybullet", "gmsh", "scipy", "PIL", "matplotlib", "manifold3d"]  # fmt: skip

# Nothing of what is optional can be imported, as in a bare environment with numpy alone.
BARE = f"""
import sys
sys.path.insert(0, {str(ROOT)!r})
class Blocked:
    def find_spec(self, name, path=None, target=None):
        if name.split(".")[0] in {OPTIONAL!r}:
            raise ModuleNotFoundError(f"No module named {{name!r}}", name=name)
sys.meta_path.insert(0, Blocked())
import numpy as np
import freecad_tetra as ft
box = np.array([(x, y, z) for x in (0, 1) for y in (0, 1) for z in (0, 1)], float)
sides = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]
triangles = [t for a, b, c, d in sides for t in ((a, b, c), (a, c, d))]
mesh, cells = ft.tetrahedralize((box, triangles)), ft.convex_cells((box, triangles))
"""


def run(code: str) -> subprocess.CompletedProcess[str]:
    return subprocess.run(
        [sys.executable, "-c", BARE + code],
        capture_output=True,
        text=True,
        timeout=120,
        check=False,
    )


@pytest.mark.parametrize(
    ("call", "command"),
    [
        ("cells.to_trimesh()", "pip install trimesh"),
        ("mesh.to_scene()", "pip install trimesh"),
        ("mesh.to_meshio()", "pip install meshio"),
        ("cells.to_pyvista()", "pip install pyvista"),
        ("cells.plot()", "pip install pyvista"),
        ("cells.to_cadquery()", "pip install cadquery"),
        ("mesh.to_build123d()", "pip install build123d"),
        ("import freecad_tetra.cq", "pip install cadquery"),
        (
            f"ft.as_solid({str(ROOT / 'resources/parts/bracket.step')!r})",
            "pip install cadquery-ocp",
        ),
        ("cells.write('cells.step')", "pip install cadquery-ocp"),
    ],
)
def test_one_line_names_the_pip_command(call: str, command: str) -> None:
    done = run(f"\ntry:\n    {call}\nexcept ft.MissingDependency as error:\n    print(error)\n")
    assert done.returncode == 0, done.stderr
    assert done.stdout.count("\n") == 1
    assert done.stdout.rstrip().endswith(command)


def test_everything_else_works_without_them(tmp_path: Path) -> None:
    done = run(
        f"""
from pathlib import Path
folder = Path({str(tmp_path)!r})
for name in ("m.vtu", "m.msh", "m.inp", "m.mesh", "m.vtk"):
    mesh.write(folder / name)
for name in ("c.obj", "c.vtu", "c.glb", "c.brep"):
    cells.write(folder / name)
cells.write_mjcf(folder / "b.xml")
cells.write_urdf(folder / "b.urdf")
cells.write_sdf(folder / "b.sdf")
mesh.write_drake(folder / "d.sdf")
(folder / "v.html").write_text(mesh.to_html())
assert "iframe" in cells._repr_html_()
ft.convex_cells((box, triangles), max_cells=1, max_vertices=8)
from freecad_tetra.cli import main
assert main(["picture", str(folder / "c.obj"), "-o", str(folder / "c.png"), "--width", "80"]) == 0
print(sorted(p.name for p in folder.iterdir()))
"""
    )
    assert done.returncode == 0, done.stderr
    assert "'c.png'" in done.stdout and "'v.html'" in done.stdout
