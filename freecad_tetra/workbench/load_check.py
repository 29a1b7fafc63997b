# SPDX-License-Identifier: LGPL-2.1-or-later
"""Do the loads of an analysis arrive? Areas are compared before, forces after the deck is written.

FreeCAD takes for a face what lies within its tolerance. Where nodes are off the face a load is
lost without a word, and where triangles of other faces have all nodes on it, it is too large.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import FreeCAD
import numpy as np

from freecad_tetra.errors import TetraError
from freecad_tetra.fem import triangles
from freecad_tetra.workbench import compat, constraints, deck
from freecad_tetra.workbench import fem_mesh as meshes

LIMIT = 0.01


class LoadsLost(TetraError):
    """A load or support does not arrive on the mesh as it was given.

    Attributes
    ----------
    rows : tuple of Row
    """

    def __init__(self, rows: Sequence[Row]) -> None:
        self.rows = tuple(rows)
        super().__init__(
            "; ".join(str(row) for row in rows),
            "ask the mesh for Quality, a smaller ElementSize or a finer tessellation",
        )


@dataclass(frozen=True)
class Row:
    """One comparison.

    Attributes
    ----------
    constraint : str
        Name of the object.
    what : str
        ``area of Solid.Face3`` (mm2), ``force`` (N) or ``pressure area`` (mm2).
    wanted, found : float
    """

    constraint: str
    what: str
    wanted: float
    found: float

    @property
    def error(self) -> float:
        """Relative difference."""
        return abs(self.found - self.wanted) / abs(self.wanted) if self.wanted else 0.0

    @property
    def arrives(self) -> bool:
        """Within `LIMIT`."""
        return self.error <= LIMIT

    def __str__(self) -> str:
        state = "" if self.arrives else f", {100 * self.found / self.wanted:.1f} %"
        return f"{self.constraint}: {self.what} {self.found:.6g} of {self.wanted:.6g}{state}"


def areas(analysis: Any) -> list[Row]:
    """Compare for every face that a constraint refers to the area that FreeCAD selects with CAD's.

    Raises
    ------
    TetraError
        The analysis has no mesh.
    """
    made = mesh_of(analysis).FemMesh
    table = meshes.nodes_table(made)
    out = []
    for member in constraints.constraints_of(analysis):
        if constraints.is_material(member):
            continue
        for owner, names in member.References:
            for name in (names,) if isinstance(names, str) else names:
                if name.startswith("Face"):
                    face = owner.Shape.getElement(name)
                    found = _area(made, table, made.getFacesByFace(face))
                    out.append(Row(member.Name, f"area of {owner.Name}.{name}", face.Area, found))
    return out


def forces(analysis: Any, path: str | Path) -> list[Row]:
    """Compare the loads in a deck that FreeCAD has written with those that were asked for.

    Force constraints on faces by the sum of their nodal forces, pressures by the area of the
    element sides that carry them.
    """
    written = deck.read(path)
    out = []
    asked = [
        m for m in constraints.constraints_of(analysis) if m.isDerivedFrom("Fem::ConstraintForce")
    ]
    pressed = [
        m
        for m in constraints.constraints_of(analysis)
        if m.isDerivedFrom("Fem::ConstraintPressure")
    ]
    if asked:
        total = sum(compat.newtons(m.Force) * np.array(tuple(m.DirectionVector)) for m in asked)
        size = max(float(np.linalg.norm(total)), 1e-30)
        along = float(written.force @ total) / size
        names = ", ".join(m.Name for m in asked)
        out.append(Row(names, "force in the deck", size, along))
    if pressed:
        made = mesh_of(analysis).FemMesh
        table = meshes.nodes_table(made)
        wanted = sum(_face_area(m) for m in pressed)
        found = _area_of_sides(made, table, written.pressed)
        out.append(Row(", ".join(m.Name for m in pressed), "pressed area", wanted, found))
    return out


def check(analysis: Any, path: str | Path | None = None, strict: bool = False) -> list[Row]:
    """Compare areas, and the forces of a deck when there is one; warn in the report view.

    Parameters
    ----------
    analysis : Fem::FemAnalysis
    path : path, optional
        Deck that FreeCAD has written.
    strict : bool
        Raise instead of warning.

    Returns
    -------
    list of Row

    Raises
    ------
    LoadsLost
        When strict and a row is off by more than `LIMIT`.
    """
    rows = areas(analysis) + ([] if path is None else forces(analysis, path))
    lost = [row for row in rows if not row.arrives]
    if lost and strict:
        raise LoadsLost(lost)
    tell(lost)
    return rows


def tell(rows: Iterable[Row]) -> None:
    """Write rows that are off into the report view."""
    for row in rows:
        FreeCAD.Console.PrintWarning(f"Load does not arrive: {row}\n")


def mesh_of(analysis: Any) -> Any:
    """Return the mesh object of an analysis.

    Raises
    ------
    TetraError
    """
    found = [m for m in analysis.Group if m.isDerivedFrom("Fem::FemMeshObject")]
    if len(found) != 1:
        raise TetraError(
            f"{analysis.Label} has {len(found)} meshes", "an analysis needs exactly one mesh"
        )
    return found[0]


def _area(made: Any, table: Any, faces: Iterable[int]) -> float:
    rows = [made.getElementNodes(face) for face in faces]
    by_size: dict[int, list[Any]] = {}
    for row in rows:
        by_size.setdefault(len(row), []).append(row)
    return float(sum(triangles.areas(table, np.array(r)).sum() for r in by_size.values()))


def _area_of_sides(made: Any, table: Any, sides: Sequence[tuple[int, int]]) -> float:
    """Return the area of sides (element, 1 to 4 as CalculiX counts) of tetrahedra."""
    by_size: dict[int, list[Any]] = {}
    for element, side in sides:
        nodes = deck.side_nodes(made.getElementNodes(element), side)
        by_size.setdefault(len(nodes), []).append(nodes)
    return float(sum(triangles.areas(table, np.array(r)).sum() for r in by_size.values()))


def _face_area(member: Any) -> float:
    total = 0.0
    for owner, names in member.References:
        for name in (names,) if isinstance(names, str) else names:
            total += owner.Shape.getElement(name).Area
    return total
