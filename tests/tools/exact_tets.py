# SPDX-License-Identifier: LGPL-2.1-or-later
"""Proves in exact integers that tetrahedra of doubles fill a solid face to face.

Orientation, pairing and the closed skin are exact for any coordinates. Whether the skin is the
solid's own surface is proven by signed flags (see exact_cells) when all skin points are the solid's
vertices, and measured by distance, area and normal where Steiner points had to be rounded.
"""

from __future__ import annotations

from collections import Counter
from fractions import Fraction

import numpy as np
import numpy.typing as npt
from exact_cells import FlagSum, from_fractions, plane_through


class NotATetMesh(AssertionError):
    """What is wrong with the tetrahedra, in words."""


def require(holds: bool, message: str) -> None:
    if not holds:
        raise NotATetMesh(message)


def as_integers(points: npt.ArrayLike) -> tuple[list[tuple[int, int, int]], int]:
    """Doubles as integers over one common power of two, exact."""
    rows = [[Fraction(c) for c in row] for row in np.asarray(points, dtype=float).tolist()]
    scale = max((c.denominator for row in rows for c in row), default=1)
    return [tuple(int(c * scale) for c in row) for row in rows], scale  # type: ignore[misc]


def determinants(points: npt.ArrayLike, tets: npt.ArrayLike) -> tuple[list[int], int]:
    """det(b - a, c - a, d - a) of each tetrahedron times scale^3, and the scale."""
    grid, scale = as_integers(points)
    result = []
    for tet in np.asarray(tets).tolist():
        a, *others = (grid[v] for v in tet)
        u, v, w = ([p[k] - a[k] for k in range(3)] for p in others)
        result.append(
            u[0] * (v[1] * w[2] - v[2] * w[1])
            - u[1] * (v[0] * w[2] - v[2] * w[0])
            + u[2] * (v[0] * w[1] - v[1] * w[0])
        )
    return result, scale


def sorted_face(face: tuple[int, int, int]) -> tuple[tuple[int, ...], int]:
    """Ascending ids, and +1 or -1 for an even or odd order."""
    a, b, c = face
    odd = (a > b) + (b > c) + (a > c)
    return tuple(sorted(face)), -1 if odd % 2 else 1


def unpaired_faces(tets: npt.ArrayLike) -> list[tuple[int, int, int]]:
    """Faces on one tetrahedron, outward; raises when a face is not on one or two, opposite."""
    sides: dict[tuple[int, ...], list[tuple[int, tuple[int, int, int]]]] = {}
    for a, b, c, d in np.asarray(tets).tolist():
        for face in ((b, c, d), (a, d, c), (a, b, d), (a, c, b)):
            key, sign = sorted_face(face)
            sides.setdefault(key, []).append((sign, face))
    skin = []
    for key, uses in sides.items():
        signs = sorted(sign for sign, _ in uses)
        require(len(set(key)) == 3, f"a tetrahedron repeats a vertex in {key}")
        require(signs in ([-1], [1], [-1, 1]), f"face {key} has tetrahedra on sides {signs}")
        if len(uses) == 1:
            skin.append(uses[0][1])
    return skin


def turned_to_least(face: tuple[int, int, int]) -> tuple[int, int, int]:
    k = face.index(min(face))
    return (face[k], face[(k + 1) % 3], face[(k + 2) % 3])


def verify_tets(
    vertices: npt.ArrayLike,
    triangles: npt.ArrayLike,
    points: npt.ArrayLike,
    tets: npt.ArrayLike,
    skin: npt.ArrayLike | None = None,
    skin_source: npt.ArrayLike | None = None,
    point_source: npt.ArrayLike | None = None,
    moved: int = 0,
) -> dict[str, float]:
    """Prove a tetrahedral mesh of a solid.

    Parameters
    ----------
    vertices, triangles : (n, 3) float, (m, 3) int
        The solid.
    points, tets : (p, 3) float, (t, 4) int
        The mesh as returned.
    skin, skin_source : (s, 3) int, (s,) int, optional
        Its outward surface, and the solid's triangle each lies on.
    point_source : (p,) int, optional
        The solid's vertex that each point is, or -1.
    moved : int
        How many of the solid's vertices the kernel says it left on its grid.

    Returns
    -------
    dict
        Counts, the exact relative error of volume and what the skin was held to.

    Raises
    ------
    NotATetMesh
    """
    vertices, triangles = np.asarray(vertices, dtype=float), np.asarray(triangles)
    points, tets = np.asarray(points, dtype=float), np.asarray(tets)
    dets, scale = determinants(points, tets)
    bad = [i for i, det in enumerate(dets) if det <= 0]
    require(not bad, f"{len(bad)} tetrahedra are inverted or flat, the first is {bad[:1]}")
    free = unpaired_faces(tets)
    if skin is not None:
        given = Counter(turned_to_least(tuple(t)) for t in np.asarray(skin).tolist())
        require(
            given == Counter(map(turned_to_least, free)), "skin differs from the unpaired faces"
        )
    volume = Fraction(sum(dets), scale**3)
    grid, unit = as_integers(vertices)
    enclosed = Fraction(sum(_volume6(grid, t) for t in triangles.tolist()), unit**3)
    error = float(abs(volume - enclosed) / enclosed)
    tolerance = 1e-6 if moved else 1e-11
    require(error <= tolerance, f"volume differs by {error:.3g}")
    if point_source is not None:
        _check_sources(vertices, triangles, points, np.asarray(point_source), moved)
    whole = bool((vertices == np.rint(vertices)).all())
    exact = whole and _check_skin_exactly(vertices, triangles, points, free)
    if not exact:
        _check_skin_closely(vertices, triangles, points, np.array(free), tolerance)
    if skin is not None and skin_source is not None:
        _check_skin_sources(
            vertices, triangles, points, np.asarray(skin), np.asarray(skin_source), moved
        )
    return {"tets": len(tets), "skin": len(free), "volume_error": error, "skin_exact": float(exact)}


