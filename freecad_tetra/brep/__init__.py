# SPDX-License-Identifier: LGPL-2.1-or-later
"""B-rep models become triangulated solids; OCP is imported on first use only.

FreeCAD brings an OpenCascade of its own, and two of them in one process crash: inside
FreeCAD this package refuses to load OCP, and takes FreeCAD's shapes instead.
"""

from __future__ import annotations

import sys
from dataclasses import dataclass, field, replace
from os import PathLike
from typing import Any

from freecad_tetra.errors import MissingDependency, TetraError
from freecad_tetra.labels import Labels
from freecad_tetra.model import Solid

SMALLEST = 1e-7  # mm, OpenCascade's precision
SMALLEST_ANGLE = 1e-12  # radians
SUFFIXES = (".step", ".stp", ".brep", ".brp", ".iges", ".igs", ".fcstd")


@dataclass(frozen=True)
class Deflection:
    """How far the triangles may stray from the B-rep.

    Attributes
    ----------
    linear : float or None
        Chord height in mm; None means `relative`.
    relative : float
        Chord height as a share of the bounding box's diagonal.
    angular : float
        Angle between neighbouring chords, radians.
    """

    linear: float | None = None
    relative: float = 0.001
    angular: float = 0.3490658503988659  # 20 degrees

    def chord(self, diagonal: float) -> float:
        """Return the chord height for a shape of that size, never below OpenCascade's least.

        Its mesher throws for less, which inside FreeCAD ends FreeCAD.
        """
        return max(self.linear or self.relative * diagonal, 2 * SMALLEST)

    def angle(self) -> float:
        """Return the angle in radians, never below OpenCascade's least."""
        return max(self.angular, 2 * SMALLEST_ANGLE)

    def finer(self, linear: float, angular: float) -> Deflection:
        """Return the deflection with its lengths and its angle scaled."""
        chord = None if self.linear is None else self.linear * linear
        return Deflection(chord, self.relative * linear, self.angular * angular)


@dataclass(frozen=True)
class Shape:
    """A shape, as `as_shape` returns it, with a name, and the names of its solids and faces."""

    shape: Any
    name: str = ""
    labels: Labels = field(default_factory=Labels)

    def tessellate(self, deflection: Deflection, only: int | None, name: str = "") -> Solid:
        """Tessellate it; see `freecad_tetra.brep.tessellate`."""
        solid = tessellate(self.shape, deflection, name=name or self.name, only=only)
        return replace(solid, labels=self.labels)


def _require_ocp() -> None:
    if "FreeCAD" in sys.modules:
        raise TetraError(
            "OCP cannot be loaded inside FreeCAD (two OpenCascades in one process)",
            "pass a Part.Shape, or use the command line",
        )
    try:
        import OCP.TopoDS  # noqa: F401
    except ImportError as error:
        raise MissingDependency("OCP", "reading B-rep models", "cadquery-ocp") from error


def read_shape(path: str | PathLike[str]) -> Any:
    """Read a STEP, BREP, IGES or FCStd file into one TopoDS_Shape, lengths in mm.

    Raises
    ------
    UnreadableFile, UnsupportedFormat, MissingDependency
    """
    _require_ocp()
    from freecad_tetra.brep import read

    return read.read_shape(path)


def as_shape(value: Any) -> Any | None:
    """Return the shape inside a cadquery, build123d, OCP or FreeCAD object, or None.

    It is a TopoDS_Shape, or an object that tessellates itself by a method ``tessellated``.
    """
    if hasattr(value, "tessellated"):
        return value
    if hasattr(value, "exportBrepToString"):  # FreeCAD's Part.Shape
        from freecad_tetra.brep.part import PartShape

        return PartShape(value)
    if hasattr(value, "toCompound"):  # cadquery Assembly
        value = value.toCompound()
    if hasattr(value, "vals") and callable(value.vals):  # cadquery Workplane
        shapes = [as_shape(v) for v in value.vals()]
        shapes = [s for s in shapes if s is not None]
        if not shapes:
            return None
        _require_ocp()
        from freecad_tetra.brep import read

        return read.compound(shapes)
    while hasattr(value, "wrapped"):
        value = value.wrapped
    if value is not None and hasattr(value, "TShape") and hasattr(value, "ShapeType"):
        return value
    if hasattr(value, "part") and value is not None:  # build123d BuildPart
        return as_shape(value.part)
    return None


def as_named(value: Any) -> Shape | None:
    """Return the shape of a CAD object with its names, or None when it is none.

    Takes OCP shapes; cadquery Workplanes (tags name faces and solids), Shapes and Assemblies
    (placed; parts and subshapes keep their names); build123d objects and builders (labels);
    sequences of shapes; and FreeCAD's Part.Shape.
    """
    if hasattr(value, "tessellated") or hasattr(value, "exportBrepToString"):
        return Shape(as_shape(value))
    values = value if isinstance(value, list | tuple) and len(value) else [value]
    marks = ("wrapped", "vals", "toCompound", "part", "TShape")
    if not all(any(hasattr(one, mark) for mark in marks) for one in values):
        return None
    _require_ocp()
    from freecad_tetra.brep import named

    found = named.named_shape(value)
    return None if found is None else Shape(found.shape, "", found.labels())


def tessellate(
    shape: Any,
    deflection: Deflection | None = None,
    *,
    name: str = "",
    only: int | None = None,
) -> Solid:
    """Tessellate all solids of a shape once, welded through shared edges.

    Parameters
    ----------
    shape : TopoDS_Shape, or anything that `as_shape` returns
    deflection : Deflection
    name : str
    only : int, optional
        1-based number of the one solid wanted.

    Returns
    -------
    Solid
        One face id per triangle (``Face1`` is id 0), one solid id per triangle.

    Raises
    ------
    InvalidSolid
        ``no_solid`` when the shape holds none, ``no_mesh`` when a face has no triangles.
    """
    if hasattr(shape, "tessellated"):
        found: Solid = shape.tessellated(deflection or Deflection(), name, only)
        return found
    _require_ocp()
    from freecad_tetra.brep import mesh

    return mesh.tessellate(shape, deflection or Deflection(), name, only)


def projector(shape: Any) -> Any:
    """Return a callable that finds nearest points on the faces and edges of a shape.

    It is a `freecad_tetra.fem.project.Project`; faces are numbered as by `tessellate`.

    Parameters
    ----------
    shape : TopoDS_Shape, or a Part.Shape inside FreeCAD, as `as_shape` returns them
    """
    if hasattr(shape, "tessellated"):
        from freecad_tetra.brep import part_project

        return part_project.Projector(shape.shape)
    _require_ocp()
    from freecad_tetra.brep import project

    return project.Projector(shape)
