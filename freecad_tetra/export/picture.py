# SPDX-License-Identifier: LGPL-2.1-or-later
"""A shaded PNG of convex cells drawn apart, by a depth buffer in numpy.

Usage: ``python -m freecad_tetra.export.picture CELLS.obj -o CELLS.png [--explode 0.5]``
"""

from __future__ import annotations

import argparse
import struct
import sys
import zlib
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import numpy.typing as npt

from freecad_tetra.export.scene import Scene, middles
from freecad_tetra.model import ConvexCells

Floats = npt.NDArray[np.float64]
Image = npt.NDArray[np.uint8]
Facets = list[Floats]

__all__ = ["Camera", "cell_polygons", "draw_cells", "draw_scene", "read_cells", "write_png"]

SUPERSAMPLING = 2
BACKGROUND = np.array([[1.0, 1.0, 1.0], [0.86, 0.89, 0.93]])
KEY_LIGHT = np.array([0.35, 0.45, 1.0])
INNER = np.array([0.84, 0.85, 0.87])
FILL_LIGHT = np.array([-0.9, -0.2, 0.4])


@dataclass(frozen=True)
class Camera:
    """An orthographic view.

    Attributes
    ----------
    azimuth, elevation : float
        Where the eye stands, in radians, seen from the middle of the part; z is up.
    width, height : int
        Pixels.
    """

    azimuth: float = np.radians(-55.0)
    elevation: float = np.radians(28.0)
    width: int = 1400
    height: int = 1050

    def axes(self) -> Floats:
        """Return the rows right, up and towards the eye, (3, 3) float64."""
        ca, sa = np.cos(self.azimuth), np.sin(self.azimuth)
        ce, se = np.cos(self.elevation), np.sin(self.elevation)
        return np.array([[-sa, ca, 0.0], [-se * ca, -se * sa, ce], [ce * ca, ce * sa, se]])


def read_cells(path: Path) -> list[Facets]:
    """Return the facets of every ``o`` object of an OBJ file with global 1-based indices.

    Returns
    -------
    list of list of (k, 3) float64
        Loops of points, counter-clockwise seen from outside; one inner list per cell.
    """
    points: list[list[float]] = []
    cells: list[list[list[int]]] = []
    for line in path.read_text(encoding="utf-8").splitlines():
        words = line.split()
        if not words:
            continue
        if words[0] == "v":
            points.append([float(word) for word in words[1:4]])
        elif words[0] == "o":
            cells.append([])
        elif words[0] == "f":
            cells[-1].append([int(word.split("/")[0]) - 1 for word in words[1:]])
    array = np.array(points)
    return [[array[loop] for loop in loops] for loops in cells if loops]


def cell_polygons(cells: ConvexCells) -> list[Facets]:
    """Return the facets of every cell as loops of points, as `read_cells` does."""
    return [[cell.points[loop] for loop in cell.facets] for cell in cells]


def draw_cells(
    cells: Sequence[Facets], explode: float = 0.5, camera: Camera | None = None
) -> Image:
    """Draw convex cells, each moved away from the middle of all.

    Parameters
    ----------
    cells : sequence of list of (k, 3) float64
        Facets of each cell, counter-clockwise seen from outside.
    explode : float
        Distance that a cell moves, as a multiple of its distance from the middle; 0 leaves all
        in place.
    camera : Camera, optional

    Returns
    -------
    (height, width, 3) uint8
        The same bytes for the same cells, O(pixels covered).
    """
    owner = np.repeat(np.arange(len(cells)), [len(facets) for facets in cells])
    facets = [facet for facets in apart(cells, explode) for facet in facets]
    return _draw(facets, owner, palette(len(cells))[owner], camera or Camera())


def draw_scene(
    scene: Scene, explode: float = 0.0, camera: Camera | None = None, colour: str = "piece"
) -> Image:
    """Draw the pieces of a scene; see `draw_cells`.

    Parameters
    ----------
    scene : Scene
    explode : float
    camera : Camera, optional
    colour : {"piece", "face", "quality"}
        A hue per piece; or per B-rep face, grey inside; or from red, bad, to green.

    Returns
    -------
    (height, width, 3) uint8
    """
    kept = np.arange(len(scene.piece)) if explode else outer_facets(scene)
    middle = middles(scene)
    shifts = explode * (middle - box_middle(scene.points[scene.corners]))
    owner = scene.piece[kept].astype(np.int64)
    facets = [scene.loop(f) + shifts[k] for f, k in zip(kept.tolist(), owner.tolist())]
    colours = {
        "piece": lambda: palette(len(middle))[owner],
        "face": lambda: face_colours(scene.face[kept]),
        "quality": lambda: quality_colours(scene.quality)[owner],
    }[colour]()
    return _draw(facets, owner, colours, camera or Camera())


