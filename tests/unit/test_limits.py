# SPDX-License-Identifier: LGPL-2.1-or-later
"""Hulls keep the limits, cover the part, and stray no farther than they say, by sampling."""

from __future__ import annotations

import sys
from pathlib import Path

import numpy as np
import pytest
import shapes
from scipy.spatial import ConvexHull

sys.path.insert(0, str(Path(__file__).parents[1] / "tools"))
from hull_measure import measure

from freecad_tetra import BadOption, Cancelled, ConvexCells, convex_cells, validate
from freecad_tetra.limits import limit

CORPUS = Path(__file__).resolve().parents[3] / "shared/corpus/brep"
# The parts of benchmarks/hulls_vs_coacd.py.
TEN = ["page67_bynormandc", "Page_036", "Page_043", "Page_046", "Page_053", "Page_068", "Page_087",
       "Page_094", "prusa_fan-shroud", "prusa_y-belt-holder"]  # fmt: skip


def told(cells: ConvexCells) -> dict[str, float]:
    found: dict[str, float] = cells.report.details["limits"]
    return found


def hulls(cells: ConvexCells) -> list[np.ndarray]:
    return [cell.points for cell in cells]


def check(surface: tuple[np.ndarray, np.ndarray], cells: ConvexCells, samples: int = 20000) -> None:
    """Assert that the report is true of the cells."""
    size = float(np.linalg.norm(np.ptp(surface[0], axis=0)))
    found = measure(surface, hulls(cells), samples, seed=1)
    assert found["outward"] <= told(cells)["hull_error"] + 1e-9 * size
    assert found["inward"] <= 1e-7 * size  # they cover the part
    volume = abs(np.linalg.det(surface[0][surface[1]]).sum() / 6)
    assert found["volume_missed"] <= 1e-6 * volume
    assert found["volume_added"] <= told(cells)["volume_added"] + 1e-6 * volume
    for cell in cells:
        # Closed, outward and convex: it fills its hull.
        assert cell.volume() == pytest.approx(ConvexHull(cell.points).volume, rel=1e-6)


def test_nothing_changes_and_no_error_when_the_limits_are_kept() -> None:
    shape = shapes.square_frame()
    exact = convex_cells((shape.vertices, shape.triangles))
    same = limit(exact, max_cells=len(exact), max_vertices=8)
    for name in ("points", "facet_offsets", "facet_vertices", "cell_offsets", "facet_source"):
        assert np.array_equal(getattr(same, name), getattr(exact, name))
    assert told(same)["hull_error"] == 0 and told(same)["volume_added"] == 0
    assert told(same)["merged_cells"] == told(same)["simplified_cells"] == 0


def test_one_hull_of_a_frame_strays_by_half_its_hole() -> None:
    shape = shapes.square_frame()  # 4 x 4 x 1 with a hole of 2 x 2
    cells = convex_cells((shape.vertices, shape.triangles), max_cells=1)
    assert len(cells) == 1 and cells.volumes().sum() == pytest.approx(16)
    # The middle of the hole is 1 from its walls.
    assert told(cells)["hull_error_found"] == pytest.approx(1, rel=0.05)
    assert told(cells)["hull_error_found"] <= told(cells)["hull_error"] <= 1.06
    assert told(cells)["volume_added"] == pytest.approx(4)


def test_flush_cells_merge_without_error() -> None:
    box = np.array([(x, y, z) for x in (0, 1, 2) for y in (0, 1) for z in (0, 1)], float)
    loops = []
    for i in (0, 4):
        loops += [
            [i, i + 1, i + 3, i + 2], [i + 4, i + 6, i + 7, i + 5], [i, i + 4, i + 5, i + 1],
            [i + 2, i + 3, i + 7, i + 6], [i, i + 2, i + 6, i + 4], [i + 1, i + 5, i + 7, i + 3],
        ]  # fmt: skip
    halves = ConvexCells(
        box, np.arange(13) * 4, np.concatenate(loops), [0, 6, 12],
        [0, -1, 2, 3, 4, 5, -1, 7, 8, 9, 10, 11], np.full(12, -1), [0, 0], np.arange(12),
    )  # fmt: skip
    whole = limit(halves, max_cells=1)
    assert whole.volumes() == pytest.approx([2.0])
    assert told(whole)["hull_error"] < 1e-6 and told(whole)["volume_added"] == pytest.approx(0)


