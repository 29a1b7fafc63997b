# SPDX-License-Identifier: LGPL-2.1-or-later
"""The scripts below examples/, the README's first lines and the demo part do what they say."""

import re
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from scipy.spatial import ConvexHull

from freecad_tetra.export.picture import read_cells

ROOT = Path(__file__).resolve().parents[2]
BRACKET = ROOT / "resources/parts/bracket.step"
# OpenCascade's own volume of the B-rep; the round bore is the one curved face.
BRACKET_VOLUME = 75917.1243


def run(*arguments: object) -> str:
    done = subprocess.run(
        [sys.executable, *map(str, arguments)],
        cwd=ROOT,
        capture_output=True,
        text=True,
        timeout=120,
        check=False,
    )
    assert done.returncode == 0, done.stderr
    return done.stdout


def test_collision_parts_are_convex_and_fill_the_bracket(tmp_path: Path) -> None:
    run("examples/collision_parts.py", BRACKET, tmp_path)
    total = 0.0
    for file in sorted(tmp_path.glob("cell_*.obj")):
        file.write_text("o cell\n" + file.read_text())
        ((facets),) = read_cells(file)
        origin = facets[0][0]
        volume = 0.0
        for facet in facets:
            a = facet - origin
            for i in range(1, len(a) - 1):
                volume += float(np.linalg.det(a[[0, i, i + 1]])) / 6.0
        # A closed polyhedron is convex when it fills its hull.
        assert volume == pytest.approx(ConvexHull(np.concatenate(facets)).volume, rel=1e-9)
        total += volume
    assert total == pytest.approx(BRACKET_VOLUME, rel=1e-3)


def test_readme_example_runs() -> None:
    (code,) = re.findall(r"```python\n(.*?)```", (ROOT / "README.md").read_text(), re.DOTALL)
    output = run("-c", code)
    found = re.match(r"(\d+) convex cells, ([\d.]+) mm3\n", output)
    assert found
    assert float(found[2]) == pytest.approx(BRACKET_VOLUME, rel=1e-3)
    assert len(output.splitlines()) == 1 + int(found[1])
