# SPDX-License-Identifier: LGPL-2.1-or-later
"""Pictures show the nearest facet of every cell, scaled and shifted as told, the same each time."""

import struct
import subprocess
import sys
import zlib
from pathlib import Path

import numpy as np
import pytest

from freecad_tetra.export import picture

CUBE_LOOPS = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]
FROM_ABOVE = picture.Camera(azimuth=-np.pi / 2, elevation=np.pi / 2, width=200, height=100)


def box(low: tuple[float, ...], high: tuple[float, ...]) -> list[np.ndarray]:
    """Facets of an axis-aligned box, counter-clockwise seen from outside."""
    corners = np.array(
        [[x, y, z] for x in (low[0], high[0]) for y in (low[1], high[1]) for z in (low[2], high[2])]
    )
    return [corners[list(loop)] for loop in CUBE_LOOPS]


def obj_text(cells: list[list[np.ndarray]]) -> str:
    lines, count = [], 0
    for number, facets in enumerate(cells):
        lines.append(f"o cell_{number}")
        for facet in facets:
            lines += [f"v {x:.17g} {y:.17g} {z:.17g}" for x, y, z in facet]
            lines.append("f " + " ".join(str(count + i + 1) for i in range(len(facet))))
            count += len(facet)
    return "\n".join(lines) + "\n"


def decode(data: bytes) -> np.ndarray:
    """Pixels of an unfiltered RGB PNG, after checking every chunk's sum."""
    assert data[:8] == b"\x89PNG\r\n\x1a\n"
    chunks, at = {}, 8
    while at < len(data):
        (size,) = struct.unpack(">I", data[at : at + 4])
        kind, body = data[at + 4 : at + 8], data[at + 8 : at + 8 + size]
        assert struct.unpack(">I", data[at + 8 + size : at + 12 + size])[0] == zlib.crc32(
            kind + body
        )
        chunks[kind], at = body, at + 12 + size
    width, height = struct.unpack(">II", chunks[b"IHDR"][:8])
    rows = np.frombuffer(zlib.decompress(chunks[b"IDAT"]), np.uint8).reshape(height, -1)
    assert not rows[:, 0].any()
    return rows[:, 1:].reshape(height, width, 3)


def test_a_square_covers_its_pixels_exactly() -> None:
    scene = [np.array([[-1.0, -1, 0], [1, -1, 0], [1, 1, 0], [-1, 1, 0]])]
    depth, shown = picture.rasterize(scene, FROM_ABOVE)
    # The margin is 6 % of the width on each side, and height is what limits.
    side = FROM_ABOVE.height * picture.SUPERSAMPLING - 2 * 0.06 * FROM_ABOVE.width * 2
    assert (shown == 0).sum() == side**2
    assert np.array_equal(np.isfinite(depth), shown == 0)


def test_the_nearest_facet_is_shown() -> None:
    square = np.array([[-1.0, -1, 0], [1, -1, 0], [1, 1, 0], [-1, 1, 0]])
    small = square * 0.5 + [0.0, 0.0, 1.0]
    for scene, front in (([square, small], 1), ([small, square], 0)):
        _, shown = picture.rasterize(scene, FROM_ABOVE)
        height, width = shown.shape
        assert shown[height // 2, width // 2] == front
        assert (shown == front).sum() * 3 == (shown == 1 - front).sum()


def test_backs_are_left_out() -> None:
    facets = [facet @ FROM_ABOVE.axes().T for facet in box((0, 0, 0), (1, 1, 1))]
    front, normals = picture.facing(facets)
    assert len(front) == 1
    assert np.allclose(normals, [[0, 0, 1]])
    assert np.allclose(facets[front[0]][:, 2], 1.0)


def test_cells_move_away_from_the_middle() -> None:
    cells = [box((0, 0, 0), (1, 1, 1)), box((1, 0, 0), (2, 1, 1))]
    for amount in (0.0, 0.5, 2.0):
        left, right = (np.concatenate(facets) for facets in picture.apart(cells, amount))
        assert right[:, 0].min() - left[:, 0].max() == pytest.approx(amount)
        assert np.array_equal(left[:, 1:], np.concatenate(cells[0])[:, 1:])


def test_equal_cells_give_equal_bytes(tmp_path: Path) -> None:
    cells = [box((0, 0, 0), (1, 1, 1)), box((1, 0, 0), (2, 3, 1))]
    source = tmp_path / "cells.obj"
    source.write_text(obj_text(cells))
    read = picture.read_cells(source)
    assert all(np.array_equal(a, b) for x, y in zip(read, cells) for a, b in zip(x, y))
    image = picture.draw_cells(cells, 0.5, FROM_ABOVE)
    for name in ("a.png", "b.png"):
        picture.write_png(tmp_path / name, picture.draw_cells(read, 0.5, FROM_ABOVE))
    assert (tmp_path / "a.png").read_bytes() == (tmp_path / "b.png").read_bytes()
    assert np.array_equal(decode((tmp_path / "a.png").read_bytes()), image)


def test_colours_of_cells_differ() -> None:
    colours = np.rint(picture.palette(100) * 255)
    assert len(np.unique(colours, axis=0)) == 100
    assert (colours >= 0).all() and (colours <= 255).all()


@pytest.mark.parametrize("text", ["", "v 0 0\n", "f 1 2 3\n", "o cell\nv 0 0 0\nf 1 2 3\n"])
def test_what_is_no_cells_gives_status_4(tmp_path: Path, text: str) -> None:
    source = tmp_path / "cells.obj"
    source.write_text(text)
    command = [sys.executable, "-m", "freecad_tetra.export.picture", source]
    done = subprocess.run(
        [*command, "-o", tmp_path / "out.png"], capture_output=True, text=True, check=False
    )
    assert done.returncode == 4
    assert "Traceback" not in done.stderr
    assert not (tmp_path / "out.png").exists()
