# SPDX-License-Identifier: LGPL-2.1-or-later
"""Real parts go through the command line and the independent judge.

They lie beside the repository, in ``../shared/corpus``. The short run takes the parts with the
fewest triangles of each folder; ``-m slow`` takes all.
"""

from __future__ import annotations

import json
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

SHARED = Path(__file__).parents[3] / "shared"
CORPUS = SHARED / "corpus"
SHORT = {"off": 24_000, "family": 12_000, "brep": 36_000}  # bytes

COMMAND = [sys.executable, "-m", "freecad_tetra"]


def parts(folder: str) -> list[object]:
    files = sorted((CORPUS / folder).glob("*")) if CORPUS.is_dir() else []
    rows = [
        pytest.param(
            p, id=p.stem, marks=() if p.stat().st_size < SHORT[folder] else pytest.mark.slow
        )
        for p in files
    ]
    reason = f"{CORPUS} is not here"
    return rows or [pytest.param(None, marks=pytest.mark.skip(reason=reason))]


def run(*words: object) -> subprocess.CompletedProcess[str]:
    return subprocess.run([*COMMAND, *map(str, words)], capture_output=True, text=True, timeout=600)


def judged(kind: str, surface: Path, out: Path) -> None:
    judge = [sys.executable, str(SHARED / "check" / "verify.py"), kind, str(surface), str(out)]
    if kind == "cells":
        judge += ["--samples", "1000"]
    done = subprocess.run(judge, capture_output=True, text=True, timeout=600)
    assert done.returncode == 0, done.stdout + done.stderr


@pytest.mark.parametrize("kind", ["cells", "tets"])
@pytest.mark.parametrize("path", [*parts("off"), *parts("family")])
def test_meshes(tmp_path: Path, path: Path, kind: str) -> None:
    out = tmp_path / ("out.obj" if kind == "cells" else "out.vtu")
    done = run(kind, path, "-o", out)
    assert done.returncode == 0, done.stderr
    judged(kind, path, out)


@pytest.mark.parametrize("path", [*parts("off"), *parts("family")])
def test_tetrahedra_of_cells(tmp_path: Path, path: Path) -> None:
    out = tmp_path / "out.vtu"
    done = run("tets", path, "--method", "bajaj-dey", "-o", out)
    assert done.returncode == 0, done.stderr
    judged("tets", path, out)


@pytest.mark.parametrize("kind", ["cells", "tets"])
@pytest.mark.parametrize("path", parts("brep"))
def test_breps(tmp_path: Path, path: Path, kind: str) -> None:
    out = tmp_path / ("out.obj" if kind == "cells" else "out.vtu")
    surface, report = tmp_path / "surface.off", tmp_path / "report.json"
    done = run(kind, path, "-o", out, "--surface", surface, "--report", report)
    assert done.returncode == 0, done.stderr
    judged(kind, surface, out)
    told = json.loads(report.read_text())
    wanted = told["details"]["surface"]["brep_volume"]
    assert told["volume"] == pytest.approx(wanted, rel=0.01)


@pytest.mark.parametrize("path", parts("brep"))
def test_tessellations_are_closed(path: Path) -> None:
    pytest.importorskip("OCP", reason="cadquery-ocp is not installed")
    from freecad_tetra import as_solid

    solid = as_solid(path)
    t, n = solid.triangles.astype(np.int64), len(solid.vertices)
    ends = np.concatenate([t[:, [0, 1]], t[:, [1, 2]], t[:, [2, 0]]])
    there, back = np.sort(ends[:, 0] * n + ends[:, 1]), np.sort(ends[:, 1] * n + ends[:, 0])
    assert np.array_equal(there, back), "every edge has its opposite"
    doubled = int((np.diff(there) == 0).sum())
    assert doubled == (10 if path.stem.startswith("Page_061") else 0), "only type 2 edges repeat"
    assert solid.volume() > 0
    assert len(np.unique(solid.vertices, axis=0)) == n


@pytest.mark.parametrize("count", [2, 3, 4, 6, 8])
def test_lower_bound_family(tmp_path: Path, count: int) -> None:
    path = CORPUS / "family" / f"chazelle-{count}.off"
    if not path.is_file():
        pytest.skip(f"{CORPUS} is not here")
    report = tmp_path / "report.json"
    words = ["cells", path, "-o", tmp_path / "out.obj", "--report", report]
    assert run(*words).returncode == 0
    assert json.loads(report.read_text())["counts"]["pieces"] <= (count + 2) ** 2
    assert run(*words, "--plain", "--no-merge").returncode == 0
    told = json.loads(report.read_text())
    assert told["counts"]["pieces"] <= told["bounds"]["bajaj_dey"]
