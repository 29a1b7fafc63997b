# SPDX-License-Identifier: LGPL-2.1-or-later
"""The worst elements of a FEM mesh as red bodies of their own, seen through the faint mesh."""

from __future__ import annotations

import json
from typing import Any

import FreeCAD

_SIDES = ((0, 2, 1), (0, 1, 3), (1, 2, 3), (2, 0, 3))
_RED, _FAINT = (1.0, 0.1, 0.1), 85  # percent of transparency


def numbers(obj: Any, count: int = 20) -> list[int]:
    """Return FreeCAD's numbers of the worst elements of a mesh object, worst first."""
    if not obj.ReportData:
        return []
    found = json.loads(obj.ReportData)["quality"].get("worst_elements", [])
    return [int(element) + 1 for element in found[:count]]


def show(obj: Any, count: int = 20) -> Any:
    """Add a Mesh::Feature of the worst elements, with straight sides, to the document.

    In FreeCAD's window it is red and the mesh becomes transparent. Remove the object, or call
    `hide`, to go back.
    """
    import Mesh

    made, nodes = obj.FemMesh, obj.FemMesh.Nodes
    triangles = []
    for element in numbers(obj, count):
        corners = [nodes[node] for node in made.getElementNodes(element)[:4]]
        triangles += [[corners[i] for i in side] for side in _SIDES]
    shown = obj.Document.addObject("Mesh::Feature", "WorstElements")
    shown.Mesh = Mesh.Mesh(triangles)
    shown.Placement = obj.Placement
    if FreeCAD.GuiUp:
        shown.ViewObject.ShapeColor = _RED
        shown.ViewObject.Lighting = "Two side"
        obj.ViewObject.Transparency = _FAINT
    return shown


def hide(obj: Any, shown: Any) -> None:
    """Remove what `show` has added, and show the mesh as before."""
    obj.Document.removeObject(shown.Name)
    if FreeCAD.GuiUp:
        obj.ViewObject.Transparency = 0
