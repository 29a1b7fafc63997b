# SPDX-License-Identifier: LGPL-2.1-or-later
"""The user's preferences, as the page resources/ui/preferences.ui stores them."""

from __future__ import annotations

from typing import Any

import FreeCAD

GROUP = "User parameter:BaseApp/Preferences/Mod/Tetra"
# In the order of the page's boxes, which store indices.
CELL_METHODS = ("auto", "bajaj-dey", "fences")
DIRECTIONS = ("auto", "x", "y", "z")


def group() -> Any:
    """Return FreeCAD's parameter group of this workbench."""
    return FreeCAD.ParamGet(GROUP)


def max_pieces() -> int:
    """Return up to how many pieces an object becomes solids, 10,000 by default."""
    return int(group().GetInt("MaxPieces", 10_000))


def choices() -> dict[str, Any]:
    """Return what the task panels start with, lengths in mm and angles in degrees."""
    stored = group()
    return {
        "Method": _chosen(CELL_METHODS, stored.GetInt("CellMethod", 0)),
        "Direction": _chosen(DIRECTIONS, stored.GetInt("Direction", 0)),
        "LinearDeflection": stored.GetFloat("LinearDeflection", 0.0),
        "AngularDeflection": stored.GetFloat("AngularDeflection", 0.0),
        "MaxPieces": max_pieces(),
    }


def hide_source() -> bool:
    """Whether the solid is hidden once its pieces are there."""
    return bool(group().GetBool("HideSource", True))


def show_edges() -> bool:
    """Whether the edges of the pieces are drawn."""
    return bool(group().GetBool("ShowEdges", True))


def element_order() -> int:
    """Return the order of the elements of a FEM mesh, 2 by default."""
    return 2 if group().GetBool("SecondOrder", True) else 1


def _chosen(known: tuple[str, ...], index: int) -> str:
    return known[index] if 0 <= index < len(known) else known[0]
