# SPDX-License-Identifier: LGPL-2.1-or-later
"""Random small solids on the integer grid, full of contacts and coincidences, from a fixed seed.

Every generator returns ``(vertices, triangles)``: (n, 3) int64 grid coordinates and (m, 3) int32
0-based indices, counter-clockwise seen from outside. Nothing depends on anything but the seed.
"""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

Array = npt.NDArray[np.int64]
Surface = tuple[Array, npt.NDArray[np.int32]]

MAPS = (
    "aligned",  # even steps along the axes
    "uneven",  # every grid plane at a place of its own
    "sheared",  # a unimodular integer map
    "mapped",  # a general integer map
    "jitter_z",  # moved along z: vertical faces stay vertical
    "jitter_sparse",  # one vertex in four moved
    "jitter",  # every vertex moved: each quad becomes two planes
    "jitter_mapped",
)


def volume6(vertices: Array, triangles: npt.NDArray[np.int32]) -> int:
    """Six times the enclosed volume, exact in Python's integers, O(m)."""
    corners = vertices[triangles].astype(object)
    a, b, c = corners[:, 0], corners[:, 1], corners[:, 2]
    return int(
        (
            a[:, 0] * (b[:, 1] * c[:, 2] - b[:, 2] * c[:, 1])
            + a[:, 1] * (b[:, 2] * c[:, 0] - b[:, 0] * c[:, 2])
            + a[:, 2] * (b[:, 0] * c[:, 1] - b[:, 1] * c[:, 0])
        ).sum()
    )


def weld(vertices: Array, triangles: npt.NDArray[np.int32]) -> Surface:
    """Merge equal places, drop triangles with a repeated corner and vertices without a triangle."""
    places, index = np.unique(vertices, axis=0, return_inverse=True)
    corners = index.reshape(-1)[triangles]
    distinct = (corners != np.roll(corners, 1, axis=1)).all(axis=1)
    corners = corners[distinct]
    used, renamed = np.unique(corners, return_inverse=True)
    return places[used], renamed.reshape(-1, 3).astype(np.int32)


def join(*parts: Surface) -> Surface:
    """All the surfaces in one, their vertices kept apart."""
    shifts = np.cumsum([0] + [len(vertices) for vertices, _ in parts])
    triangles = [part[1] + shift for part, shift in zip(parts, shifts)]
    return np.concatenate([part[0] for part in parts]), np.concatenate(triangles).astype(np.int32)


def mapped(surface: Surface, matrix: npt.ArrayLike, shift: npt.ArrayLike = (0, 0, 0)) -> Surface:
    """The image under an integer map; one that mirrors turns the triangles over."""
    matrix = np.asarray(matrix, dtype=np.int64)
    vertices, triangles = surface
    turned = triangles[:, ::-1] if round(np.linalg.det(matrix)) < 0 else triangles
    image = vertices @ matrix.T + np.asarray(shift, dtype=np.int64)
    return image, np.ascontiguousarray(turned)


def shuffled(surface: Surface, rng: np.random.Generator) -> tuple[Surface, Array, Array]:
    """The same solid with vertices and triangles in random order, and the two permutations.

    Returns
    -------
    surface, vertex_order, triangle_order
        New vertex i was ``vertex_order[i]``, new triangle j was ``triangle_order[j]``.
    """
    vertices, triangles = surface
    vertex_order = rng.permutation(len(vertices))
    triangle_order = rng.permutation(len(triangles))
    place = np.argsort(vertex_order)
    return (
        (vertices[vertex_order], place[triangles[triangle_order]].astype(np.int32)),
        vertex_order,
        triangle_order,
    )


def voxel_surface(
    cells: npt.NDArray[np.bool_], turns: npt.NDArray[np.bool_] | None = None
) -> Surface:
    """The boundary of a union of grid cells ``cells[x, y, z]``, two triangles a quad.

    Grid corners are shared, so that cells touching in an edge or a corner only give contacts of
    types 2 and 3. ``turns[axis, x, y, z]``, one longer than `cells` along each axis, picks the
    diagonal of each quad.
    """
    size = np.array(cells.shape)
    full = np.pad(cells, 1)
    parts: list[Array] = []
    for axis in range(3):
        u, v = (axis + 1) % 3, (axis + 2) % 3
        for positive in (0, 1):
            beyond = np.roll(full, -1 if positive else 1, axis=axis)
            where = np.argwhere(full & ~beyond) - 1
            quad = np.zeros((len(where), 4, 3), dtype=np.int64) + where[:, None, :]
            quad[:, :, axis] += positive
            quad[:, :, u] += np.array([0, 1, 1, 0])
            quad[:, :, v] += np.array([0, 0, 1, 1])
            if turns is not None:
                least = quad[:, 0]
                turned = turns[axis, least[:, 0], least[:, 1], least[:, 2]]
                quad[turned] = np.roll(quad[turned], 1, axis=1)
            parts.append(quad if positive else quad[:, ::-1])
    quads = np.concatenate(parts)
    corners = np.ravel_multi_index(tuple(quads.reshape(-1, 3).T), tuple(size + 1)).reshape(-1, 4)
    triangles = np.concatenate([corners[:, [0, 1, 2]], corners[:, [0, 2, 3]]])
    used, renamed = np.unique(triangles, return_inverse=True)
    places = np.stack(np.unravel_index(used, tuple(size + 1)), axis=1).astype(np.int64)
    return places, renamed.reshape(-1, 3).astype(np.int32)