@pytest.mark.parametrize("most", [8, 20, 60])
def test_a_ball_is_enclosed_by_fewer_vertices(most: int) -> None:
    rows = np.random.default_rng(3).normal(size=(400, 3))
    hull = ConvexHull(rows / np.linalg.norm(rows, axis=1, keepdims=True))
    triangles = hull.simplices.copy()
    corners = hull.points[triangles]
    normal = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    wrong = np.einsum("ij,ij->i", normal, hull.equations[:, :3]) < 0
    triangles[wrong] = triangles[wrong][:, ::-1]
    exact = convex_cells((hull.points, triangles))
    assert len(exact) == 1
    cells = limit(exact, max_vertices=most)
    assert len(cells) == 1 and len(cells.cell(0).points) <= most
    check((hull.points, triangles), cells)
    # A cube around the unit ball reaches sqrt(3) - 1 beyond it; the rest is better than that.
    assert told(cells)["hull_error"] < (1.0 if most == 8 else 0.5 if most == 20 else 0.2)


def test_solids_are_never_joined() -> None:
    shape = shapes.l_prism()
    points = np.concatenate([shape.vertices, shape.vertices + np.array([9, 0, 0])])
    triangles = np.concatenate([shape.triangles, shape.triangles + len(shape.vertices)])
    cells = convex_cells((points, triangles), max_cells=2)
    assert sorted(cells.cell_solid.tolist()) == [0, 1]
    with pytest.raises(BadOption, match="number of solids, 2"):
        convex_cells((points, triangles), max_cells=1)


def strips_of_an_arc(count: int) -> ConvexCells:
    """A quarter of a ring of radii 8 and 10, height 2, in radial strips."""
    angles = np.linspace(0, np.pi / 2, count + 1)
    points = [(r * np.cos(a), r * np.sin(a), z) for a in angles for r in (8, 10) for z in (0, 2)]
    loops: list[list[int]] = []
    source: list[int] = []
    for i in range(0, 4 * count, 4):
        loops += [
            [i, i + 1, i + 5, i + 4], [i + 2, i + 6, i + 7, i + 3], [i, i + 4, i + 6, i + 2],
            [i + 1, i + 3, i + 7, i + 5], [i, i + 2, i + 3, i + 1], [i + 4, i + 5, i + 7, i + 6],
        ]  # fmt: skip
        source += [0, 1, 2, 3, 4 if i == 0 else -1, 5 if i == 4 * count - 4 else -1]
    return ConvexCells(
        np.array(points), np.arange(len(loops) + 1) * 4, np.concatenate(loops),
        np.arange(count + 1) * 6, source, np.full(len(loops), -1), np.zeros(count, int),
        np.arange(len(points)),
    )  # fmt: skip


def test_an_arc_is_divided_into_equal_parts() -> None:
    """Joining the nearest two again and again makes parts of two and four strips."""
    cells = limit(strips_of_an_arc(12), max_cells=4)
    assert len(cells) == 4
    # From the chord of three strips to the middle of the second.
    reach = 8 * (np.cos(np.pi / 48) - np.cos(np.pi / 16))
    assert told(cells)["hull_error_found"] == pytest.approx(reach, rel=0.02)


def test_equal_input_gives_equal_hulls() -> None:
    part = Path(__file__).parents[2] / "resources/parts/bracket.step"
    first, second = (convex_cells(part, max_cells=12, max_vertices=16) for _ in range(2))
    assert first.points.tobytes() == second.points.tobytes()
    assert first.facet_vertices.tobytes() == second.facet_vertices.tobytes()
    assert told(first) == told(second)


@pytest.mark.parametrize("wrong", [{"max_cells": 0}, {"max_vertices": 7}, {"max_cells": -3}])
def test_impossible_limits_are_refused(wrong: dict[str, int]) -> None:
    shape = shapes.l_prism()
    with pytest.raises(BadOption):
        convex_cells((shape.vertices, shape.triangles), **wrong)


def test_merging_can_be_cancelled() -> None:
    part = Path(__file__).parents[2] / "resources/parts/bracket.step"
    exact = convex_cells(part)
    with pytest.raises(Cancelled):
        limit(exact, max_cells=5, progress=lambda stage, fraction: False)


@pytest.mark.parametrize(("cells", "vertices"), [(40, 60), (12, 16), (1, 8)])
def test_hulls_of_the_bracket_are_what_the_report_says(cells: int, vertices: int) -> None:
    surface = validate(Path(__file__).parents[2] / "resources/parts/bracket.step").surface()
    found = convex_cells(surface, max_cells=cells, max_vertices=vertices)
    assert len(found) <= cells and max(len(c.points) for c in found) <= vertices
    check((surface.vertices, surface.triangles), found)


@pytest.mark.parametrize("name", TEN)
def test_ten_real_parts_within_the_limits_of_engines(name: str) -> None:
    (file,) = CORPUS.glob(f"{name}*.brep")
    surface = validate(file).surface()
    found = convex_cells(surface, max_cells=64, max_vertices=60)
    assert len(found) == 64 and max(len(c.points) for c in found) <= 60
    assert (
        0 < told(found)["hull_error_found"] <= told(found)["hull_error"] < 0.03 * surface.diagonal()
    )
    check((surface.vertices, surface.triangles), found, samples=10000)
