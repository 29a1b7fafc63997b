# SPDX-License-Identifier: LGPL-2.1-or-later
"""The task panel of To FEM mesh: of a solid, or at once of tetrahedra that are there."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import FreeCAD

from freecad_tetra.workbench import compat, feature, fem_feature, preferences, selection
from freecad_tetra.workbench.panels.choices import Choices
from freecad_tetra.workbench.panels.computation import Computation, recompute
from freecad_tetra.workbench.panels.facts_box import number
from freecad_tetra.workbench.runner import Job
from freecad_tetra.workbench.selection import TETRAHEDRA

translate = FreeCAD.Qt.translate


class ToFemMesh(Computation):
    """Makes a FEM mesh; into the active analysis when it is one of the same document."""

    def __init__(self, source: Any) -> None:
        self.of_solid = selection.kind_of(source) != TETRAHEDRA
        choices = FemChoices(self.of_solid)
        name = translate("Tetra", "To FEM mesh")
        super().__init__(name, "Tetra_ToFemMesh", TETRAHEDRA, source, choices)
        if self.of_solid:
            self.count_facts()
        else:
            self.facts.show(source)

    def begin(self) -> Job | None:
        """Start to tetrahedralize a solid; tetrahedra are there already."""
        if not self.of_solid:
            return None
        return feature.start(TETRAHEDRA, self.source, self.choices.values())

    def fill(self, document: Any, result: Any) -> str:
        """Make the mesh and return its figures."""
        chosen, order = self.choices.values(), self.choices.order()
        analysis = active_analysis(document)
        made = feature.make_fem_mesh(document, self.source, analysis, order, **chosen)
        if result is not None:
            fem_feature.accept(made, result)
        recompute(made)
        if preferences.hide_source():
            self.source.ViewObject.Visibility = False
        said = translate("Tetra", "{0} nodes, {1} tetrahedra, {2} triangles of the skin")
        mesh = made.FemMesh
        figures = (mesh.NodeCount, mesh.VolumeCount, mesh.TriangleCount)
        return said.format(*(number(figure) for figure in figures))


class FemChoices:
    """The order of the elements, and for a solid how it is decomposed.

    Attributes
    ----------
    widget : QWidget
    """

    def __init__(self, of_solid: bool) -> None:
        _, _, widgets = compat.qt()
        self._inner = Choices(TETRAHEDRA, {}, limited=False) if of_solid else None
        self.widget = widgets.QWidget()
        column = widgets.QVBoxLayout(self.widget)
        column.setContentsMargins(0, 0, 0, 0)
        self._second = widgets.QCheckBox(translate("Tetra", "Second order elements"))
        self._second.setObjectName("SecondOrder")
        self._second.setChecked(preferences.element_order() == 2)
        self._second.setToolTip(
            translate("Tetra", "Ten nodes for each tetrahedron; four are far too stiff in bending")
        )
        column.addWidget(self._second)
        if self._inner is not None:
            column.addWidget(self._inner.widget)

    def order(self) -> int:
        """Return 1 or 2."""
        return 2 if self._second.isChecked() else 1

    def values(self) -> dict[str, Any]:
        """Return the properties of the decomposition, {} for tetrahedra that are there."""
        return {} if self._inner is None else self._inner.values()

    def on_change(self, tell: Callable[[], None]) -> None:
        """Call `tell` whenever the user has changed how the solid is tessellated."""
        if self._inner is not None:
            self._inner.on_change(tell)

    def enable(self, on: bool) -> None:
        """Let the user change the choices, or not while the work goes on."""
        self.widget.setEnabled(on)


def active_analysis(document: Any) -> Any:
    """Return the FEM analysis that is active in a document, or None."""
    import FemGui

    analysis = FemGui.getActiveAnalysis()
    return analysis if analysis is not None and analysis.Document is document else None
