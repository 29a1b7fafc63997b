# SPDX-License-Identifier: LGPL-2.1-or-later
"""What the user has selected, and in one sentence why it will not do.

FreeCAD asks after every click, so nothing here tessellates or loads numpy.
"""

from __future__ import annotations

from typing import Any

import FreeCAD
import FreeCADGui
import Part

translate = FreeCAD.Qt.translate

TETRAHEDRA = "Tetrahedra"
CONVEX_CELLS = "ConvexCells"


def solid() -> tuple[Any, str]:
    """Return (object, "") of the one selected object that holds solids, or (None, why not)."""
    chosen, reason = one_object()
    if reason:
        return None, reason
    chosen = body_of(chosen)
    reason = why_no_solid(chosen)
    return (None, reason) if reason else (chosen, "")


def result(kinds: tuple[str, ...] = (TETRAHEDRA, CONVEX_CELLS)) -> tuple[Any, str]:
    """Return (object, "") of the one selected result of this workbench, or (None, why not)."""
    chosen = FreeCADGui.Selection.getSelection()
    if len(chosen) != 1 or kind_of(chosen[0]) not in kinds:
        return None, translate("Tetra", "Select an object made by Tetrahedralize or Convex cells")
    return chosen[0], ""


def one_object() -> tuple[Any, str]:
    """Return (object, "") when exactly one is selected, or (None, why not)."""
    chosen = FreeCADGui.Selection.getSelection()
    if not chosen:
        return None, translate("Tetra", "Select a solid, a body, a link or a compound of solids")
    if len(chosen) > 1:
        return None, translate("Tetra", "Select one object only")
    return chosen[0], ""


def body_of(obj: Any) -> Any:
    """Return the PartDesign body that an object is a feature of, or the object itself."""
    group = obj.getParentGeoFeatureGroup()
    inside = group is not None and group.isDerivedFrom("PartDesign::Body")
    return group if inside else obj


def kind_of(obj: Any) -> str:
    """Return TETRAHEDRA or CONVEX_CELLS for an object of this workbench, or ""."""
    proxy = getattr(obj, "Proxy", None)
    known = type(proxy).__module__ == "freecad_tetra.workbench.feature"
    name = type(proxy).__name__
    return name if known and name in (TETRAHEDRA, CONVEX_CELLS) else ""


def why_no_solid(obj: Any) -> str:
    """Return "" when an object's shape holds a solid, or what it is instead."""
    if obj.isDerivedFrom("Mesh::Feature"):
        return translate(
            "Tetra", "A mesh is selected: make a solid of it with Part > Create shape from mesh"
        )
    shape = Part.getShape(obj)
    if shape is None or shape.isNull():
        return translate("Tetra", "The selected object has no shape")
    if shape.Solids:
        return ""
    if shape.Faces:
        return translate("Tetra", "The selected shape is a shell: make a solid of it first")
    return translate("Tetra", "The selected shape has no volume: select a solid")
