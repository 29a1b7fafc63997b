# SPDX-License-Identifier: LGPL-2.1-or-later
"""The task panel of Tetrahedralize and Convex cells."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import FreeCAD

from freecad_tetra.workbench import compat, feature, preferences
from freecad_tetra.workbench.panels.choices import Choices
from freecad_tetra.workbench.panels.computation import Computation, recompute
from freecad_tetra.workbench.panels.facts_box import number
from freecad_tetra.workbench.runner import Job
from freecad_tetra.workbench.selection import TETRAHEDRA

translate = FreeCAD.Qt.translate


class Decompose(Computation):
    """Makes a new object of a solid, or computes one anew that is there.

    Parameters
    ----------
    kind : {TETRAHEDRA, CONVEX_CELLS}
    source : document object
    result : document object, optional
        The object to compute anew; without it the first run that succeeds makes one.
    """

    def __init__(self, kind: str, source: Any, result: Any = None) -> None:
        self.kind = kind
        self.result = result
        name, icon = translate("Tetra", "Tetrahedralize"), "Tetra_Tetrahedralize"
        if kind != TETRAHEDRA:
            name, icon = translate("Tetra", "Convex cells"), "Tetra_ConvexCells"
        super().__init__(name, icon, kind, source, Choices(kind, _stored(result)))
        self.count_facts()

    def begin(self) -> Job | None:
        """Start the decomposition."""
        return feature.start(self.kind, self.source, self.choices.values())

    def fill(self, document: Any, result: Any) -> str:
        """Make or change the object, hide the solid, and return the figures."""
        chosen = self.choices.values()
        if not compat.alive(self.result):
            make = feature.make_tetrahedra
            if self.kind != TETRAHEDRA:
                make = feature.make_convex_cells
            self.result = make(document, self.source, **chosen)
        else:
            for name, value in chosen.items():
                setattr(self.result, name, value)
        feature.accept(self.result, result)
        recompute(self.result)
        if preferences.hide_source():
            self.source.ViewObject.Visibility = False
        said = translate("Tetra", "{0} pieces, volume error {1:.0e}, {2:.2f} s")
        return said.format(number(len(result)), self.result.VolumeError, self.result.Seconds)


def _stored(result: Any) -> Mapping[str, Any]:
    """Return the properties of an object that is there, {} for None."""
    if result is None:
        return {}
    return {name: getattr(result, name) for name in result.PropertiesList}
