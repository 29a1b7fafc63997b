# SPDX-License-Identifier: LGPL-2.1-or-later
"""What is told about a solid before the work (facts, defects) and after it (report)."""

from __future__ import annotations

from typing import Any

from freecad_tetra.errors import Defect
from freecad_tetra.workbench import runner


def facts(shape: Any) -> dict[str, Any]:
    """Return figures of a solid for the task panel; waits for `start_facts`.

    Parameters
    ----------
    shape : Part.Shape or document object

    Returns
    -------
    dict
        faces, solids, triangles, vertices, notches, genus, volume, diagonal, valid,
        defects, bound (pieces at most), expected (pieces and seconds of each method).
    """
    raise NotImplementedError


def start_facts(shape: Any) -> runner.Job:
    """Start the same in the background; the job's result is the dict."""
    raise NotImplementedError


def check(obj: Any) -> list[Defect]:
    """Return the defects of an object's solid with FreeCAD's face names, [] for a valid one."""
    raise NotImplementedError


def report(obj: Any) -> dict[str, Any]:
    """Return counts, bounds, volumes and quality histogram of a computed object."""
    raise NotImplementedError
