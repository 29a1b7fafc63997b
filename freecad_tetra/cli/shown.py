# SPDX-License-Identifier: LGPL-2.1-or-later
"""The commands ``picture`` and ``view``: results, or the cells of a part, to look at."""

from __future__ import annotations

import argparse
from collections.abc import Callable
from pathlib import Path

import numpy as np

from freecad_tetra import api, export
from freecad_tetra.errors import TetraError
from freecad_tetra.export import picture, web
from freecad_tetra.export.scene import Scene, clipped, scene_of
from freecad_tetra.io import results
from freecad_tetra.model import ConvexCells, TetMesh

_AXES = {"x": 0, "y": 1, "z": 2}
Progress = Callable[[str, float], "bool | None"]


def add(commands: argparse._SubParsersAction[argparse.ArgumentParser]) -> None:
    """Add both commands to the parser."""
    files = "result (.vtu .obj) or part; the cells of a part are shown"
    still = commands.add_parser("picture", help="draw a result to a PNG file")
    still.add_argument("input", metavar="FILE", help=files)
    still.add_argument("-o", "--output", required=True, metavar="PNG")
    still.add_argument("--explode", type=float, default=0.0, metavar="FACTOR")
    still.add_argument(
        "--cut", type=_cut, metavar="AXIS=SHARE", help="as y=0.5: cut half-way, before the eye"
    )
    still.add_argument("--colour", choices=("piece", "face", "quality"), default="piece")
    still.add_argument("--azimuth", type=float, default=-55.0, metavar="DEG")
    still.add_argument("--elevation", type=float, default=28.0, metavar="DEG")
    still.add_argument("--width", type=int, default=1400, help="pixels, three quarters high")
    page = commands.add_parser("view", help="write a result as an interactive HTML page")
    page.add_argument("input", metavar="FILE", help=files)
    page.add_argument("-o", "--output", metavar="HTML", help="default: FILE with .html")
    for command in (still, page):
        command.set_defaults(surface=None, report=None)


def _cut(word: str) -> tuple[int, float]:
    axis, _, share = word.partition("=")
    try:
        if axis in _AXES and 0 < float(share) < 1:
            return _AXES[axis], float(share)
    except ValueError:
        pass
    raise argparse.ArgumentTypeError(f"{word} is not like y=0.5, with x, y or z and 0 to 1")


def draw(arguments: argparse.Namespace, progress: Progress) -> int:
    """Write the picture and return the exit code."""
    scene = load(arguments.input, progress)
    if arguments.colour == "face" and (scene.face < 0).all():
        raise TetraError(
            f"{arguments.input} tells no faces", "colour by piece, or draw tetrahedra in a .vtu"
        )
    camera = picture.Camera(
        np.radians(arguments.azimuth),
        np.radians(arguments.elevation),
        arguments.width,
        arguments.width * 3 // 4,
    )
    if arguments.cut:
        axis, share = arguments.cut
        used = scene.points[scene.corners][:, axis]
        # What is between the eye and the plane goes.
        towards = np.copysign(1.0, camera.axes()[2, axis])
        height = used.min() + share * np.ptp(used)
        scene = clipped(scene, towards * np.eye(3)[axis], towards * height)
    image = picture.draw_scene(scene, arguments.explode, camera, arguments.colour)
    with export.atomic(arguments.output) as stream:
        stream.write(picture.png(image))
    print(f"{len(scene.quality)} {scene.kind} in {arguments.output}")
    return 0


def write_page(arguments: argparse.Namespace, progress: Progress) -> int:
    """Write the page and return the exit code."""
    source = Path(arguments.input)
    target = Path(arguments.output) if arguments.output else source.with_suffix(".html")
    scene = load(arguments.input, progress)
    with export.atomic(target) as stream:
        stream.write(web.page(scene, source.stem).encode())
    print(f"{len(scene.quality)} {scene.kind} in {target}")
    return 0


def load(path: str, progress: Progress | None = None) -> Scene:
    """Return the pieces in a result file, or the convex cells of a part.

    Raises
    ------
    UnreadableFile, UnsupportedFormat, InvalidSolid and the errors of `convex_cells`
    """
    suffix = Path(path).suffix.lower()
    if suffix == ".vtu" or (suffix == ".obj" and _has_objects(path)):
        stored = results.read_result(path)
        if isinstance(stored, results.StoredTets):
            return scene_of(_tets(stored))
        return scene_of(_cells(stored))
    return scene_of(api.convex_cells(path, progress=progress))


def _has_objects(path: str) -> bool:
    """Return whether an OBJ file holds cells of ours and no plain mesh."""
    try:
        with open(path, "rb") as stream:
            return any(line.startswith(b"o cell_") for line in stream)
    except OSError:
        return False


def _tets(stored: results.StoredTets) -> TetMesh:
    return TetMesh(
        stored.points,
        stored.tets.astype(np.int32),
        stored.skin.astype(np.int32),
        stored.skin_face.astype(np.int32),
        np.full(len(stored.skin), -1, np.int32),
        np.zeros(len(stored.tets), np.int32),
        np.full(len(stored.points), -1, np.int32),
    )


def _cells(stored: results.StoredCells) -> ConvexCells:
    loops = [loop for cell in stored.cells for loop in cell]
    unknown = np.full(len(loops), -1, np.int32)
    return ConvexCells(
        stored.points,
        np.append(0, np.cumsum([len(loop) for loop in loops])),
        np.concatenate(loops).astype(np.int32),
        np.append(0, np.cumsum([len(cell) for cell in stored.cells])),
        unknown,
        unknown,
        np.zeros(len(stored.cells), np.int32),
        np.full(len(stored.points), -1, np.int32),
    )
