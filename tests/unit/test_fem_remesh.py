# SPDX-License-Identifier: LGPL-2.1-or-later
"""mmg gives good elements and keeps what is CAD; its files and its failures are understood."""

from __future__ import annotations

import stat
import sys
from pathlib import Path

import numpy as np
import pytest

from freecad_tetra.errors import Cancelled
from freecad_tetra.fem import mmg, skin
from freecad_tetra.fem.quality import quality
from freecad_tetra.fem.remesh import Sizes, face_radii, feature_lines, remesh
from freecad_tetra.fem.smooth import smooth
from freecad_tetra.fem.triangles import areas, face_areas, shares
from freecad_tetra.model import TetMesh

from .test_fem_second_order import BOTTOM, SIDE, TOP, prism, to_cylinder


@pytest.fixture(scope="module")
def program() -> Path:
    found = mmg.find()
    assert found is not None, "pip install -r tools/requirements.txt"
    return found


def test_slivers_become_good_and_the_cylinder_stays_one(program: Path) -> None:
    mesh = prism(36)
    assert np.degrees(quality(mesh).min_dihedral.min()) < 1
    made = remesh(mesh, program, Sizes(size=2.0), to_cylinder)
    assert np.degrees(quality(made).min_dihedral.min()) > 10
    assert (made.volumes() > 0).all()
    rim = made.points[np.unique(made.skin[made.skin_face == SIDE])]
    assert np.linalg.norm(rim[:, :2], axis=1) == pytest.approx(5, rel=1e-13)
    for face, z in ((BOTTOM, 0.0), (TOP, 20.0)):
        assert (made.points[made.skin[made.skin_face == face]][:, :, 2] == z).all()
    exact = {SIDE: 2 * np.pi * 5 * 20, BOTTOM: np.pi * 25, TOP: np.pi * 25}
    assert face_areas(made) == pytest.approx(exact, rel=0.01)
    assert made.volumes().sum() == pytest.approx(np.pi * 25 * 20, rel=0.01)
    rows, _ = skin.skin_of(made.tets, made.tet_solid)
    assert len(rows) == len(made.skin)


def test_solids_and_their_interface_are_kept(program: Path, cube_tets: TetMesh) -> None:
    solid = np.array([0, 0, 0, 1, 1, 1])
    rows, _ = skin.skin_of(cube_tets.tets, solid)
    outer = {tuple(sorted(t)): f for t, f in zip(cube_tets.skin.tolist(), cube_tets.skin_face)}
    face = [outer.get(tuple(sorted(t)), 6) for t in rows.tolist()]
    pair = TetMesh(
        cube_tets.points, cube_tets.tets, rows, face, np.arange(len(rows)), solid,
        cube_tets.point_source, (*cube_tets.face_names, "Face7"),
    )  # fmt: skip
    made = remesh(pair, program, Sizes(size=0.5))
    assert np.bincount(made.tet_solid, made.volumes()) == pytest.approx([0.5, 0.5], rel=1e-9)
    assert face_areas(made) == pytest.approx(face_areas(pair), rel=1e-9)
    _, count = np.unique(
        np.sort(made.skin[made.skin_face == 6], axis=1), axis=0, return_counts=True
    )
    assert (count == 2).all()


def test_size_of_a_face_is_kept_near_it(program: Path) -> None:
    made = remesh(prism(24), program, Sizes(4.0, chord=0.3, faces={BOTTOM: 0.8}), to_cylinder)
    count = np.bincount(made.skin_face)
    assert count[BOTTOM] > 2 * count[TOP]


def test_lines_of_a_prism() -> None:
    edges, ridges, corners = feature_lines(prism(24))
    assert len(edges) == 48 and len(ridges) == 48, "both rims, sharp, and no seam"
    assert len(corners) == 0
    assert face_radii(prism(24))[SIDE] == pytest.approx(5, rel=0.05)


def test_lines_of_a_cube(cube_tets: TetMesh) -> None:
    edges, ridges, corners = feature_lines(cube_tets)
    assert len(edges) == len(ridges) == 12 and len(corners) == 8
    assert face_radii(cube_tets) == {}


