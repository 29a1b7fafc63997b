# SPDX-License-Identifier: LGPL-2.1-or-later
"""Mass properties of what closed triangles enclose, by closed formulas and not by sampling."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from freecad_tetra.model import ConvexCells, FloatArray

_DETAIL = "mass_properties"


@dataclass(frozen=True, eq=False)
class MassProperties:
    """Integrals over a body of density 1.

    Attributes
    ----------
    volume : float
        Model unit cubed.
    centre : (3,) float64
        Centre of mass.
    inertia : (3, 3) float64
        About the centre, parallel to the axes; model unit to the fifth.
    """

    volume: float
    centre: FloatArray
    inertia: FloatArray

    def scaled(self, length: float, density: float) -> MassProperties:
        """Return mass, centre and inertia with all lengths times `length`, at a density."""
        return MassProperties(
            self.volume * length**3 * density,
            self.centre * length,
            self.inertia * length**5 * density,
        )


def of_surface(points: FloatArray, triangles: Any) -> MassProperties:
    """Return the mass properties inside triangles that face outward, O(t).

    Sums over the tetrahedra between each triangle and a point amid all.
    """
    origin = points[np.unique(triangles)].mean(axis=0)
    corners = points[triangles] - origin
    a, b, c = corners[:, 0], corners[:, 1], corners[:, 2]
    six = np.einsum("ij,ij->i", a, np.cross(b, c))
    volume = float(six.sum() / 6)
    whole = corners.sum(axis=1)
    first = (six[:, None] * whole).sum(axis=0) / 24
    rows = np.concatenate([corners, whole[:, None, :]], axis=1)
    second = np.einsum("t,tki,tkj->ij", six, rows, rows) / 120
    centre = first / volume
    about = second - volume * np.outer(centre, centre)
    inertia = np.trace(about) * np.eye(3) - about
    return MassProperties(volume, centre + origin, inertia)


def of_cells(cells: ConvexCells) -> MassProperties:
    """Return the mass properties of the part, also when its cells have been merged since."""
    kept = cells.report.details.get(_DETAIL)
    if kept is not None:
        return MassProperties(kept["volume"], np.array(kept["centre"]), np.array(kept["inertia"]))
    triangles, _ = cells.fans()
    return of_surface(cells.points, triangles)


def as_detail(properties: MassProperties) -> dict[str, Any]:
    """Return the entry of a report's details that `of_cells` finds again."""
    values = {
        "volume": properties.volume,
        "centre": properties.centre.tolist(),
        "inertia": properties.inertia.tolist(),
    }
    return {_DETAIL: values}