def _volume6(grid: list[tuple[int, int, int]], triangle: list[int]) -> int:
    a, b, c = (grid[v] for v in triangle)
    return (
        a[0] * (b[1] * c[2] - b[2] * c[1])
        + a[1] * (b[2] * c[0] - b[0] * c[2])
        + a[2] * (b[0] * c[1] - b[1] * c[0])
    )


def _check_sources(
    vertices: npt.NDArray[np.float64],
    triangles: npt.NDArray[np.int32],
    points: npt.NDArray[np.float64],
    source: npt.NDArray[np.int32],
    moved: int,
) -> None:
    """Every vertex that bounds the solid is there, bit for bit but for those told."""
    own = source >= 0
    off = (points[own] != vertices[source[own]]).any(axis=1)
    require(int(off.sum()) <= moved, f"{off.sum()} input vertices have moved, {moved} told")
    there = set(source[own].tolist())
    # Vertices that share a place with another are represented by one of them.
    places = {tuple(row) for row in points.tolist()}
    lost = [
        v
        for v in np.unique(triangles).tolist()
        if v not in there and tuple(vertices[v].tolist()) not in places
    ]
    require(not lost, f"input vertices {lost[:5]} are lost")


def _check_skin_exactly(
    vertices: npt.NDArray[np.float64],
    triangles: npt.NDArray[np.int32],
    points: npt.NDArray[np.float64],
    free: list[tuple[int, int, int]],
) -> bool:
    """Flags cancel between skin and surface; False when some skin point is no input vertex."""
    own = {tuple(row) for row in vertices.tolist()}
    if any(tuple(points[v].tolist()) not in own for face in free for v in face):
        return False
    flags = FlagSum()
    exact: dict[tuple[float, ...], tuple[int, int, int, int]] = {}

    def place(row: list[float]) -> tuple[int, int, int, int]:
        key = tuple(row)
        if key not in exact:
            exact[key] = from_fractions(map(Fraction, row))
        return exact[key]

    for array, faces, weight in ((points, free, 1), (vertices, triangles.tolist(), -1)):
        for face in faces:
            cycle = [place(array[v].tolist()) for v in face]
            plane = plane_through(*cycle)
            require(any(plane[:3]), "a skin triangle is flat")
            flags.add(plane, cycle, weight)
    require(not flags.counts, "the skin is not the solid's surface")
    return True


def _check_skin_closely(
    vertices: npt.NDArray[np.float64],
    triangles: npt.NDArray[np.int32],
    points: npt.NDArray[np.float64],
    free: npt.NDArray[np.int64],
    tolerance: float,
) -> None:
    """The total areas agree."""
    ours, theirs = _areas(points, free), _areas(vertices, triangles)
    total = float(np.linalg.norm(theirs, axis=1).sum())
    difference = abs(float(np.linalg.norm(ours, axis=1).sum()) - total) / total
    require(difference <= 100 * tolerance, f"skin area differs by {difference:.3g}")


def _areas(
    points: npt.NDArray[np.float64], faces: npt.NDArray[np.integer]
) -> npt.NDArray[np.float64]:
    corners = points[faces]
    return np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]) / 2


def _check_skin_sources(
    vertices: npt.NDArray[np.float64],
    triangles: npt.NDArray[np.int32],
    points: npt.NDArray[np.float64],
    skin: npt.NDArray[np.int32],
    source: npt.NDArray[np.int32],
    moved: int,
) -> None:
    """Each skin triangle lies on the plane of its source and faces the same way."""
    require(len(source) == len(skin), "skin_source has another length than skin")
    require(((source >= 0) & (source < len(triangles))).all(), "skin_source is out of range")
    normals = _areas(vertices, triangles)
    normals /= np.linalg.norm(normals, axis=1)[:, None]
    base = vertices[triangles[source, 0]]
    size = float(np.abs(vertices - vertices.mean(axis=0)).max())
    height = np.einsum("sij,sj->si", points[skin] - base[:, None], normals[source])
    # Thin triangles of one plane differ by more than the rounding of their corners.
    reach = 2**-18 if moved else 2**-38
    require(float(np.abs(height).max()) <= reach * size, "a skin triangle is off its source")
    same_way = np.einsum("ij,ij->i", _areas(points, skin), normals[source])
    # Corners on one straight line of the caller's: their area is rounding and faces nowhere.
    nothing = 2**-48 * size**2
    require(
        bool((same_way > -nothing).all()) or moved > 0, "a skin triangle faces against its source"
    )
