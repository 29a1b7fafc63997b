# SPDX-License-Identifier: LGPL-2.1-or-later
"""A document object becomes the shape, and the triangulated solid, that is decomposed."""

from __future__ import annotations

from typing import Any

from freecad_tetra.model import Solid


def shape_of(obj: Any) -> Any:
    """Return the Part.Shape of a document object in global coordinates.

    Links, bodies, compounds and objects in containers give what the 3D view shows.

    Raises
    ------
    InvalidSolid
        ``no_solid``: the object is gone, has no shape, or its shape holds no solid.
    """
    raise NotImplementedError


def solid_of(
    obj: Any,
    linear: float | None = None,
    angular: float | None = None,
    relative: float | None = None,
) -> Solid:
    """Tessellate a document object once, welded through shared edges, as `api.as_solid` does.

    Parameters
    ----------
    obj : document object
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
    raise NotImplementedError
