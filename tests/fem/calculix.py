# SPDX-License-Identifier: LGPL-2.1-or-later
"""Decks for CalculiX around a mesh file of ours, and what CalculiX found: for tests only."""

from __future__ import annotations

import subprocess
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from freecad_tetra import export
from freecad_tetra.fem import triangles
from freecad_tetra.fem.groups import Group, face_groups
from freecad_tetra.model import Tet10Mesh, TetMesh

STEEL = (210_000.0, 0.3)  # MPa
Mesh = TetMesh | Tet10Mesh


@dataclass(frozen=True)
class Found:
    """Displacements and stresses (xx yy zz xy yz zx) by node, and reactions by node set."""

    displacement: np.ndarray
    stress: np.ndarray
    reaction: dict[str, np.ndarray]


def face_at(mesh: Mesh, test: object) -> Group:
    """Return the one face group all of whose nodes satisfy ``test(points)``."""
    found = [g for g in face_groups(mesh) if np.all(test(mesh.points[g.nodes]))]  # type: ignore[operator]
    assert len(found) == 1, [g.name for g in found]
    return found[0]


def force(mesh: Mesh, group: Group, vector: Sequence[float]) -> list[str]:
    """Return *CLOAD lines of a force spread evenly over a face."""
    rows = mesh.skin[group.elements]
    share = triangles.shares(mesh.points, rows)
    total = np.bincount(rows.reshape(-1), weights=share.reshape(-1), minlength=len(mesh.points))
    total /= total.sum()
    lines = ["*CLOAD"]
    for node in np.flatnonzero(total).tolist():
        lines += [f"{node + 1},{k + 1},{f * total[node]:.14g}" for k, f in enumerate(vector) if f]
    return lines


def solve(
    folder: Path,
    mesh: Mesh,
    fixed: dict[str, Sequence[int]],
    loads: Sequence[str],
    materials: dict[str, tuple[float, float]] | None = None,
    limit: float = 300,
) -> Found:
    """Solve a linear static step; `fixed` gives degrees of freedom (1 to 3) by node set."""
    export.write(mesh, folder / "mesh.inp")
    deck = ["*INCLUDE, INPUT=mesh.inp"]
    for number, (elements, (e, nu)) in enumerate((materials or {"Eall": STEEL}).items()):
        deck += [f"*MATERIAL, NAME=M{number}", "*ELASTIC", f"{e},{nu}"]
        deck += [f"*SOLID SECTION, ELSET={elements}, MATERIAL=M{number}"]
    deck += ["*BOUNDARY"]
    deck += [f"{name},{k}" for name, freedoms in fixed.items() for k in freedoms]
    deck += ["*STEP", "*STATIC", *loads, "*NODE FILE", "U", "*EL FILE", "S"]
    for name in fixed:
        deck += [f"*NODE PRINT, NSET={name}, TOTALS=ONLY", "RF"]
    deck += ["*END STEP", ""]
    (folder / "job.inp").write_text("\n".join(deck))
    done = subprocess.run(
        ["ccx", "-i", "job"], cwd=folder, capture_output=True, text=True, timeout=limit, check=False
    )
    assert done.returncode == 0 and "ERROR" not in done.stdout, done.stdout[-2000:]
    count = len(mesh.points)
    blocks = frd(folder / "job.frd", count)
    return Found(blocks["DISP"], blocks["STRESS"], reactions(folder / "job.dat"))


def frd(path: Path, count: int) -> dict[str, np.ndarray]:
    """Return the nodal blocks of an ascii .frd, rows by node."""
    out: dict[str, np.ndarray] = {}
    name = ""
    for line in path.read_text().splitlines():
        if line.startswith(" -4"):
            name = line.split()[1]
            out[name] = np.full((count, {"DISP": 3, "STRESS": 6}.get(name, 1)), np.nan)
        elif line.startswith(" -3"):
            name = ""
        elif line.startswith(" -1") and name in ("DISP", "STRESS"):
            values = [float(line[13 + 12 * k : 25 + 12 * k]) for k in range(out[name].shape[1])]
            out[name][int(line[3:13]) - 1] = values
    return out


def reactions(path: Path) -> dict[str, np.ndarray]:
    """Return the total forces of a .dat by node set."""
    out = {}
    name = ""
    for line in path.read_text().splitlines():
        if "total force" in line:
            name = line.split("for set")[1].split()[0]
        elif name and line.strip():
            out[name] = np.array([float(word) for word in line.split()])
            name = ""
    return out