def test_medit_files_come_back_bit_for_bit(cube_tets: TetMesh) -> None:
    tables = {
        "Vertices": cube_tets.points / 3,
        "Tetrahedra": np.hstack([cube_tets.tets + 1, np.ones((6, 1), int)]),
        "Ridges": np.zeros(0, int),
        "Corners": np.array([3, 5]),
    }
    found = mmg.parse(mmg.medit(tables))
    assert np.array_equal(found["Vertices"][:, :3], tables["Vertices"])
    assert np.array_equal(found["Tetrahedra"], tables["Tetrahedra"])
    assert found["Corners"].ravel().tolist() == [3, 5]
    with pytest.raises(mmg.RemeshingFailed, match="truncated"):
        mmg.parse(b"Vertices 3 0 0 0 1")
    with pytest.raises(mmg.RemeshingFailed, match="no tetrahedra"):
        mmg.parse(b"Vertices 1 0 0 0 1 End")


def script(folder: Path, body: str) -> Path:
    path = folder / "mmg3d"
    path.write_text(f"#!{sys.executable}\n{body}\n")
    path.chmod(path.stat().st_mode | stat.S_IEXEC)
    return path


def test_failure_of_the_program_is_told(tmp_path: Path, cube_tets: TetMesh) -> None:
    broken = script(tmp_path, "print('## Error: unable to insert'); raise SystemExit(3)")
    with pytest.raises(mmg.RemeshingFailed, match=r"status 3.*unable to insert"):
        remesh(cube_tets, broken)


def test_program_is_stopped_on_request(tmp_path: Path, cube_tets: TetMesh) -> None:
    slow = script(tmp_path, "import time; time.sleep(60)")
    with pytest.raises(Cancelled):
        remesh(cube_tets, slow, told=lambda stage, fraction: False)


def test_program_is_found_where_it_is_named(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    named = script(tmp_path, "")
    monkeypatch.setenv("TETRA_MMG3D", str(named))
    assert mmg.find() == named
    monkeypatch.setenv("TETRA_MMG3D", str(tmp_path / "none"))
    assert mmg.find() is None
    monkeypatch.delenv("TETRA_MMG3D")
    package = tmp_path / "site" / "mmgpy" / "bin"
    package.mkdir(parents=True)
    (package / "mmg3d_O3").write_text("")
    assert mmg.find([tmp_path / "site"]) == package / "mmg3d_O3"


def test_smoothing_betters_the_worst_and_keeps_the_boundary(cube_tets: TetMesh) -> None:
    from freecad_tetra.fem.refine import refined

    fine = refined(cube_tets, 2)
    points = np.array(fine.points)
    (inner,) = np.flatnonzero((np.abs(points - 0.5) < 1e-9).all(axis=1))
    points[inner] += [0.22, 0.2, 0.1]
    poor = TetMesh(
        points, fine.tets, fine.skin, fine.skin_face, fine.skin_source, fine.tet_solid,
        fine.point_source, fine.face_names,
    )  # fmt: skip
    before = np.degrees(quality(poor).min_dihedral.min())
    made, moved = smooth(poor, np.radians(30))
    assert before < 10 < 30 < np.degrees(quality(made).min_dihedral.min())
    assert moved > 0
    outside = np.unique(fine.skin)
    assert np.array_equal(made.points[outside], points[outside])


def test_areas_and_shares_of_triangles() -> None:
    corners = np.array([[0, 0, 0], [2, 0, 0], [0, 2, 0]], float)
    middles = (corners + np.roll(corners, -1, axis=0)) / 2
    six = np.concatenate([corners, middles])
    assert areas(six, [[0, 1, 2]]) == pytest.approx([2])
    assert areas(six, [range(6)]) == pytest.approx([2])
    assert shares(six, [[0, 1, 2]])[0] == pytest.approx([2 / 3] * 3)
    assert shares(six, [range(6)])[0] == pytest.approx([0, 0, 0, 2 / 3, 2 / 3, 2 / 3], abs=1e-15)
