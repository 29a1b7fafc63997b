# SPDX-License-Identifier: LGPL-2.1-or-later
"""What is told about a solid before the work (facts, defects) and after it (report)."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from freecad_tetra.errors import Defect, InvalidSolid
from freecad_tetra.kernel import Validation, piece_bound
from freecad_tetra.workbench import properties, runner, source, store


def facts(shape: Any) -> dict[str, Any]:
    """Return figures of a solid for the task panel; waits for `start_facts`.

    Parameters
    ----------
    shape : Part.Shape or document object

    Returns
    -------
    dict
        faces, solids, triangles, vertices, notches, genus, bound (pieces at most) : int;
        volume (mm^3), diagonal (mm) : float; valid : bool; defects : tuple of Defect;
        expected : dict with ``Tetrahedra`` and ``ConvexCells``, each a dict of pieces and
        seconds. Nothing is counted in what bounds no solid.

    Raises
    ------
    InvalidSolid
        There is no solid to count.
    """
    found: dict[str, Any] = start_facts(shape).wait()
    return found


def start_facts(shape: Any, given: Mapping[str, Any] | None = None) -> runner.Job:
    """Start the same in the background; the job's result is the dict.

    Parameters
    ----------
    shape : Part.Shape or document object
    given : mapping, optional
        LinearDeflection (mm) and AngularDeflection (degrees), as those of an object.
    """
    job = runner.start("validate", source.shape_of(shape), properties.reading_of(given or {}))
    job.finish = _figures
    return job


def check(obj: Any) -> list[Defect]:
    """Return the defects of an object's solid with FreeCAD's face names, [] for a valid one."""
    try:
        return list(facts(obj)["defects"])
    except InvalidSolid as error:
        return list(error.defects)


def report(obj: Any) -> dict[str, Any]:
    """Return the report of a computed object as plain JSON types, see `freecad_tetra.Report`."""
    return store.report(obj).to_dict()


def expected(triangles: int, notches: int) -> dict[str, dict[str, float]]:
    """Return pieces and seconds to expect, from the medians of real parts.

    Times are those of one core of an ordinary machine, right within a factor of five or so.
    """
    start = 0.3
    return {
        "Tetrahedra": {"pieces": round(1.0 * triangles), "seconds": start + 1e-4 * triangles},
        "ConvexCells": {"pieces": round(0.75 * notches) + 1, "seconds": start + 4e-4 * notches},
    }


def _figures(found: Validation) -> dict[str, Any]:
    counts, solid = found.counts, found.solid
    notches = counts.get("notches", 0)
    return {
        "faces": len(solid.face_names),
        "solids": counts.get("solids", 0),
        "triangles": len(found.triangles) if not found.defects else len(solid.triangles),
        "vertices": len(solid.vertices),
        "notches": notches,
        "genus": counts.get("genus", 0),
        "bound": piece_bound(notches),
        "volume": abs(solid.volume()),
        "diagonal": solid.diagonal(),
        "valid": not found.defects,
        "defects": found.defects,
        "expected": expected(len(solid.triangles), notches),
    }
