# SPDX-License-Identifier: LGPL-2.1-or-later
"""A result is judged against its surface, from the files alone.

Signs of tetrahedra are exact (rationals where doubles cannot tell); closedness and pairing are
combinatorial. Lengths are compared to `TOLERANCE` times the diagonal, because points made by
intersecting planes are rounded to doubles; a cell thinner than that may even lie inside out.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from fractions import Fraction
from typing import Any

import numpy as np
import numpy.typing as npt

from freecad_tetra.errors import Cancelled, VerificationFailed
from freecad_tetra.model import FloatArray, LongArray, Solid

TOLERANCE = 2.0**-22
VOLUME_TOLERANCE = 1e-7
SAMPLES = 2000
_SIDES = np.array([[1, 2, 3], [0, 3, 2], [0, 1, 3], [0, 2, 1]])

Told = Callable[[str, float], "bool | None"] | None


def check_cells(
    surface: Solid, points: FloatArray, cells: Any, progress: Told = None
) -> dict[str, Any]:
    """Verify that closed convex cells cover the inside of `surface` once.

    Parameters
    ----------
    surface : Solid
        Valid and oriented outward.
    points : (p, 3) float64
    cells : sequence of sequences of (k,) int
        Loops of each cell, counter-clockwise from outside.

    Returns
    -------
    dict
        Figures of the check.

    Raises
    ------
    VerificationFailed
        With the ids of the cells at fault.
    """
    tolerance = TOLERANCE * surface.diagonal()
    total, worst, thick, bad = 0.0, 0.0, [], []
    for k, loops in enumerate(cells):
        if k % 64 == 0:
            _poll(progress, k / len(cells))
        cell = _one_cell(points, loops, tolerance)
        total += cell.volume
        worst = max(worst, cell.outside)
        inverted = cell.volume < -tolerance * cell.reach**2
        if not _closed(loops) or inverted or cell.outside > tolerance:
            bad.append(k)
        if cell.volume > tolerance * cell.area and len(cell.planes) > 3:
            thick.append((cell.planes, points[np.unique(np.concatenate(loops))]))
    if bad:
        raise VerificationFailed(
            f"{len(bad)} cells are not closed and convex "
            f"(first: cell {bad[0]})", cells=bad
        )  # fmt: skip
    error = _volume_error(surface, total)
    doubled, missed, outside = _sampled(surface, thick, 4 * tolerance)
    if doubled or missed or outside:
        raise VerificationFailed(
            f"of {SAMPLES} points {doubled} lie in two cells, {missed} in none, "
            f"{outside} in a cell outside the solid"
        )
    return {"cells": len(cells), "volume": total, "volume_error": error, "concavity": worst}


def check_tets(
    surface: Solid, points: FloatArray, tets: LongArray, progress: Told = None
) -> dict[str, Any]:
    """Verify that tetrahedra are positive, face to face, and bounded by `surface`.

    Parameters
    ----------
    surface : Solid
        Valid and oriented outward.
    points : (p, 3) float64
    tets : (t, 4) int

    Raises
    ------
    VerificationFailed
        With the ids of the tetrahedra at fault.
    """
    _poll(progress, 0.0)
    signs = orientations(points[tets])
    if (signs <= 0).any():
        bad = np.flatnonzero(signs <= 0).tolist()
        raise VerificationFailed(f"{len(bad)} tetrahedra are inverted or flat", cells=bad)
    skin, bad = _skin(tets)
    if bad:
        raise VerificationFailed("tetrahedra do not meet face to face", cells=bad)
    if not _closed(skin):
        raise VerificationFailed("the boundary of the tetrahedra is not closed")
    _poll(progress, 0.5)
    corner = points[tets]
    total = float(np.linalg.det(corner[:, 1:] - corner[:, :1]).sum() / 6.0)
    error = _volume_error(surface, total)
    area, given = _area(points, skin), _area(surface.vertices, surface.triangles)
    if abs(area / given - 1) > 10 * VOLUME_TOLERANCE:
        raise VerificationFailed(f"the boundary has area {area:.12g}, the surface {given:.12g}")
    _require_corners(surface, points[np.unique(skin)])
    return {"tetrahedra": len(tets), "points": len(points), "volume": total,
            "volume_error": error, "boundary_triangles": len(skin)}  # fmt: skip


def orientations(corners: FloatArray) -> npt.NDArray[np.int64]:
    """Return exact signs of det(b - a, c - a, d - a), corners (n, 4, 3) -> (n,) int64."""
    a, b, c = (corners[:, i] - corners[:, 0] for i in (1, 2, 3))
    cross = np.cross(b, c)
    value = np.einsum("ij,ij->i", a, cross)
    turned = np.abs(b)[:, [1, 2, 0]] * np.abs(c)[:, [2, 0, 1]]
    turned = turned + np.abs(b)[:, [2, 0, 1]] * np.abs(c)[:, [1, 2, 0]]
    bound = 1e-14 * np.einsum("ij,ij->i", np.abs(a), turned)
    signs = np.sign(value).astype(np.int64)
    for i in np.flatnonzero(np.abs(value) <= bound):
        signs[i] = _exact_sign(corners[i])
    return signs


def _exact_sign(corner: FloatArray) -> int:
    p = [[Fraction(float(x)) for x in row] for row in corner]
    u, v, w = ([p[k][j] - p[0][j] for j in range(3)] for k in (1, 2, 3))
    value = (
        u[0] * (v[1] * w[2] - v[2] * w[1])
        - u[1] * (v[0] * w[2] - v[2] * w[0])
        + u[2] * (v[0] * w[1] - v[1] * w[0])
    )
    return (value > 0) - (value < 0)


def _poll(progress: Told, fraction: float) -> None:
    if progress is not None and progress("check", fraction) is False:
        raise Cancelled()


def _volume_error(surface: Solid, total: float) -> float:
    wanted = surface.volume()
    error = abs(total / wanted - 1) if wanted else float("inf")
    if not error <= VOLUME_TOLERANCE:
        raise VerificationFailed(f"the pieces have volume {total:.12g}, the solid {wanted:.12g}")
    return error


def _closed(loops: Any) -> bool:
    """Return whether every directed edge has its opposite as often as itself."""
    if not len(loops) or min(len(x) for x in loops) < 3:
        return False
    start = np.concatenate([np.asarray(x, np.int64) for x in loops])
    stop = np.concatenate([np.roll(np.asarray(x, np.int64), -1) for x in loops])
    size = int(max(start.max(), stop.max())) + 1
    return np.array_equal(np.sort(start * size + stop), np.sort(stop * size + start))


@dataclass(frozen=True)
class _Cell:
    """Figures of one cell: its radius `reach`, planes (f, 4) of its facets, and how far a vertex
    lies outside of one."""

    volume: float
    area: float
    reach: float
    planes: FloatArray
    outside: float


def _one_cell(points: FloatArray, loops: Any, tolerance: float) -> _Cell:
    """Measure one cell.

    The plane of a facet of width w is known at a distance d only to rounding times d / w: so
    much less does a vertex outside of it count, and nothing when w is below the tolerance.
    """
    own = points[np.unique(np.concatenate(loops))]
    centre = own.mean(axis=0)
    reach = float(np.linalg.norm(own - centre, axis=1).max())
    planes, trust, volume, area = [], [], 0.0, 0.0
    for loop in loops:
        p = points[loop] - centre
        normal = np.cross(p - p[0], np.roll(p, -1, axis=0) - p[0]).sum(axis=0)
        volume += float(p[0] @ normal) / 6.0
        size = float(np.linalg.norm(normal))
        area += size / 2.0
        length = float(np.linalg.norm(p - np.roll(p, 1, axis=0), axis=1).max())
        if size > 4.0 * tolerance * length:
            normal = normal / size
            planes.append([*normal, -float((p @ normal).mean())])
            trust.append(size / (size + length * reach))
    table = np.array(planes, np.float64).reshape(-1, 4)
    heights = ((own - centre) @ table[:, :3].T + table[:, 3]) * np.array(trust)
    outside = float(heights.max()) if planes else 0.0
    table[:, 3] -= table[:, :3] @ centre
    return _Cell(volume, area, reach, table, outside)


def _sampled(
    surface: Solid, cells: list[tuple[FloatArray, FloatArray]], near: float
) -> tuple[int, int, int]:
    """Count sample points in two cells, in none, and outside the solid; seeded.

    A cell is given by its planes (f, 4) and its corners (k, 3).
    """
    low, high = surface.vertices.min(axis=0), surface.vertices.max(axis=0)
    x = low + (high - low) * np.random.default_rng(1).random((SAMPLES, 3))
    winding, doubtful = _windings(x, surface)
    hits = np.zeros(SAMPLES, np.int64)
    for planes, corners in cells:
        above, below = x >= corners.min(axis=0) - near, x <= corners.max(axis=0) + near
        some = np.flatnonzero((above & below).all(axis=1))
        if len(some):
            height = (x[some] @ planes[:, :3].T + planes[:, 3]).max(axis=1)
            hits[some] += height < 0
            doubtful[some] |= np.abs(height) < near
    inside = winding > 0.5
    sure = ~doubtful
    return (
        int(((hits > 1) & sure).sum()),
        int(((hits == 0) & inside & sure).sum()),
        int(((hits > 0) & ~inside & sure).sum()),
    )


def _windings(x: FloatArray, surface: Solid) -> tuple[FloatArray, npt.NDArray[np.bool_]]:
    """Return winding numbers (n,) and which are too near the surface to tell, O(n m)."""
    corners = surface.vertices[surface.triangles]
    winding = np.zeros(len(x))
    step = max(1, 1_000_000 // max(1, len(corners)))
    for start in range(0, len(x), step):
        a, b, c = (corners[None, :, k] - x[start : start + step, None] for k in range(3))
        la, lb, lc = (np.linalg.norm(y, axis=2) for y in (a, b, c))
        top = np.einsum("ijk,ijk->ij", a, np.cross(b, c))
        bottom = la * lb * lc + np.einsum("ijk,ijk->ij", a, b) * lc
        bottom += np.einsum("ijk,ijk->ij", b, c) * la + np.einsum("ijk,ijk->ij", c, a) * lb
        winding[start : start + step] = np.arctan2(top, bottom).sum(axis=1) / (2 * np.pi)
    return winding, np.abs(winding - np.round(winding)) > 0.25


def _skin(tets: LongArray) -> tuple[LongArray, list[int]]:
    """Return the triangles on one tetrahedron, and tetrahedra whose triangles do not pair."""
    sides = tets[:, _SIDES].reshape(-1, 3)
    owner = np.repeat(np.arange(len(tets)), 4)
    order = np.lexsort(np.sort(sides, axis=1).T)
    key, sides, owner = np.sort(sides, axis=1)[order], sides[order], owner[order]
    new = np.ones(len(key), bool)
    new[1:] = (key[1:] != key[:-1]).any(axis=1)
    start = np.flatnonzero(new)
    count = np.diff(np.append(start, len(key)))
    pair = start[count == 2]
    same = _even(sides[pair]) == _even(sides[pair + 1])
    bad = np.concatenate([owner[start[count > 2]], owner[pair[same]]])
    return sides[start[count == 1]], sorted(set(bad.tolist()))


def _even(triangles: LongArray) -> npt.NDArray[np.bool_]:
    first = np.argmin(triangles, axis=1)
    rows = np.arange(len(triangles))
    left: npt.NDArray[np.bool_] = (
        triangles[rows, (first + 1) % 3] < triangles[rows, (first + 2) % 3]
    )
    return left


def _area(points: FloatArray, triangles: Any) -> float:
    p = points[triangles]
    return float(np.linalg.norm(np.cross(p[:, 1] - p[:, 0], p[:, 2] - p[:, 0]), axis=1).sum() / 2)


def _require_corners(surface: Solid, skin: FloatArray) -> None:
    """Every vertex of the surface must be a vertex of the skin, within a grid step."""
    from_skin = np.unique(np.round(skin / (TOLERANCE * surface.diagonal())), axis=0)
    used = surface.vertices[np.unique(surface.triangles)]
    wanted = np.round(used / (TOLERANCE * surface.diagonal()))
    shifts = np.stack(np.meshgrid(*[[-1, 0, 1]] * 3), axis=-1).reshape(-1, 3)
    known = set(map(tuple, from_skin.tolist()))
    lost = [w for w in wanted.tolist() if known.isdisjoint(tuple(r) for r in (shifts + w).tolist())]
    if lost:
        raise VerificationFailed(f"{len(lost)} vertices of the surface are lost")
