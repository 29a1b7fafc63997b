# SPDX-License-Identifier: LGPL-2.1-or-later
"""One random solid through the compiled kernel, judged by the exact verifiers."""

from __future__ import annotations

import itertools
import math
from fractions import Fraction
from typing import Any

import numpy as np
import numpy.typing as npt
from crossing_edges import edges_cross
from exact_cells import NotAPartition, Point, canonical, verify_partition
from exact_tets import verify_tets
from random_solids import Surface

from freecad_tetra.kernel import load


class Unfit(Exception):
    """The kernel calls the surface invalid: nothing to decompose. Tells the defects."""


class Repaired(AssertionError):
    """The result is right, but only a second attempt of the kernel gave it."""


def excused(surface: Surface, attempt: str) -> bool:
    """Whether the first attempt could not do better.

    Edges that cross in their middles are beyond types 1 to 3: some directions see them, others
    don't. Steiner points that compaction did not take away may be too close for doubles.
    """
    raw = ", not compacted" in attempt and "the finished mesh is wrong" in attempt
    return raw or edges_cross(surface)


def validated(surface: Surface) -> dict[str, Any]:
    """The kernel's validation; raises Unfit with the kinds of defects."""
    vertices, triangles = surface
    found = load().validate(np.ascontiguousarray(vertices, float), triangles, {})
    if found["defects"]:
        raise Unfit(", ".join(sorted({d["kind"] for d in found["defects"]})))
    return found


def lists_of_cells(found: dict[str, Any]) -> list[list[list[int]]]:
    """Offsets to nested lists: cells of facets of point ids."""
    vertices = found["facet_vertices"].tolist()
    offsets = found["facet_offsets"].tolist()
    facets = [vertices[a:b] for a, b in itertools.pairwise(offsets)]
    stops = found["cell_offsets"].tolist()
    return [facets[a:b] for a, b in itertools.pairwise(stops)]


def decompose(surface: Surface, checked: dict[str, Any], options: dict[str, Any]) -> dict[str, Any]:
    """convex_cells of a validated surface."""
    vertices = np.ascontiguousarray(surface[0], float)
    module = load()
    try:
        return module.convex_cells(vertices, checked["triangles"], checked["solid"], options)
    except module.InvalidSolid as error:
        raise Unfit(str(error)) from error


def exact_points(found: dict[str, Any]) -> list[Point]:
    """Homogeneous points in the caller's coordinates; the doubles have to be near them."""
    step = Fraction(found["report"]["grid_step"])
    origin = [Fraction(c) for c in found["grid_origin"]]
    unit = math.lcm(step.denominator, *(c.denominator for c in origin))
    scale, shift = int(step * unit), [int(c * unit) for c in origin]
    points = []
    for row in found["exact_points"]:
        x, y, z, w = (int(text, 16) for text in row)
        homogeneous = [c * scale + s * w for c, s in zip((x, y, z), shift)]
        points.append(canonical([*homogeneous, w * unit]))
    rounded = np.array([[c / p[3] for c in p[:3]] for p in points])
    size = float(np.abs(rounded).max())
    if np.abs(rounded - found["points"]).max() > 1e-9 * size:
        raise NotAPartition("points differ from the exact ones by more than rounding")
    return points


def check_cells(surface: Surface, options: dict[str, Any]) -> dict[str, float]:
    """Decompose into convex cells and prove the partition; returns counts.

    Raises
    ------
    Unfit
        For an invalid surface.
    NotAPartition, Exception
        Whatever fails.
    """
    checked = validated(surface)
    found = decompose(surface, checked, {"flatness": 0, "exact_points": True, **options})
    verify_partition(surface[0], checked["triangles"], exact_points(found), lists_of_cells(found))
    counts = found["report"]["counts"]
    numbers = {k: counts[k] for k in ("notches", "cuts", "splices", "raw_cells", "pieces")}
    return {**numbers, "triangles": len(surface[1])}


def check_tets(surface: Surface, options: dict[str, Any]) -> dict[str, float]:
    """Tetrahedralize and verify; returns counts.

    Raises
    ------
    Unfit
        For an invalid surface.
    NotATetMesh, Exception
        Whatever fails.
    """
    return _check_tets(surface, options)[0]


def check_tets_at_once(surface: Surface, options: dict[str, Any]) -> dict[str, float]:
    """Like `check_tets`, but raises Repaired when an attempt failed that should not have."""
    counts, attempts = _check_tets(surface, options)
    counts["repaired"] = len(attempts)
    if not all(excused(surface, attempt) for attempt in attempts):
        raise Repaired("; ".join(attempts))
    return counts


def _check_tets(surface: Surface, options: dict[str, Any]) -> tuple[dict[str, float], list[str]]:
    checked = validated(surface)
    vertices = np.ascontiguousarray(surface[0], float)
    triangles: npt.NDArray[np.int32] = checked["triangles"]
    module = load()
    try:
        found = module.tetrahedralize(vertices, triangles, checked["solid"], options)
    except module.InvalidSolid as error:
        raise Unfit(str(error)) from error
    result = verify_tets(
        vertices,
        triangles,
        found["points"],
        found["tets"],
        found["skin"],
        found["skin_source"],
        found["point_source"],
        found["report"]["repairs"]["vertices_on_grid"],
    )
    report = found["report"]
    attempts = [text for solid in report["solids"] for text in solid["failed_attempts"]]
    own = set(found["point_source"][found["point_source"] >= 0].tolist())
    used = np.unique(triangles)
    result["lost"] = sum(int(v) not in own for v in used)
    result["steiner"] = int((found["point_source"] < 0).sum())
    result["triangles"] = len(triangles)
    result["on_grid"] = report["repairs"]["vertices_on_grid"]
    return result, attempts
