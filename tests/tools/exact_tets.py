# SPDX-License-Identifier: LGPL-2.1-or-later
"""Proves in exact integers that tetrahedra of doubles fill a solid face to face.

Orientation, pairing and the closed skin are exact for any coordinates. Whether the skin is the
solid's own surface is proven by signed flags (see exact_cells) when all skin points are the solid's
vertices, and measured by distance, area and normal where Steiner points had to be rounded.
"""

from __future__ import annotations

import itertools
import math
from fractions import Fraction

import numpy as np
import numpy.typing as npt
from exact_cells import FlagSum, from_fractions, plane_through
from integer_flags import fits, same_surface


class NotATetMesh(AssertionError):
    """What is wrong with the tetrahedra, in words."""


def require(holds: bool, message: str) -> None:
    if not holds:
        raise NotATetMesh(message)


def fractions(points: npt.NDArray[np.float64]) -> list[list[Fraction]]:
    return [[Fraction(c) for c in row] for row in points.tolist()]


def determinant(points: npt.NDArray[np.float64], tet: npt.NDArray[np.integer]) -> Fraction:
    """det(b - a, c - a, d - a), exact."""
    a, *others = fractions(points[tet])
    return triple_product(*([p[k] - a[k] for k in range(3)] for p in others))


def triple_product(u: list[Fraction], v: list[Fraction], w: list[Fraction]) -> Fraction:
    return (
        u[0] * (v[1] * w[2] - v[2] * w[1])
        - u[1] * (v[0] * w[2] - v[2] * w[0])
        + u[2] * (v[0] * w[1] - v[1] * w[0])
    )


def not_positive(points: npt.NDArray[np.float64], tets: npt.NDArray[np.integer]) -> list[int]:
    """Tetrahedra whose determinant is zero or less; exact where doubles can't tell."""
    a, b, c, d = (points[tets[:, k]] for k in range(4))
    u, v, w = (b - a).T, (c - a).T, (d - a).T
    products = [u[i] * v[j] * w[k] for i, j, k in itertools.permutations(range(3))]
    signs = [1, -1, -1, 1, 1, -1]  # of the permutations in that order
    value = sum(sign * product for sign, product in zip(signs, products))
    doubt = np.abs(value) <= 2.0**-48 * sum(np.abs(product) for product in products)
    bad = [t for t in np.flatnonzero(doubt).tolist() if determinant(points, tets[t]) <= 0]
    return sorted(bad + np.flatnonzero(~doubt & (value < 0)).tolist())


def volume6(points: npt.NDArray[np.float64], faces: npt.NDArray[np.integer]) -> float:
    """Six times the volume within closed oriented triangles, to rounding."""
    a, b, c = (points[faces[:, k]] - points[faces[0, 0]] for k in range(3))
    return math.fsum(np.einsum("ij,ij->i", a, np.cross(b, c)).tolist())


def volume_error(
    points: npt.NDArray[np.float64],
    faces: npt.NDArray[np.integer],
    vertices: npt.NDArray[np.float64],
    triangles: npt.NDArray[np.integer],
) -> float:
    """Relative difference of the volume within `faces` from that within `triangles`."""
    enclosed = volume6(vertices, triangles)
    error = abs(volume6(points, faces) - enclosed) / enclosed
    if error < 1e-13:
        return error
    # A needle across the axes has too little volume for sums of doubles.
    ours, theirs = fractions(points), fractions(vertices)
    exact = sum(triple_product(*(theirs[v] for v in t)) for t in triangles.tolist())
    found = sum(triple_product(*(ours[v] for v in t)) for t in faces.tolist())
    return float(abs(found - exact) / exact)


def unpaired_faces(tets: npt.NDArray[np.integer]) -> npt.NDArray[np.int64]:
    """Faces on one tetrahedron, outward; raises when a face is not on one or two, opposite."""
    tets = tets.astype(np.int64)
    faces = tets[:, [[1, 2, 3], [0, 3, 2], [0, 1, 3], [0, 2, 1]]].reshape(-1, 3)
    rows = np.sort(faces, axis=1)
    repeated = (rows[:, 1:] == rows[:, :-1]).any(axis=1)
    require(not repeated.any(), f"a tetrahedron repeats a vertex in {rows[repeated][:1]}")
    odd = (faces[:, 0] > faces[:, 1]) ^ (faces[:, 1] > faces[:, 2]) ^ (faces[:, 0] > faces[:, 2])
    order = np.lexsort(rows.T)
    rows, side = rows[order], np.where(odd[order], -1, 1)
    start = np.flatnonzero(np.r_[True, (rows[1:] != rows[:-1]).any(axis=1)])
    count = np.diff(np.r_[start, len(rows)])
    both = np.add.reduceat(side, start)
    wrong = (count > 2) | ((count == 2) & (both != 0))
    require(not wrong.any(), f"faces have other than two opposite sides: {rows[start[wrong]][:1]}")
    return faces[order[start[count == 1]]]