def random_cells(
    rng: np.random.Generator, low: int = 2, high: int = 4, cavities: bool = False
) -> npt.NDArray[np.bool_]:
    """A random set of cells, never empty; with `cavities` inside a closed crust."""
    size = rng.integers(low, high + 1, 3)
    density = rng.choice([0.2, 0.35, 0.5, 0.65, 0.8])
    checkered = rng.random() < 0.2
    while True:
        cells = rng.random(size) < density
        if checkered:
            odd = np.indices(size).sum(axis=0) % 2 == 1
            cells &= ~(odd & (rng.random(size) < 0.8))
        if cavities:
            return np.pad(cells, 1, constant_values=True)
        if cells.any():
            return cells


def general_matrix(rng: np.random.Generator) -> Array:
    while True:
        matrix = rng.integers(-3, 4, (3, 3))
        if round(np.linalg.det(matrix)) != 0:
            return matrix


def shear_matrix(rng: np.random.Generator) -> Array:
    matrix = np.eye(3, dtype=np.int64)
    for _ in range(rng.integers(1, 4)):
        row, other = rng.choice(3, 2, replace=False)
        matrix[row] += rng.choice([-1, 1]) * matrix[other]
    return matrix


def random_voxel(
    seed: int,
    kind: str | None = None,
    high: int = 4,
    cavities: bool | None = None,
    max_bits: int = 20,
    without: tuple[int, ...] = (),
) -> Surface:
    """A voxel solid under one of `MAPS`.

    Vertices move by at most a tenth of a cell: directions then turn by less than 0.35 rad, while
    separate triangles at a vertex are at least 45 degrees apart, so that the solid stays valid.
    Coordinates stay within ``2**max_bits``. Of its cells, counted through the grid, those in
    `without` are left out with nothing else changed: so a failing solid is made smaller.
    """
    rng = np.random.default_rng(seed)
    if kind is None:
        kind = str(rng.choice(MAPS))
    if cavities is None:
        cavities = bool(rng.random() < 0.15)
    cells = random_cells(rng, 2, high, cavities)
    shape = tuple(np.array(cells.shape) + 1)
    turns = rng.integers(0, 2, (3, *shape)) == 1 if rng.random() < 0.5 else None
    cells.reshape(-1)[np.flatnonzero(cells)[list(without)]] = False
    places, triangles = voxel_surface(cells, turns)
    room = max_bits - 7
    bits = 2 if rng.random() < 2 / 3 else int(rng.integers(2, room + 1))
    jittered = kind.startswith("jitter")
    reach = int(rng.integers(1, 2 ** max(0, bits - 4) + 1)) if jittered else 0
    step = max(2**bits, 10 * reach)
    vertices = places * step
    if kind == "uneven":
        for axis in range(3):
            stops = np.concatenate([[0], np.cumsum(rng.integers(1, step + 1, cells.shape[axis]))])
            vertices[:, axis] = stops[places[:, axis]]
    if jittered:
        moves = rng.integers(-reach, reach + 1, (*shape, 3))
        if kind == "jitter_z":
            moves[..., :2] = 0
        if kind == "jitter_sparse":
            moves *= rng.random((*shape, 1)) < 0.25
        vertices = vertices + moves[tuple(places.T)]
    surface = (vertices, triangles)
    if kind == "sheared":
        return mapped(surface, shear_matrix(rng))
    if kind in ("mapped", "jitter_mapped"):
        return mapped(surface, general_matrix(rng))
    return surface


def random_type1(seed: int) -> Surface:
    """A voxel solid standing on one vertex inside a top triangle of another, sheared at random."""
    rng = np.random.default_rng(seed)
    below = mapped(
        random_voxel(int(rng.integers(2**40)), "aligned", 3, max_bits=10), 64 * np.eye(3)
    )
    kind = str(rng.choice(["uneven", "jitter"]))
    upper = random_voxel(int(rng.integers(2**40)), kind, 3, False, max_bits=9)
    reach = int(2 * np.abs(upper[0]).max() + 1)
    # Heights order the points lexicographically, so that the lowest one is alone.
    above = mapped(upper, [[1, 0, 0], [0, 1, 0], [1, reach, reach * reach]])
    foot = above[0][np.argmin(above[0][:, 2])]
    vertices, triangles = below
    top = vertices[:, 2].max()
    flat = triangles[(vertices[triangles][:, :, 2] == top).all(axis=1)]
    a, b, c = vertices[rng.choice(flat)]
    spot = (2 * a + b + c) // 4
    solid = join(below, (above[0] - foot + spot, above[1]))
    return mapped(solid, shear_matrix(rng)) if rng.random() < 0.5 else solid


