# SPDX-License-Identifier: LGPL-2.1-or-later
"""A document object becomes the shape, and the triangulated solid, that is decomposed."""

from __future__ import annotations

import hashlib
import re
from typing import Any

from freecad_tetra import api
from freecad_tetra.errors import Defect, InvalidSolid
from freecad_tetra.model import Solid

_FLAGS = re.compile(r"^[01]{7}$", re.MULTILINE)  # of shapes: checked, modified; meshing sets them
_FRACTION = re.compile(r"-?\d+(?:\.\d+(?:e[+-]?\d+)?|e[+-]?\d+)")


def shape_of(obj: Any) -> Any:
    """Return the Part.Shape of a document object in global coordinates.

    Links, bodies, compounds and objects in containers give what the 3D view shows. A shape is
    returned as it is.

    Raises
    ------
    InvalidSolid
        ``no_solid``: the object is gone, has no shape, or its shape holds no solid.
    """
    import Part

    if obj is None:
        raise _no_solid("there is no source object, it was deleted", "choose another source")
    if hasattr(obj, "exportBrepToString"):
        return obj
    shape = Part.getShape(obj)
    if shape is None or shape.isNull() or not shape.Solids:
        raise _no_solid(
            f"{obj.Label} holds no solid, only faces, shells, wires or nothing",
            "make a solid of it and try again",
        )
    placed = shape.copy(False)  # shares the geometry, has a placement of its own
    container = obj.getParentGeoFeatureGroup()
    while container is not None:
        placed.Placement = container.Placement.multiply(placed.Placement)
        container = container.getParentGeoFeatureGroup()
    return placed


def solid_of(
    obj: Any,
    linear: float | None = None,
    angular: float | None = None,
    relative: float | None = None,
) -> Solid:
    """Tessellate a document object once, welded through shared edges, as `api.as_solid` does.

    Parameters
    ----------
    obj : document object or Part.Shape
    linear : float, optional
        Chord height in mm.
    angular : float, optional
        Degrees between neighbouring chords.
    relative : float, optional
        Chord height as a share of the diagonal.

    Raises
    ------
    InvalidSolid
    """
    return api.as_solid(
        shape_of(obj),
        linear_deflection=linear,
        angular_deflection=angular,
        relative_deflection=relative,
        name=getattr(obj, "Label", ""),
    )


def fingerprint(shape: Any, options: str) -> str:
    """Return what changes whenever the geometry of a shape or `options` do, 64 letters.

    A document that is saved and opened again changes coordinates in their last digits: nine
    count, and nothing below a hundredth of OpenCascade's smallest length.
    """
    text = _FLAGS.sub("", shape.copy(True, False).exportBrepToString())
    rounded = _FRACTION.sub(_nine_digits, text)
    return hashlib.sha256(f"{options}\n{rounded}".encode()).hexdigest()


def _nine_digits(found: re.Match[str]) -> str:
    value = float(found[0])
    return "0" if abs(value) < 1e-9 else f"{value:.8e}"


def _no_solid(message: str, next_step: str) -> InvalidSolid:
    return InvalidSolid([Defect("no_solid", message)], message, next_step)
