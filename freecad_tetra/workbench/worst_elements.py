# SPDX-License-Identifier: LGPL-2.1-or-later
"""The worst elements of a FEM mesh are shown in red in the 3D view."""

from __future__ import annotations

import json
from typing import Any

_RED, _PALE = (1.0, 0.1, 0.1), (0.85, 0.85, 0.85)


def numbers(obj: Any, count: int = 20) -> list[int]:
    """Return FreeCAD's numbers of the worst elements of a mesh object, worst first."""
    if not obj.ReportData:
        return []
    found = json.loads(obj.ReportData)["quality"].get("worst_elements", [])
    return [int(element) + 1 for element in found[:count]]


def show(obj: Any, count: int = 20) -> list[int]:
    """Colour the worst elements; return their numbers."""
    worst = numbers(obj, count)
    colours = dict.fromkeys(obj.FemMesh.Volumes, _PALE)
    colours.update(dict.fromkeys(worst, _RED))
    obj.ViewObject.ElementColor = colours
    return worst


def hide(obj: Any) -> None:
    """Give all elements the colour of the mesh again."""
    obj.ViewObject.ElementColor = {}