def _draw(facets: Facets, owner: npt.NDArray[np.int64], colours: Floats, camera: Camera) -> Image:
    """Draw facets of pieces, each in its colour."""
    moved = [facet @ camera.axes().T for facet in facets]
    front, normals = facing(moved)
    depth, shown = rasterize([moved[i] for i in front], camera)
    shaded = colours[front] * lighting(normals)[:, None]
    pixels = background(*depth.shape)
    hit = shown >= 0
    pixels[hit] = shaded[shown[hit]] * creases(depth)[hit, None]
    pixels *= outlines(shown, depth, owner[front], normals)[:, :, None]
    return shrink(np.clip(pixels, 0.0, 1.0))


def outer_facets(scene: Scene) -> npt.NDArray[np.int64]:
    """Return the facets that no other is the back of; triangles only are compared, O(F log F)."""
    sizes = np.diff(scene.offsets)
    triangles = np.flatnonzero(sizes == 3)
    keys = np.sort(scene.corners[scene.offsets[triangles][:, None] + np.arange(3)], axis=1)
    _, index, count = np.unique(keys, axis=0, return_inverse=True, return_counts=True)
    inner = triangles[count[index.reshape(-1)] > 1]
    return np.setdiff1d(np.arange(len(sizes)), inner)


def apart(cells: Sequence[Facets], explode: float) -> list[Facets]:
    """Return the facets of the cells after each has moved away from the middle."""
    middles = np.array([box_middle(np.concatenate(facets)) for facets in cells])
    middle = box_middle(np.concatenate([facet for facets in cells for facet in facets]))
    shifts = explode * (middles - middle)
    return [[facet + shift for facet in facets] for facets, shift in zip(cells, shifts)]


def box_middle(points: Floats) -> Floats:
    """Return the middle of the bounding box of (n, 3) points."""
    middle: Floats = (points.min(axis=0) + points.max(axis=0)) / 2.0
    return middle


def facing(facets: Sequence[Floats]) -> tuple[npt.NDArray[np.int64], Floats]:
    """Return the facets turned to the eye, and their unit normals, by Newell's sum."""
    normals = np.array([np.cross(f, np.roll(f, -1, axis=0)).sum(axis=0) for f in facets])
    normals /= np.maximum(np.linalg.norm(normals, axis=1), 1e-300)[:, None]
    front = np.flatnonzero(normals[:, 2] > 1e-6)
    return front, normals[front]


def rasterize(facets: Sequence[Floats], camera: Camera) -> tuple[Floats, npt.NDArray[np.int64]]:
    """Return depth (nearer is greater, -inf outside) and facet (-1 outside) of every sample.

    The depth is in samples as well, so that it compares with distances in the picture.
    """
    shape = (camera.height * SUPERSAMPLING, camera.width * SUPERSAMPLING)
    depth = np.full(shape, -np.inf)
    shown = np.full(shape, -1, dtype=np.int64)
    every = np.concatenate(list(facets))
    low, high = every.min(axis=0), every.max(axis=0)
    margin = 0.06 * shape[1]
    room = np.array([shape[1], shape[0]]) - 2.0 * margin
    scale = float((room / np.maximum(high - low, 1e-300)[:2]).min())
    centre = np.array([shape[1], shape[0]]) / 2.0
    for index, facet in enumerate(facets):
        screen = (facet - (low + high) / 2.0) * scale
        screen[:, 0] += centre[0]
        screen[:, 1] = centre[1] - screen[:, 1]
        for i in range(1, len(screen) - 1):
            fill_triangle(screen[[0, i, i + 1]], index, depth, shown)
    return depth, shown


