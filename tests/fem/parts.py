# SPDX-License-Identifier: LGPL-2.1-or-later
"""The B-reps of the benchmarks, made by OpenCascade."""

from __future__ import annotations

from typing import Any

from OCP.BOPAlgo import BOPAlgo_Builder
from OCP.BRepAlgoAPI import BRepAlgoAPI_Common, BRepAlgoAPI_Cut
from OCP.BRepPrimAPI import BRepPrimAPI_MakeBox, BRepPrimAPI_MakeCylinder
from OCP.gp import gp_Ax2, gp_Dir, gp_Pnt


def box(low: tuple[float, ...], high: tuple[float, ...]) -> Any:
    return BRepPrimAPI_MakeBox(gp_Pnt(*low), gp_Pnt(*high)).Shape()


def cylinder(radius: float, low: float, high: float) -> Any:
    axis = gp_Ax2(gp_Pnt(0, 0, low), gp_Dir(0, 0, 1))
    return BRepPrimAPI_MakeCylinder(axis, radius, high - low).Shape()


def cut(a: Any, b: Any) -> Any:
    return BRepAlgoAPI_Cut(a, b).Shape()


def common(a: Any, b: Any) -> Any:
    return BRepAlgoAPI_Common(a, b).Shape()


def glued(*shapes: Any) -> Any:
    """Return a compound of solids that share the faces in which they touch."""
    builder = BOPAlgo_Builder()
    for shape in shapes:
        builder.AddArgument(shape)
    builder.Perform()
    return builder.Shape()


def beam() -> Any:
    """80 x 10 x 10 mm along x."""
    return box((0, 0, 0), (80, 10, 10))


def quarter_tube() -> Any:
    """A quarter of a tube of radii 10 and 20 mm, 10 mm long."""
    return common(cut(cylinder(20, 0, 10), cylinder(10, -1, 11)), box((0, 0, 0), (30, 30, 10)))


def half_ring() -> Any:
    """Half of a ring of radii 10 and 20 mm, y >= 0, 5 mm long: a hook with flat ends at y = 0."""
    return common(cut(cylinder(20, 0, 5), cylinder(10, -1, 6)), box((-30, 0, 0), (30, 30, 5)))


def quarter_plate() -> Any:
    """A quarter of a plate 200 x 100 x 4 mm with a hole of 20 mm diameter."""
    return cut(box((0, 0, 0), (100, 50, 4)), cylinder(10, -1, 5))


def bonded_bar() -> Any:
    """Two bars of 40 x 10 x 10 mm end to end, one compound with a common face."""
    return glued(box((0, 0, 0), (40, 10, 10)), box((40, 0, 0), (80, 10, 10)))
