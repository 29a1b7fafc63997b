# SPDX-License-Identifier: LGPL-2.1-or-later
"""Named solids with exact volumes and known numbers of convex pieces, and families of any size.

Surfaces are ``(vertices, triangles)``: (n, 3) float64 (whole numbers unless turned) and (m, 3)
int32, index base 0, counter-clockwise seen from outside.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import numpy.typing as npt

Surface = tuple[npt.NDArray[np.float64], npt.NDArray[np.int32]]
SHARED = Path(__file__).resolve().parents[2] / "shared"


@dataclass(frozen=True)
class NamedShape:
    """A solid of the issues.

    Attributes
    ----------
    name : str
    surface : Surface
    volume : float
        Exact for whole-number coordinates.
    pieces : int or None
        Convex cells of exact notch cutting with merging; None where no number is claimed.
    genus, shells : int
    """

    name: str
    surface: Surface
    volume: float
    pieces: int | None = None
    genus: int = 0
    shells: int = 1

    @property
    def whole(self) -> bool:
        """Whether all coordinates are whole numbers, so that exact sums can be asked for."""
        return bool((self.surface[0] == np.rint(self.surface[0])).all())


def surface_of(vertices: npt.ArrayLike, triangles: npt.ArrayLike) -> Surface:
    """Weld equal vertices and bring both arrays into shape."""
    places, index = np.unique(np.asarray(vertices, dtype=float), axis=0, return_inverse=True)
    corners = index.reshape(-1)[np.asarray(triangles)]
    return places, np.ascontiguousarray(corners.reshape(-1, 3), dtype=np.int32)


def joined(*parts: Surface) -> Surface:
    """All parts in one surface; their vertices stay apart."""
    shifts = np.cumsum([0] + [len(part[0]) for part in parts])
    triangles = np.concatenate([part[1] + shift for part, shift in zip(parts, shifts)])
    return np.concatenate([part[0] for part in parts]), triangles.astype(np.int32)


def inverted(surface: Surface) -> Surface:
    """The same surface facing the other way, as the wall of a cavity."""
    return surface[0], np.ascontiguousarray(surface[1][:, ::-1])


def turned(surface: Surface, degrees: tuple[float, float, float]) -> Surface:
    """Rotated about x, y and z in this order; rounded to doubles, no longer on the grid."""
    matrix = np.eye(3)
    for axis, angle in enumerate(np.radians(degrees)):
        u, v = (axis + 1) % 3, (axis + 2) % 3
        step = np.eye(3)
        step[u, u] = step[v, v] = math.cos(angle)
        step[v, u] = math.sin(angle)
        step[u, v] = -math.sin(angle)
        matrix = step @ matrix
    return surface[0] @ matrix.T, surface[1]


def volume_of(surface: Surface) -> float:
    """Enclosed volume; exact while six times it and all partial sums stay below 2**53."""
    corners = surface[0][surface[1]]
    return float(np.einsum("ij,ij->", corners[:, 0], np.cross(corners[:, 1], corners[:, 2]))) / 6


def clip_ears(polygon: list[tuple[float, float]]) -> list[tuple[int, int, int]]:
    """Triangles of a simple counter-clockwise polygon; cubic, for small outlines."""

    def turn(a: int, b: int, c: int) -> float:
        (ax, ay), (bx, by), (cx, cy) = polygon[a], polygon[b], polygon[c]
        return (bx - ax) * (cy - ay) - (by - ay) * (cx - ax)

    left, triangles = list(range(len(polygon))), []
    while len(left) > 2:
        for i, b in enumerate(left):
            a, c = left[i - 1], left[(i + 1) % len(left)]
            others = [v for v in left if v not in (a, b, c)]
            if turn(a, b, c) > 0 and not any(
                turn(a, b, v) >= 0 and turn(b, c, v) >= 0 and turn(c, a, v) >= 0 for v in others
            ):
                triangles.append((a, b, c))
                del left[i]
                break
        else:
            raise ValueError("the outline is not simple and counter-clockwise")
    return triangles


def prism(outline: list[tuple[float, float]], low: float, high: float) -> Surface:
    """The upright prism over a simple counter-clockwise outline."""
    count = len(outline)
    vertices = [(x, y, z) for z in (low, high) for x, y in outline]
    triangles = []
    for a, b, c in clip_ears(outline):
        triangles += [(a, c, b), (a + count, b + count, c + count)]
    for i in range(count):
        j = (i + 1) % count
        triangles += [(i, j, j + count), (i, j + count, i + count)]
    return surface_of(vertices, triangles)


def ring_prism(
    outer: list[tuple[float, float]], inner: list[tuple[float, float]], low: float, high: float
) -> Surface:
    """The prism between two counter-clockwise outlines with as many corners, genus 1."""
    count = len(outer)
    vertices = [(x, y, z) for z in (low, high) for loop in (outer, inner) for x, y in loop]
    triangles = []
    for i in range(count):
        j = (i + 1) % count
        bottom_outer, bottom_inner, top_outer, top_inner = (count * k for k in range(4))
        for a, b in (
            (bottom_outer, top_outer),
            (top_outer, top_inner),
            (top_inner, bottom_inner),
            (bottom_inner, bottom_outer),
        ):
            triangles += [(a + i, a + j, b + j), (a + i, b + j, b + i)]
    return surface_of(vertices, triangles)


def box(low: tuple[float, float, float], high: tuple[float, float, float]) -> Surface:
    """An axis-parallel box of twelve triangles."""
    outline = [(low[0], low[1]), (high[0], low[1]), (high[0], high[1]), (low[0], high[1])]
    return prism(outline, low[2], high[2])


def cells_solid(full: npt.ArrayLike, *stops: npt.ArrayLike) -> Surface:
    """The union of the cells ``full[x, y, z]`` between grid planes at `stops`, default 0, 1, ...

    Two triangles for each cell face; cells that touch in an edge or corner share its points.
    """
    full = np.asarray(full, dtype=bool)
    places = [
        np.asarray(stops[k] if k < len(stops) else np.arange(n + 1), dtype=float)
        for k, n in enumerate(full.shape)
    ]
    padded = np.pad(full, 1)
    quads = []
    for axis in range(3):
        u, v = (axis + 1) % 3, (axis + 2) % 3
        for positive in (0, 1):
            beyond = np.roll(padded, -1 if positive else 1, axis=axis)
            where = np.argwhere(padded & ~beyond) - 1
            quad = np.zeros((len(where), 4, 3), dtype=int) + where[:, None, :]
            quad[:, :, axis] += positive
            quad[:, :, u] += np.array([0, 1, 1, 0])
            quad[:, :, v] += np.array([0, 0, 1, 1])
            quads.append(quad if positive else quad[:, ::-1])
    corners = np.concatenate(quads)
    vertices = np.stack([places[k][corners[:, :, k]] for k in range(3)], axis=-1).reshape(-1, 3)
    first = 4 * np.arange(len(corners))[:, None]
    triangles = np.concatenate([first + np.array(half) for half in ((0, 1, 2), (0, 2, 3))])
    return surface_of(vertices, triangles)


def l_prism() -> Surface:
    return prism([(0, 0), (8, 0), (8, 4), (4, 4), (4, 8), (0, 8)], 0, 4)


def boss_on_plate() -> Surface:
    full = np.zeros((3, 3, 2))
    full[:, :, 0] = 1
    full[1, 1, 1] = 1
    return cells_solid(full, [0, 4, 8, 12], [0, 4, 8, 12], [0, 4, 8])


def cube_with_cavity() -> Surface:
    return joined(box((0, 0, 0), (12, 12, 12)), inverted(box((4, 4, 4), (8, 8, 8))))


def square_frame() -> Surface:
    square = [(0, 0), (12, 0), (12, 12), (0, 12)]
    return ring_prism(square, [(4, 4), (8, 4), (8, 8), (4, 8)], 0, 4)


def cubes_touching_in_an_edge() -> Surface:
    return cells_solid([[[1], [0]], [[0], [1]]])


def cubes_touching_in_a_vertex() -> Surface:
    return cells_solid([[[1, 0], [0, 0]], [[0, 0], [0, 1]]])


def vertex_on_a_face() -> Surface:
    """A pyramid standing on its apex inside the upper face of a plate."""
    tip, top = (3, 7, 4), [(1, 5, 12), (5, 5, 12), (5, 9, 12), (1, 9, 12)]
    fan = [(0, 2, 1), (0, 3, 2), (0, 4, 3), (0, 1, 4), (1, 2, 3), (1, 3, 4)]
    return joined(box((0, 0, 0), (12, 12, 4)), surface_of([tip, *top], fan))


def stairs(steps: int = 5) -> Surface:
    outline = [(0, 0), (4 * steps, 0)]
    for i in range(steps, 0, -1):
        rise = 4 * (steps - i + 1)
        outline += [(4 * i, rise), (4 * (i - 1), rise)] if i > 1 else [(4 * i, rise), (0, rise)]
    return prism([(float(x), float(y)) for x, y in outline], 0, 4)


def spiral_staircase(turns: int = 1) -> Surface:
    """Steps of height two, each one above the last, over the cells around the middle of 3 x 3."""
    around = [(0, 0), (1, 0), (2, 0), (2, 1), (2, 2), (1, 2), (0, 2), (0, 1)]
    full = np.zeros((3, 3, 8 * turns + 1))
    for i in range(8 * turns):
        x, y = around[i % 8]
        full[x, y, i : i + 2] = 1
    return cells_solid(full)


def nut(turn: tuple[float, float, float] = (0, 0, 17)) -> Surface:
    """A ring between a hexagon and a smaller one, turned: its faces are flat on no grid."""
    outer = [(10 * math.cos(math.pi * k / 3), 10 * math.sin(math.pi * k / 3)) for k in range(6)]
    return turned(ring_prism(outer, [(x / 2, y / 2) for x, y in outer], 0, 8), turn)


def cgal_issue_8379() -> Surface:
    """Box 10 x 10 x 8 minus box 8 x 8 x 10, united with box 12 x 12 x 4, all centred.

    A stack of squares joined by strips, from the upper floor inside the frame to the lower one.
    """
    stack = [(4, 2), (4, 4), (5, 4), (5, 2), (6, 2), (6, -2), (5, -2), (5, -4), (4, -4), (4, -2)]
    vertices = [
        (x * r, y * r, z) for r, z in stack for x, y in ((-1, -1), (1, -1), (1, 1), (-1, 1))
    ]
    last = len(vertices) - 4
    triangles = [(0, 1, 2), (0, 2, 3), (last, last + 2, last + 1), (last, last + 3, last + 2)]
    for low in range(0, last, 4):
        for i in range(4):
            a, b = low + i, low + (i + 1) % 4
            triangles += [(a, a + 4, b + 4), (a, b + 4, b)]
    return surface_of(vertices, triangles)


def cgal_issue_8379_gridded() -> Surface:
    """The same solid with its faces divided along all its grid planes."""
    full = np.zeros((5, 5, 3))
    full[:, :, 1] = 1
    full[1:4, 1:4, :] = 1
    full[2, 2, ::2] = 0
    stops = [-6, -5, -4, 4, 5, 6]
    return cells_solid(full, stops, stops, [-4, -2, 2, 4])


def plate_with_holes(rows: int = 10, columns: int = 10) -> Surface:
    full = np.ones((2 * columns + 1, 2 * rows + 1, 1))
    full[1::2, 1::2] = 0
    return cells_solid(full, *(4 * np.arange(n + 1) for n in full.shape))


def schoenhardt() -> Surface:
    """A triangular prism twisted by 30 degrees with its side diagonals pushed in."""
    vertices = [(1000, 0, 0), (-500, 866, 0), (-500, -866, 0)]
    vertices += [(866, 500, 1000), (-866, 500, 1000), (0, -1000, 1000)]
    triangles = [(0, 2, 1), (3, 4, 5)]
    for i in range(3):
        j = (i + 1) % 3
        triangles += [(i, j, j + 3), (i, j + 3, i + 3)]
    return surface_of(vertices, triangles)


def spike_cup() -> Surface:
    """A pyramid with a pit from below whose tip hinders the dome of the apex."""
    vertices = [(-10, -10, 0), (10, -10, 0), (10, 10, 0), (-10, 10, 0), (0, 0, 20), (1, 0, 8)]
    triangles = []
    for i in range(4):
        j = (i + 1) % 4
        triangles += [(i, j, 4), (j, i, 5)]
    return surface_of(vertices, triangles)


def vertical_edges_above_one_another() -> Surface:
    """Two towers on opposite sides of a slab, their corners on one vertical line."""
    full = np.zeros((3, 3, 3))
    full[:, :, 1] = 1
    full[:2, :2, 2] = 1
    full[1:, 1:, 0] = 1
    return cells_solid(full)


def shelves() -> Surface:
    """A comb whose teeth overlap in projection along every axis but one."""
    full = np.zeros((4, 1, 5))
    full[0] = 1
    full[:, :, ::2] = 1
    return cells_solid(full, [0, 1, 3, 6, 10], [0, 5], [0, 1, 3, 4, 7, 8])


def three_way_frame() -> Surface:
    full = np.ones((3, 3, 3))
    full[1, 1, :] = full[1, :, 1] = full[:, 1, 1] = 0
    return cells_solid(full)


def dented_ball(around: int = 8, up: int = 6, size: int = 1000) -> Surface:
    """A convex lattice ball with one vertex pushed in half way."""
    vertices, triangles = sphere(around, up, size)
    dented = vertices.copy()
    dented[np.argmax(dented @ [1.0, 0.3, 0.2])] *= 0.5
    return np.rint(dented), triangles


def sphere(around: int, up: int, size: float = 2**20) -> Surface:
    """A ball of 2 * around * (up - 1) triangles with whole-number coordinates."""
    angles = 2 * np.pi * np.arange(around) / around
    heights = np.pi * np.arange(1, up) / up
    rings = np.stack(
        [
            np.outer(np.sin(heights), np.cos(angles)),
            np.outer(np.sin(heights), np.sin(angles)),
            np.outer(np.cos(heights), np.ones(around)),
        ],
        axis=-1,
    ).reshape(-1, 3)
    vertices = np.rint(size * np.concatenate([rings, [[0, 0, 1], [0, 0, -1]]]))
    i = np.arange(around)
    j = (i + 1) % around
    north, south = len(rings), len(rings) + 1
    parts = [np.stack([np.full(around, north), i, j], axis=1)]
    for k in range(up - 2):
        a, b = k * around, (k + 1) * around
        parts += [np.stack([a + i, b + i, b + j], axis=1), np.stack([a + i, b + j, a + j], axis=1)]
    last = (up - 2) * around
    parts.append(np.stack([np.full(around, south), last + j, last + i], axis=1))
    return vertices, np.concatenate(parts).astype(np.int32)


def torus(around: int = 24, tube: int = 12, bumps: float = 0.0, size: float = 2**18) -> Surface:
    """A torus of 2 * around * tube triangles, whole numbers; `bumps` in 0..0.5 ripples its tube."""
    u = 2 * np.pi * np.arange(around)[:, None] / around
    v = 2 * np.pi * np.arange(tube)[None, :] / tube
    ripple = bumps * np.sin(np.round(around / 7) * u) * np.sin(np.round(tube / 5) * v)
    radius = 0.4 * (1 + ripple)
    ring = 1 + radius * np.cos(v)
    places = np.stack([ring * np.cos(u), ring * np.sin(u), radius * np.sin(v) + 0 * u], axis=-1)
    vertices = np.rint(size * places.reshape(-1, 3))
    i, j = np.meshgrid(np.arange(around), np.arange(tube), indexing="ij")
    a, b = i * tube + j, (i + 1) % around * tube + j
    c, d = (i + 1) % around * tube + (j + 1) % tube, i * tube + (j + 1) % tube
    triangles = np.concatenate(
        [np.stack([a, b, c], axis=-1).reshape(-1, 3), np.stack([a, c, d], axis=-1).reshape(-1, 3)]
    )
    return vertices, triangles.astype(np.int32)


def read_off(path: Path) -> Surface:
    words = path.read_text(encoding="ascii").split()[1:]
    count, faces = int(words[0]), int(words[1])
    numbers = np.array([float(w) for w in words[3:]])
    rows = numbers[3 * count : 3 * count + 4 * faces].reshape(faces, 4)
    return numbers[: 3 * count].reshape(-1, 3), np.ascontiguousarray(rows[:, 1:], dtype=np.int32)


def chazelle(notches: int) -> Surface:
    """The lower-bound family of the corpus (ALGORITHMS 2.5); (N + 2)^2 cells suffice."""
    return read_off(SHARED / "corpus" / "family" / f"chazelle-{notches}.off")


def named_shapes() -> list[NamedShape]:
    """The named cases of the issues, small enough for every test run."""
    ring_area = 1.5 * math.sqrt(3) * (100 - 25)
    odd = (13.0, 29.0, 41.0)
    shapes = [
        NamedShape("cube", box((0, 0, 0), (4, 4, 4)), 64, 1),
        NamedShape("l_prism", l_prism(), 192, 2),
        NamedShape("boss_on_plate", boss_on_plate(), 640, 2),
        NamedShape("cube_with_cavity", cube_with_cavity(), 1664, 6, shells=2),
        NamedShape("square_frame", square_frame(), 512, 4, genus=1),
        NamedShape("edge_contact", cubes_touching_in_an_edge(), 2, 2, shells=2),
        NamedShape("vertex_contact", cubes_touching_in_a_vertex(), 2, 2, shells=2),
        NamedShape("vertex_on_a_face", vertex_on_a_face(), 576 + 128 / 3, 2, shells=2),
        NamedShape("stairs", stairs(), 960, 5),
        NamedShape("spiral_staircase", spiral_staircase(), 16, 8),
        NamedShape("turned_nut", nut(), 8 * ring_area, 6, genus=1),
        NamedShape("nut_turned_oddly", nut(odd), 8 * ring_area, 6, genus=1),
        NamedShape("cgal_8379", cgal_issue_8379(), 720, 9),
        NamedShape("cgal_8379_turned", turned(cgal_issue_8379(), odd), 720, 9),
        NamedShape("cgal_8379_gridded", cgal_issue_8379_gridded(), 720, 9),
        NamedShape("cgal_8379_gridded_turned", turned(cgal_issue_8379_gridded(), odd), 720),
        NamedShape("plate_with_100_holes", plate_with_holes(), 341 * 64, genus=100),
        NamedShape("schoenhardt", schoenhardt(), volume_of(schoenhardt())),
        NamedShape("spike_cup", spike_cup(), 1600),
        NamedShape("vertical_edges", vertical_edges_above_one_another(), 17, 3),
        NamedShape("shelves", shelves(), volume_of(shelves()), 4),
        NamedShape("three_way_frame", three_way_frame(), 20, genus=5),
        NamedShape("torus", torus(), volume_of(torus()), genus=1),
        NamedShape("dented_ball", dented_ball(), volume_of(dented_ball())),
        NamedShape("turned_l_prism", turned(l_prism(), odd), 192, 2),
    ]
    for n in (2, 4):
        surface = chazelle(n)
        shapes.append(NamedShape(f"chazelle_{n}", surface, volume_of(surface), (n + 2) ** 2))
    r7b = read_off(SHARED / "corpus" / "cases" / "fence-r7b.off")
    shapes.append(NamedShape("fence_r7b", r7b, volume_of(r7b), genus=5))
    return shapes