def fill_triangle(corners: Floats, index: int, depth: Floats, shown: npt.NDArray[np.int64]) -> None:
    """Write a triangle into the buffers where it is nearest; (3, 3) corners in samples."""
    left, top = np.maximum(np.floor(corners[:, :2].min(axis=0)).astype(int), 0)
    right, bottom = np.ceil(corners[:, :2].max(axis=0)).astype(int) + 1
    window = (slice(top, bottom), slice(left, right))
    height, width = depth[window].shape
    y, x = np.mgrid[top : top + height, left : left + width] + 0.5
    (ax, ay, az), (bx, by, bz), (cx, cy, cz) = corners
    area = (bx - ax) * (cy - ay) - (by - ay) * (cx - ax)
    if area == 0.0:
        return
    u = ((x - ax) * (cy - ay) - (y - ay) * (cx - ax)) / area
    v = ((bx - ax) * (y - ay) - (by - ay) * (x - ax)) / area
    z = az + u * (bz - az) + v * (cz - az)
    inside = (u >= -1e-9) & (v >= -1e-9) & (u + v <= 1.0 + 1e-9) & (z > depth[window])
    depth[window][inside] = z[inside]
    shown[window][inside] = index


def palette(count: int) -> Floats:
    """Return `count` colours of like lightness, hues a golden angle apart, (count, 3) float64."""
    hue = 0.9 + np.arange(count) * np.pi * (3.0 - np.sqrt(5.0))
    lightness = np.where(np.arange(count) % 2 == 0, 0.80, 0.72)
    a, b = 0.105 * np.cos(hue), 0.105 * np.sin(hue)
    return oklab(lightness, a, b)


def oklab(lightness: Floats, a: Floats, b: Floats) -> Floats:
    """Return sRGB of Ottosson's Oklab, (n, 3) float64."""
    # Linear sRGB by way of the cones' responses.
    cones = np.stack(
        [
            lightness + 0.3963377774 * a + 0.2158037573 * b,
            lightness - 0.1055613458 * a - 0.0638541728 * b,
            lightness - 0.0894841775 * a - 1.2914855480 * b,
        ]
    )
    mix = np.array(
        [
            [4.0767416621, -3.3077115913, 0.2309699292],
            [-1.2684380046, 2.6097574011, -0.3413193965],
            [-0.0041960863, -0.7034186147, 1.7076147010],
        ]
    )
    linear = np.clip(mix @ cones**3, 0.0, 1.0).T
    colours: Floats = linear ** (1.0 / 2.2)
    return colours


def face_colours(face: npt.NDArray[np.int32]) -> Floats:
    """Return a hue per B-rep face and grey for -1, (n, 3) float64."""
    hues = palette(int(face.max(initial=0)) + 1)
    colours: Floats = np.where((face < 0)[:, None], INNER, hues[np.maximum(face, 0)])
    return colours


def quality_colours(quality: Floats) -> Floats:
    """Return colours from red, 0, to green, 1, (n, 3) float64."""
    q = np.clip(quality, 0.0, 1.0)
    return oklab(0.5 + 0.4 * q, 0.16 - 0.28 * q, 0.02 + 0.1 * q)


def lighting(normals: Floats) -> Floats:
    """Return the brightness of facets with the given normals in view axes, (n,) float64."""
    key = np.clip(normals @ (KEY_LIGHT / np.linalg.norm(KEY_LIGHT)), 0.0, 1.0)
    fill = np.clip(normals @ (FILL_LIGHT / np.linalg.norm(FILL_LIGHT)), 0.0, 1.0)
    brightness: Floats = 0.52 + 0.52 * key + 0.12 * fill
    return brightness


def background(height: int, width: int) -> Floats:
    """Return a vertical gradient, (height, width, 3) float64."""
    t = np.linspace(0.0, 1.0, height)[:, None]
    rows = BACKGROUND[0] * (1.0 - t) + BACKGROUND[1] * t
    return np.repeat(rows[:, None, :], width, axis=1)


