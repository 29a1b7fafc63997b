# SPDX-License-Identifier: LGPL-2.1-or-later
"""The parametric objects: their properties, recomputation and stored pieces.

Documents store the path of this module and the names of its classes: both are a file format.
"""

from __future__ import annotations

from typing import Any

from freecad_tetra.model import ConvexCells, TetMesh
from freecad_tetra.workbench import runner


def make_tetrahedra(doc: Any, source: Any, **properties: Any) -> Any:
    """Add a Part::FeaturePython of tetrahedra to a document; recompute the document to fill it.

    Parameters
    ----------
    doc : App.Document
    source : document object
        Body, link, compound or any object with a shape that holds solids.
    **properties
        Method, LinearDeflection (mm, 0 = automatic), AngularDeflection (degrees, 0 = automatic),
        Direction, MaxPieces, Explode.

    Returns
    -------
    document object

    Raises
    ------
    BadOption
        There is no such property; nothing was added.
    """
    raise NotImplementedError


def make_convex_cells(doc: Any, source: Any, **properties: Any) -> Any:
    """Add a Part::FeaturePython of convex cells; as `make_tetrahedra`, with Flatness."""
    raise NotImplementedError


def make_fem_mesh(
    doc: Any, source: Any, analysis: Any = None, order: int = 2, **properties: Any
) -> Any:
    """Add a FEM mesh of a solid or of a tetrahedra object, into an analysis if one is given."""
    raise NotImplementedError


def pieces_of(obj: Any) -> ConvexCells | TetMesh | None:
    """Return the pieces stored in an object, also above MaxPieces; None before its first run."""
    raise NotImplementedError


def start(obj: Any) -> runner.Job:
    """Start the computation of an object in the background, for a task panel."""
    raise NotImplementedError


def accept(obj: Any, pieces: ConvexCells | TetMesh) -> None:
    """Store the result of `start`; the next recompute makes the shape and computes nothing.

    It holds for the source and the properties as they were at `start`, and when they have
    changed since, the next recompute computes anew.
    """
    raise NotImplementedError


def make_compound(obj: Any) -> None:
    """Give an object above MaxPieces its compound all the same, on request."""
    raise NotImplementedError
