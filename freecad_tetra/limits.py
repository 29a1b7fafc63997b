# SPDX-License-Identifier: LGPL-2.1-or-later
"""Convex cells within the limits of physics engines, at an error that is stated."""

from __future__ import annotations

import contextlib
from dataclasses import replace
from typing import Any

import numpy as np

from freecad_tetra import kernel, mass
from freecad_tetra.errors import BadOption, InvalidSolid, VerificationFailed
from freecad_tetra.export import pieces
from freecad_tetra.kernel import Progress, Validation
from freecad_tetra.model import ConvexCells

# Of partitions with more pieces only the one with the fewest is merged, as that takes seconds.
MOST_TRIED = 1000


def limit(
    cells: ConvexCells,
    max_cells: int | None = None,
    max_vertices: int | None = None,
    progress: Progress | None = None,
) -> ConvexCells:
    """Merge cells into at most `max_cells` hulls of at most `max_vertices` vertices.

    Every hull contains its cells, so that the hulls cover the part, to rounding; hulls may
    overlap. What need not change stays as it is. ``report.details["limits"]`` tells the price:

    ``hull_error``
        No point of any hull is farther from the part than this; 0 when nothing changed.
    ``hull_error_found``
        Some point is as far as this.
    ``volume_added``
        Sum of the hulls' volumes above the part's; where hulls overlap it counts twice.
    ``merged_cells``, ``simplified_cells``
        How many of the hulls stand for several cells, and have lost vertices.

    Parameters
    ----------
    cells : ConvexCells
    max_cells : int, optional
        At least the number of solids, as solids are never joined.
    max_vertices : int, optional
        At least 8.
    progress : callable, optional

    Raises
    ------
    BadOption, Cancelled, KernelMissing
    """
    solids = len(np.unique(cells.cell_solid))
    if max_cells is not None and max_cells < solids:
        raise BadOption(
            f"max_cells {max_cells} is below the number of solids, {solids}",
            f"allow {solids} or decompose fewer solids",
        )
    if max_vertices is not None and max_vertices < 8:
        raise BadOption(f"max_vertices {max_vertices} is below 8", "allow 8, as a box has")
    found = kernel.limit_cells(cells, max_cells or 0, max_vertices or 0, progress)
    told: dict[str, Any] = {
        "max_cells": max_cells,
        "max_vertices": max_vertices,
        "cells_before": len(cells),
        "merged_cells": int(found["merged"]),
        "simplified_cells": int(found["simplified"]),
        "hull_error": float(found["error"]),
        "hull_error_found": float(found["error_found"]),
        "volume_added": float(found["volume_added"]),
    }
    made = _gathered(cells, found)
    details = {**cells.report.details, **mass.as_detail(mass.of_cells(cells)), "limits": told}
    counts = {**cells.report.counts, "pieces": len(made), "points": len(made.points)}
    return replace(made, report=replace(cells.report, details=details, counts=counts))


def least_error(
    solid: Validation,
    cells: ConvexCells,
    max_cells: int | None,
    max_vertices: int | None,
    progress: Progress | None = None,
) -> ConvexCells:
    """Limit cells and, when some must be merged, other partitions of the solid too.

    Merging can only join what a partition has cut apart, and no way of cutting suits all parts:
    of the cells as given, those of the other method and, for small solids, tetrahedra, the one is
    returned whose hulls stray least; of large partitions only the smallest is tried.
    ``report.details["limits"]["tried"]`` has the error of each.

    Parameters
    ----------
    solid : Validation
        What the cells partition.
    cells, max_cells, max_vertices, progress
        As of `limit`.
    """
    found = {cells.report.method: cells}
    if max_cells is not None and len(cells) > max_cells:
        found |= _others(solid, cells, progress)
    fewest = min(map(len, found.values()))
    limited = {
        name: limit(other, max_cells, max_vertices, progress)
        for name, other in found.items()
        if len(other) <= MOST_TRIED or len(other) == fewest
    }
    tried = {name: _error(other) for name, other in limited.items()}
    best = min(limited.values(), key=_error)
    told = {**best.report.details["limits"], "tried": tried}
    details = {**best.report.details, "limits": told}
    return replace(best, report=replace(best.report, details=details))


def _error(cells: ConvexCells) -> float:
    return float(cells.report.details["limits"]["hull_error"])


def _others(
    solid: Validation, cells: ConvexCells, progress: Progress | None
) -> dict[str, ConvexCells]:
    """Return the other partitions that can be had."""
    found: dict[str, ConvexCells] = {}
    for method in ("bajaj-dey", "fences"):
        with contextlib.suppress(VerificationFailed, InvalidSolid):
            if method != cells.report.method:
                found[method] = kernel.convex_cells(solid, {"method": method}, progress)
    with contextlib.suppress(VerificationFailed):
        if len(cells) <= MOST_TRIED / 3:
            found["tetrahedra"] = pieces.as_cells(kernel.tetrahedralize(solid, {}, progress))
    return found


def _gathered(cells: ConvexCells, found: dict[str, Any]) -> ConvexCells:
    """Return unchanged cells with their own facets and changed ones with their triangles."""
    loops: list[Any] = []
    ends, owners, source, face = [0], [], [], []
    for i in range(len(found["cell_offsets"]) - 1):
        member = int(found["cells"][found["cell_offsets"][i]])
        first, last = (int(found["triangle_offsets"][i + k]) for k in (0, 1))
        if first == last:
            own = cells.cell_facets(member)
            loops += [cells.facet(f) for f in own]
            source += cells.facet_source[list(own)].tolist()
            face += cells.facet_face[list(own)].tolist()
        else:
            loops += list(found["triangles"][first:last])
            source += [-1] * (last - first)
            face += [-1] * (last - first)
        ends.append(len(loops))
        owners.append(int(cells.cell_solid[member]))
    used, corners = np.unique(np.concatenate(loops), return_inverse=True)
    known = np.append(cells.point_source, np.full(len(found["points"]) - len(cells.points), -1))
    return replace(
        cells,
        points=found["points"][used],
        facet_offsets=np.append(0, np.cumsum([len(loop) for loop in loops])),
        facet_vertices=corners.reshape(-1).astype(np.int32),
        cell_offsets=np.array(ends, np.int64),
        facet_source=np.array(source, np.int32),
        facet_face=np.array(face, np.int32),
        cell_solid=np.array(owners, np.int32),
        point_source=known[used].astype(np.int32),
    )