def creases(depth: Floats) -> Floats:
    """Return a factor per sample that darkens what lies behind its surroundings."""
    seen = np.isfinite(depth)
    floor = depth[seen].min() if seen.any() else 0.0
    filled = np.where(seen, depth, floor)
    radius = max(1, depth.shape[1] // 50)
    behind = np.clip((blur(filled, radius) - filled) / (4.0 * radius), 0.0, 1.0)
    factor: Floats = 1.0 - 0.4 * behind
    return factor


def blur(values: Floats, radius: int) -> Floats:
    """Return the values after two box filters along each axis, O(samples)."""
    for axis in (0, 1, 0, 1):
        width = [(0, 0), (0, 0)]
        width[axis] = (radius + 1, radius)
        sums = np.cumsum(np.pad(values, width, mode="edge"), axis=axis)
        count = values.shape[axis]
        upper = np.take(sums, np.arange(2 * radius + 1, 2 * radius + 1 + count), axis=axis)
        lower = np.take(sums, np.arange(count), axis=axis)
        values = (upper - lower) / (2 * radius + 1)
    return values


def outlines(
    shown: npt.NDArray[np.int64], depth: Floats, owner: npt.NDArray[np.int64], normals: Floats
) -> Floats:
    """Return a factor per sample, below 1 along silhouettes of cells and edges between facets."""
    factor = np.ones(shown.shape)
    cell = np.append(owner, -1)[shown]
    unit = np.vstack([normals, np.zeros(3)])
    for axis in (0, 1):
        here = (slice(None, -1), slice(None)) if axis == 0 else (slice(None), slice(None, -1))
        next_ = (slice(1, None), slice(None)) if axis == 0 else (slice(None), slice(1, None))
        other = np.flatnonzero(shown[here] != shown[next_])
        a, b = shown[here].ravel()[other], shown[next_].ravel()[other]
        same = cell[here].ravel()[other] == cell[next_].ravel()[other]
        # Facets of a cell that lie in one plane are one face to the eye.
        flat = same & ((unit[a] * unit[b]).sum(axis=1) > 1.0 - 1e-9)
        strength = np.where(flat, 1.0, np.where(same, 0.55, 0.25))
        rows, columns = np.unravel_index(other, shown[here].shape)
        np.minimum.at(factor, (rows, columns), strength)
        np.minimum.at(factor, (rows + (axis == 0), columns + (axis == 1)), strength)
    return factor


def shrink(pixels: Floats) -> Image:
    """Return 8-bit means of SUPERSAMPLING x SUPERSAMPLING samples."""
    height, width = (n // SUPERSAMPLING for n in pixels.shape[:2])
    blocks = pixels.reshape(height, SUPERSAMPLING, width, SUPERSAMPLING, 3).mean(axis=(1, 3))
    image: Image = np.rint(blocks * 255.0).astype(np.uint8)
    return image


def write_png(path: Path, image: Image) -> None:
    """Write (height, width, 3) uint8 as an 8-bit RGB PNG."""
    path.write_bytes(png(image))


def png(image: Image) -> bytes:
    """Return (height, width, 3) uint8 as an 8-bit RGB PNG."""
    height, width = image.shape[:2]
    rows = np.concatenate([np.zeros((height, 1), np.uint8), image.reshape(height, -1)], axis=1)

    def chunk(kind: bytes, body: bytes) -> bytes:
        check = struct.pack(">I", zlib.crc32(kind + body))
        return struct.pack(">I", len(body)) + kind + body + check

    header = struct.pack(">IIBBBBB", width, height, 8, 2, 0, 0, 0)
    return (
        b"\x89PNG\r\n\x1a\n"
        + chunk(b"IHDR", header)
        + chunk(b"IDAT", zlib.compress(rows.tobytes(), 9))
        + chunk(b"IEND", b"")
    )


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the command line; 0 when the picture is written, 4 when the input is unreadable."""
    parser = argparse.ArgumentParser(
        prog="python -m freecad_tetra.export.picture",
        description="Draw the convex cells of an OBJ file apart.",
    )
    parser.add_argument("cells", type=Path, help="OBJ file with one object per cell")
    parser.add_argument("-o", "--output", type=Path, required=True, help="PNG file to write")
    parser.add_argument("--explode", type=float, default=0.5, help="0 leaves the cells in place")
    parser.add_argument("--azimuth", type=float, default=-55.0, metavar="DEG")
    parser.add_argument("--elevation", type=float, default=28.0, metavar="DEG")
    parser.add_argument("--width", type=int, default=1400, help="pixels, three quarters high")
    options = parser.parse_args(arguments)
    camera = Camera(
        np.radians(options.azimuth),
        np.radians(options.elevation),
        options.width,
        options.width * 3 // 4,
    )
    try:
        cells = read_cells(options.cells)
    except (OSError, ValueError, IndexError) as error:
        print(f"{options.cells}: not readable as cells: {error}", file=sys.stderr)
        return 4
    if not cells:
        print(f"{options.cells}: no cells in it", file=sys.stderr)
        return 4
    write_png(options.output, draw_cells(cells, options.explode, camera))
    return 0


if __name__ == "__main__":
    sys.exit(main())