def random_csg(seed: int, bodies: int | None = None) -> Surface:
    """Unions and differences of boxes, prisms and hulls on a coarse grid, by manifold3d.

    The coarse grid makes faces, edges and corners coincide; crossings of oblique faces are then
    rounded to the fine grid, and such a result may cross itself: have it validated.
    """
    import manifold3d

    rng = np.random.default_rng(seed)
    coarse = int(rng.integers(2, 6))
    scale = int(rng.choice([12, 60, 1024, 2**14]))

    def body() -> manifold3d.Manifold:
        kind = rng.integers(0, 4)
        low = rng.integers(0, coarse, 3)
        extent = rng.integers(1, coarse + 1, 3)
        if kind <= 1:
            return manifold3d.Manifold.cube(extent.tolist()).translate(low.tolist())
        if kind == 2:
            corners = np.array([(0, 0), (1, 0), (1, 1), (0, 1), (2, 1), (1, 2)])[
                rng.choice(6, int(rng.integers(3, 6)), replace=False)
            ]
            points = np.concatenate([np.c_[corners, np.full(len(corners), z)] for z in (0, 1)])
            points = np.roll(points, rng.integers(0, 3), axis=1)
        else:
            points = rng.integers(0, 3, (int(rng.integers(4, 9)), 3))
        return manifold3d.Manifold.hull_points((points * extent + low).astype(float))

    solid = body()
    for _ in range(int(rng.integers(1, 5)) if bodies is None else bodies):
        other = body()
        if not other.is_empty():
            solid = solid + other if rng.random() < 0.5 else solid - other
    if solid.is_empty():
        return random_csg(seed + 2**41, bodies)
    mesh = solid.to_mesh64() if hasattr(solid, "to_mesh64") else solid.to_mesh()
    vertices = np.rint(np.asarray(mesh.vert_properties)[:, :3] * scale).astype(np.int64)
    surface = weld(vertices, np.asarray(mesh.tri_verts, dtype=np.int32))
    if len(surface[1]) < 4:
        return random_csg(seed + 2**41, bodies)
    if rng.random() < 0.3:
        surface = mapped(surface, shear_matrix(rng))
    return surface


def random_hull(seed: int, points: int | None = None, dents: int = 0, size: int = 99) -> Surface:
    """The hull of random grid points (scipy), with some of its vertices pulled inwards."""
    from scipy.spatial import ConvexHull

    rng = np.random.default_rng(seed)
    count = int(rng.integers(5, 40)) if points is None else points
    cloud = rng.integers(-size, size + 1, (count, 3))
    hull = ConvexHull(cloud)
    triangles = hull.simplices.copy()
    corners = cloud[triangles]
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    flip = (normals * hull.equations[:, :3]).sum(axis=1) < 0
    triangles[flip] = triangles[flip, ::-1]
    vertices, triangles = weld(cloud, triangles.astype(np.int32))
    centre = vertices.mean(axis=0)
    for vertex in rng.choice(len(vertices), dents, replace=False):
        vertices[vertex] = np.rint(0.5 * vertices[vertex] + 0.5 * centre)
    return vertices, triangles


def random_solid(seed: int, without: tuple[int, ...] = ()) -> Surface:
    """Any of the families; solids from `random_csg` may be invalid, the rest is valid.

    `without` leaves cells out of voxel solids and is ignored by the others.
    """
    family = seed % 10
    if family < 6:
        return random_voxel(seed, without=without)
    if family < 7:
        return random_type1(seed)
    if family < 8:
        return random_hull(seed, dents=seed // 10 % 3)
    return random_csg(seed)


def to_off(surface: Surface) -> str:
    vertices, triangles = surface
    lines = ["OFF", f"{len(vertices)} {len(triangles)} 0"]
    lines += [" ".join(map(str, row)) for row in vertices.tolist()]
    lines += ["3 " + " ".join(map(str, row)) for row in triangles.tolist()]
    return "\n".join(lines) + "\n"


def read_off(path: str) -> Surface:
    with open(path, encoding="ascii") as file:
        lines = [line.split("#")[0] for line in file]
    words = " ".join(lines).split()[1:]
    count, faces = int(words[0]), int(words[1])
    numbers = np.array([float(w) for w in words[3:]])
    vertices = numbers[: 3 * count].reshape(-1, 3)
    triangles = numbers[3 * count :].astype(np.int32).reshape(faces, 4)[:, 1:]
    if (vertices == np.rint(vertices)).all():
        vertices = vertices.astype(np.int64)
    return vertices, np.ascontiguousarray(triangles)
