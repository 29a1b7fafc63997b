# SPDX-License-Identifier: LGPL-2.1-or-later
"""The layer rule holds for this repository, and its checker notices each kind of breach."""

import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]


def check(root: Path) -> subprocess.CompletedProcess[str]:
    return subprocess.run(
        [sys.executable, ROOT / "tools/check_layers.py", root], capture_output=True, text=True
    )


def test_this_repository_keeps_the_layers() -> None:
    result = check(ROOT)
    assert (result.returncode, result.stderr) == (0, "")


ALLOWED = [
    ("kernel/src/solid/a.cpp", '#include "tetra/exact/grid.h"'),
    ("kernel/src/exact/a.cpp", "#include <tetra/errors.h>"),
    ("kernel/bindings/a.cpp", "#include <nanobind/nanobind.h>"),
    ("freecad_tetra/kernel.py", "import _tetra_kernel\nfrom freecad_tetra.model import Solid"),
    ("freecad_tetra/cli/a.py", "from freecad_tetra import io\nfrom ..export import obj"),
    ("freecad_tetra/brep/a.py", "from . import b\nfrom freecad_tetra.errors import E"),
]

BREACHES = [
    ("kernel/src/exact/a.cpp", '#include "tetra/solid/mesh.h"'),
    ("kernel/include/tetra/notch/a.h", "#include <tetra/fence/strip.h>"),
    ("kernel/include/tetra/errors.h", '#include "tetra/exact/grid.h"'),
    ("kernel/src/assemble/a.cpp", "#include <nanobind/nanobind.h>"),
    ("kernel/src/other/a.cpp", ""),
    ("freecad_tetra/errors.py", "from freecad_tetra.model import Solid"),
    ("freecad_tetra/io/a.py", "def f():\n    from freecad_tetra import kernel"),
    ("freecad_tetra/io/a.py", "from ..brep import shape"),
    ("freecad_tetra/model.py", "from . import cli"),
    ("freecad_tetra/brep/a.py", "import _tetra_kernel"),
    ("freecad_tetra/workbench/a.py", "import FreeCAD\nfrom OCP.gp import gp_Pnt"),
    ("freecad_tetra/helpers.py", ""),
]


def plant(root: Path, name: str, text: str) -> None:
    """Write ``text`` as file ``name`` in a package that has all modules the cases mention."""
    package = root / "freecad_tetra"
    package.mkdir()
    for module in ("errors", "model", "kernel"):
        (package / f"{module}.py").touch()
    for module in ("io", "brep", "export", "cli"):
        (package / module).mkdir()
    path = root / name
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(text)


@pytest.mark.parametrize(("name", "text"), ALLOWED)
def test_allowed(tmp_path: Path, name: str, text: str) -> None:
    plant(tmp_path, name, text)
    assert check(tmp_path).returncode == 0


@pytest.mark.parametrize(("name", "text"), BREACHES)
def test_breach_is_named(tmp_path: Path, name: str, text: str) -> None:
    plant(tmp_path, name, text)
    result = check(tmp_path)
    assert result.returncode == 1
    assert name in result.stderr