def split_contacts(
    tets: npt.NDArray[np.integer], skin: npt.NDArray[np.integer]
) -> npt.NDArray[np.integer]:
    """The skin without the faces in which solids touch: there it has both, back to back."""
    rows = np.sort(skin, axis=1)
    _, place, count = np.unique(rows, axis=0, return_inverse=True, return_counts=True)
    double = count[place.reshape(-1)] > 1
    inner = {
        tuple(sorted(face))
        for tet in tets.tolist()
        for face in itertools.combinations(tet, 3)
    }  # fmt: skip
    backs = {tuple(row) for row in turned_to_least(skin[double][:, [0, 2, 1]]).tolist()}
    for face in turned_to_least(skin[double]).tolist():
        require(tuple(face) in backs, f"the skin has {face} twice")
        require(tuple(sorted(face)) in inner, f"no tetrahedra at the contact {face}")
    return skin[~double]


def turned_to_least(faces: npt.NDArray[np.integer]) -> npt.NDArray[np.integer]:
    """Each face from its least id on, and all in ascending order."""
    turn = (faces.argmin(axis=1)[:, None] + np.arange(3)) % 3
    turned = np.take_along_axis(faces, turn, axis=1)
    return turned[np.lexsort(turned.T)]


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
        Counts, the relative error of volume and what the skin was held to.

    Raises
    ------
    NotATetMesh
    """
    vertices, triangles = np.asarray(vertices, dtype=float), np.asarray(triangles)
    points, tets = np.asarray(points, dtype=float), np.asarray(tets)
    bad = not_positive(points, tets)
    require(not bad, f"{len(bad)} tetrahedra are inverted or flat, the first is {bad[:1]}")
    free = unpaired_faces(tets)
    if skin is not None:
        alone = split_contacts(tets, np.asarray(skin))
        require(
            np.array_equal(turned_to_least(alone), turned_to_least(free)),
            "skin differs from the unpaired faces",
        )
        free = np.asarray(skin)
    error = volume_error(points, free, vertices, triangles)
    tolerance = 1e-6 if moved else 1e-11
    require(error <= tolerance, f"volume differs by {error:.3g}")
    if point_source is not None:
        _check_sources(vertices, triangles, points, np.asarray(point_source), moved)
    whole = bool((vertices == np.rint(vertices)).all())
    exact = whole and _check_skin_exactly(vertices, triangles, points, free)
    if not exact:
        _check_skin_closely(vertices, triangles, points, free, tolerance)
    if skin is not None and skin_source is not None:
        _check_skin_sources(
            vertices, triangles, points, np.asarray(skin), np.asarray(skin_source), moved
        )
    return {"tets": len(tets), "skin": len(free), "volume_error": error, "skin_exact": float(exact)}


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
    absent = np.setdiff1d(triangles, source[own])
    # Vertices that share a place with another are represented by one of them.
    places = {tuple(row) for row in points.tolist()} if len(absent) else set()
    lost = [v for v in absent.tolist() if tuple(vertices[v].tolist()) not in places]
    require(not lost, f"input vertices {lost[:5]} are lost")


def _check_skin_exactly(
    vertices: npt.NDArray[np.float64],
    triangles: npt.NDArray[np.int32],
    points: npt.NDArray[np.float64],
    free: npt.NDArray[np.int64],
) -> bool:
    """Flags cancel between skin and surface; False when some skin point is no input vertex."""
    own = {tuple(row) for row in vertices.tolist()}
    if any(tuple(row) not in own for row in points[np.unique(free)].tolist()):
        return False
    middle = np.rint(vertices.mean(axis=0))
    if fits(vertices - middle):
        ours, theirs = ((a - middle).astype(np.int64) for a in (points, vertices))
        same = same_surface(ours[free], theirs[triangles])
        require(same, "the skin is not the solid's surface")
        return True
    flags = FlagSum()
    exact: dict[tuple[float, ...], tuple[int, int, int, int]] = {}

    def place(row: list[float]) -> tuple[int, int, int, int]:
        key = tuple(row)
        if key not in exact:
            exact[key] = from_fractions(map(Fraction, row))
        return exact[key]

    for array, faces, weight in ((points, free, 1), (vertices, triangles, -1)):
        for face in faces.tolist():
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
