# SPDX-License-Identifier: LGPL-2.1-or-later
"""Analyses by CalculiX on meshes of ours against textbooks; reactions equal the loads."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import calculix as cx
import numpy as np
import parts
import pytest

from freecad_tetra import fem_mesh
from freecad_tetra.errors import TetraError
from freecad_tetra.fem.quality import quality

FINE = {"quality": True}
# Few wide facets, whose refinements follow the CAD: many narrow ones would stay narrow.
REFINED = {"linear_deflection": 5, "angular_deflection": 30, "size": 6, "refine": 1}


def reaction(found: cx.Found, *sets: str) -> np.ndarray:
    by_name = {name.upper(): value for name, value in found.reaction.items()}
    return sum(by_name[name.upper()] for name in sets)  # type: ignore[return-value]


def plane(axis: int, at: float) -> Any:
    return lambda points: np.abs(points[:, axis] - at) < 1e-7


@pytest.mark.parametrize("options", [{}, FINE])
def test_cantilever_is_within_a_hundredth_of_beam_theory(
    tmp_path: Path, options: dict[str, Any]
) -> None:
    mesh = fem_mesh(parts.beam(), **options)
    root, tip = cx.face_at(mesh, plane(0, 0)), cx.face_at(mesh, plane(0, 80))
    loads = cx.force(mesh, tip, (0, 0, -1000))
    found = cx.solve(tmp_path, mesh, {root.name: (1, 2, 3)}, loads)
    theory = 1000 * 80**3 / (3 * 210_000 * 10**4 / 12)
    assert -found.displacement[tip.nodes, 2].mean() == pytest.approx(theory, rel=0.01)
    assert reaction(found, root.name) == pytest.approx([0, 0, 1000], abs=1)


@pytest.mark.parametrize("options", [REFINED, FINE])
def test_tube_under_pressure_is_within_3_percent_of_lame(
    tmp_path: Path, options: dict[str, Any]
) -> None:
    """A quarter tube of radii 10 and 20, 10 MPa inside, plane strain."""
    mesh = fem_mesh(parts.quarter_tube(), **options)
    inner = cx.face_at(mesh, lambda p: np.hypot(p[:, 0], p[:, 1]) < 10 + 1e-6)
    cuts = [cx.face_at(mesh, plane(*at)) for at in ((0, 0), (1, 0), (2, 0), (2, 10))]
    fixed = {cut.name: (axis,) for cut, axis in zip(cuts, (1, 2, 3, 3))}
    found = cx.solve(tmp_path, mesh, fixed, ["*DSLOAD", f"{inner.name}_surface,P,10"])
    x, y = mesh.points[inner.nodes, 0] / 10, mesh.points[inner.nodes, 1] / 10
    assert np.abs(np.hypot(x, y) - 1).max() < 1e-8, "every node is on the cylinder"
    stress = found.stress[inner.nodes]
    hoop = stress[:, 0] * y**2 + stress[:, 1] * x**2 - 2 * stress[:, 3] * x * y
    radial = stress[:, 0] * x**2 + stress[:, 1] * y**2 + 2 * stress[:, 3] * x * y
    assert hoop == pytest.approx(10 * 500 / 300, rel=0.03)
    assert radial.mean() == pytest.approx(-10, rel=0.03)
    assert radial == pytest.approx(-10, abs=0.03 * 10 * 500 / 300), "of the greatest stress"
    # The pressure on a quarter of the bore pushes with p r l against each cut.
    assert reaction(found, cuts[0].name)[0] == pytest.approx(-1000, rel=1e-3)
    assert reaction(found, cuts[1].name)[1] == pytest.approx(-1000, rel=1e-3)


def test_plate_with_a_hole_has_the_known_concentration(tmp_path: Path) -> None:
    """d/w = 0.2: Peterson's factor on the net section, by Heywood's polynomial."""
    mesh = fem_mesh(parts.quarter_plate(), quality=True, turn=24)
    cuts = [cx.face_at(mesh, plane(axis, 0)) for axis in range(3)]
    end = cx.face_at(mesh, plane(0, 100))
    fixed = {cut.name: (axis,) for cut, axis in zip(cuts, (1, 2, 3))}
    found = cx.solve(tmp_path, mesh, fixed, ["*DSLOAD", f"{end.name}_surface,P,-100"])
    top = plane(0, 0)(mesh.points) & plane(1, 10)(mesh.points)
    share = 0.2
    known = 3 - 3.14 * share + 3.667 * share**2 - 1.527 * share**3
    factor = found.stress[top, 0].mean() / (100 / (1 - share))
    assert factor == pytest.approx(known, rel=0.05)
    assert reaction(found, cuts[0].name)[0] == pytest.approx(-100 * 50 * 4, rel=1e-3)


@pytest.mark.parametrize("options", [{}, FINE])
def test_bar_of_two_materials_splits_the_strain(tmp_path: Path, options: dict[str, Any]) -> None:
    """Bonded ends of one section under one force: strains are inverse to the moduli."""
    mesh = fem_mesh(parts.bonded_bar(), **options)
    root, end = cx.face_at(mesh, plane(0, 0)), cx.face_at(mesh, plane(0, 80))
    joint = cx.face_at(mesh, plane(0, 40))
    materials = {"Solid1": (210_000.0, 0.0), "Solid2": (70_000.0, 0.0)}
    pull = ["*DSLOAD", f"{end.name}_surface,P,-10"]
    found = cx.solve(tmp_path, mesh, {root.name: (1, 2, 3)}, pull, materials)
    first = 10 / 210_000 * 40
    assert found.displacement[joint.nodes, 0] == pytest.approx(first, rel=1e-4)
    assert found.displacement[end.nodes, 0] == pytest.approx(first + 3 * first, rel=1e-4)
    assert found.stress[:, 0] == pytest.approx(10, rel=1e-3)
    assert reaction(found, root.name) == pytest.approx([-1000, 0, 0], abs=1)


def test_quality_reaches_its_angle(tmp_path: Path) -> None:
    for part in (parts.beam(), parts.quarter_tube(), parts.quarter_plate()):
        mesh = fem_mesh(part, quality=True)
        assert np.degrees(quality(mesh).min_dihedral.min()) > 8
        assert not mesh.report.details["warnings"]


def test_what_is_poor_is_told() -> None:
    mesh = fem_mesh(parts.quarter_plate(), size=0)
    (line,) = mesh.report.details["warnings"]
    assert "dihedral angle below 8 degrees" in line and "ask for quality" in line


def test_quality_without_mmg_says_what_to_install(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("TETRA_MMG3D", "/nowhere/mmg3d")
    with pytest.raises(TetraError, match=r"mmg3d.*pip install mmgpy") as caught:
        fem_mesh(parts.beam(), quality=True)
    assert "least dihedral angle is" in str(caught.value)
