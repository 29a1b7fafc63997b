# SPDX-License-Identifier: LGPL-2.1-or-later
"""What the window calls the kinds of defects."""

from __future__ import annotations

import FreeCAD

from freecad_tetra.errors import Defect

translate = FreeCAD.Qt.translate


def line(defect: Defect) -> str:
    """Return a defect as one line: what it is, where, and the kernel's words."""
    where = ", ".join(defect.faces[:12])
    if len(defect.faces) > 12:
        where += ", ..."
    return f"{title(defect.kind)}{' (' + where + ')' if where else ''}: {defect.message}"


def title(kind: str) -> str:
    """Return what a kind of defect is called in the window."""
    known = {
        "open_edge": translate("Tetra", "Open edge"),
        "inconsistent_orientation": translate("Tetra", "Face turned inside out"),
        "degenerate_triangle": translate("Tetra", "Triangle without area"),
        "duplicate_triangle": translate("Tetra", "Surface that lies twice"),
        "self_crossing": translate("Tetra", "Surface that crosses itself"),
        "nonfinite_coordinate": translate("Tetra", "Coordinate that is no number"),
        "flat_solid": translate("Tetra", "Solid without volume"),
        "empty": translate("Tetra", "Nothing there"),
        "bad_nesting": translate("Tetra", "Shells nested wrongly"),
        "non_planar_contact": translate("Tetra", "Contact that is not planar"),
        "bad_index": translate("Tetra", "Missing vertex"),
        "no_solid": translate("Tetra", "No solid"),
        "scale_out_of_range": translate("Tetra", "Size out of range"),
    }
    return known.get(kind, kind.replace("_", " ").capitalize())
