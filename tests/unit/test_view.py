# SPDX-License-Identifier: LGPL-2.1-or-later
"""The HTML view in a real browser: it draws, its controls act, and it asks for nothing else."""

from __future__ import annotations

import re
import sys
from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pytest

sys.path.insert(0, str(Path(__file__).parents[1] / "tools"))
from browser import Browser, chromium

from freecad_tetra import ConvexCells, TetMesh
from freecad_tetra.cli import main


@pytest.fixture(scope="module")
def browser() -> Iterator[Browser]:
    with chromium() as started:
        yield started


@pytest.fixture
def shown(browser: Browser, two_boxes: ConvexCells, tmp_path: Path) -> tuple[Browser, Path]:
    """The two boxes, side by side along x, opened in the browser."""
    page = tmp_path / "boxes.html"
    page.write_text(two_boxes.to_html())
    browser.requests()
    browser.open(page)
    return browser, page


def columns(image: np.ndarray) -> np.ndarray:
    """Whether each column of the canvas shows something."""
    return (image[:, :, 3] > 0).any(axis=0)


def gaps(image: np.ndarray) -> int:
    """How many empty bands of columns part what is shown."""
    filled = np.flatnonzero(columns(image))
    return int((np.diff(filled) > 1).sum())


def set_control(browser: Browser, name: str, value: str) -> None:
    browser.run(
        f"const e = document.getElementById('{name}'); e.value = '{value}';"
        "e.dispatchEvent(new Event('input', {bubbles: true}));"
    )


def colours(image: np.ndarray) -> set[tuple[int, ...]]:
    """Colours that cover more than a hundredth of what is shown, edges left out."""
    pixels = image[image[:, :, 3] == 255][:, :3]
    found, count = np.unique(pixels, axis=0, return_counts=True)
    return {tuple(map(int, c)) for c in found[count > 0.01 * len(pixels)]}


def test_the_canvas_shows_both_boxes_and_nothing_else_is_loaded(
    shown: tuple[Browser, Path],
) -> None:
    browser, page = shown
    image = browser.canvas()
    share = (image[:, :, 3] > 0).mean()
    assert 0.1 < share < 0.6
    # Three sides of each box, shaded apart, but for the one behind the other box.
    assert len(colours(image)) == 5
    assert browser.requests() == [page.as_uri()]
    assert [entry for entry in browser.logs("browser") if entry["level"] == "SEVERE"] == []
    assert browser.run("return document.getElementById('problem').hidden")


def test_the_slider_moves_the_pieces_apart(shown: tuple[Browser, Path]) -> None:
    browser, page = shown
    browser.run("document.getElementById('edges').click()")
    together = browser.canvas()
    assert gaps(together) == 0
    set_control(browser, "explode", "2")
    apart = browser.canvas()
    assert gaps(apart) == 1
    assert columns(apart).sum() > columns(together).sum() * 0.9
    assert np.ptp(np.flatnonzero(columns(apart))) > 1.5 * np.ptp(np.flatnonzero(columns(together)))
    set_control(browser, "explode", "0")
    assert np.array_equal(browser.canvas(), together)
    assert browser.requests() == [page.as_uri()]


def test_cut_colour_turn_and_reset_act(shown: tuple[Browser, Path]) -> None:
    browser, _ = shown
    first = browser.canvas()
    set_control(browser, "axis", "0")
    set_control(browser, "cut", "0.5")
    assert len(colours(browser.canvas())) == 3  # the box beyond x is hidden
    browser.run("document.getElementById('reset').click()")
    browser.run("return new Promise((done) => setTimeout(done, 50))")
    assert np.array_equal(browser.canvas(), first)
    set_control(browser, "colour", "quality")
    assert colours(browser.canvas()) != colours(first)
    set_control(browser, "colour", "piece")
    browser.run(
        "document.getElementById('view').dispatchEvent("
        "new KeyboardEvent('keydown', {key: 'ArrowLeft'}))"
    )
    assert not np.array_equal(browser.canvas(), first)
    # These boxes have no B-rep faces to be coloured by.
    assert browser.run("return document.querySelector('#colour [value=face]').disabled")


def test_a_notebook_gets_the_view_in_a_frame(
    browser: Browser, cube_tets: TetMesh, tmp_path: Path
) -> None:
    page = tmp_path / "notebook.html"
    page.write_text(f"<!DOCTYPE html><body>{cube_tets._repr_html_()}</body>")
    browser.open(page)
    assert browser.run("return document.querySelector('iframe').srcdoc.length") > 5000
    assert [entry for entry in browser.logs("browser") if entry["level"] == "SEVERE"] == []


def test_the_command_writes_one_page_beside_the_result(
    two_boxes: ConvexCells, tmp_path: Path, capfd: pytest.CaptureFixture[str]
) -> None:
    result = two_boxes.write(tmp_path / "boxes.vtu")
    assert main(["view", str(result)]) == 0
    assert "2 cells in" in capfd.readouterr().out
    text = (tmp_path / "boxes.html").read_text()
    assert sorted(f.name for f in tmp_path.iterdir()) == ["boxes.html", "boxes.vtu"]
    assert not re.search(r"""(src|href)=["'](?!data:)""", text)
    assert "default-src 'none'" in text


def test_a_title_cannot_end_the_script(two_boxes: ConvexCells) -> None:
    from freecad_tetra.export import scene, web

    text = web.page(scene.scene_of(two_boxes), "</script><img src=x>")
    assert text.count("</script>") == 1
    assert "<img" not in text
