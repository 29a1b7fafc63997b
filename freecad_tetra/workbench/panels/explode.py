# SPDX-License-Identifier: LGPL-2.1-or-later
"""The task panel of Explode: a slider that draws pieces apart while it is moved."""

from __future__ import annotations

from typing import Any

import FreeCAD
import FreeCADGui

from freecad_tetra.workbench import compat
from freecad_tetra.workbench.panels.forms import new_form

translate = FreeCAD.Qt.translate

MOST = 3.0
STEPS = 300


class Explode:
    """OK keeps the factor as one step that can be undone, Cancel brings the old one back."""

    def __init__(self, result: Any) -> None:
        self.result = result
        self.document = result.Document.Name
        result.Document.openTransaction(translate("Tetra", "Explode"))
        FreeCADGui.Selection.clearSelection()  # its colour would hide those of the pieces
        self.form = self._layout()

    def _layout(self) -> Any:
        core, _, widgets = compat.qt()
        form = new_form(translate("Tetra", "Explode"), "Tetra_Explode")
        self.slider = widgets.QSlider(core.Qt.Horizontal)
        self.slider.setRange(0, STEPS)
        self.slider.setObjectName("TetraFactor")
        self.box = widgets.QDoubleSpinBox()
        self.box.setRange(0.0, MOST)
        self.box.setSingleStep(0.1)
        factor = min(MOST, float(self.result.Explode))
        self.box.setValue(factor)
        self.slider.setValue(round(factor / MOST * STEPS))
        self.slider.valueChanged.connect(lambda step: self.box.setValue(step * MOST / STEPS))
        self.box.valueChanged.connect(self._draw)
        rows = widgets.QFormLayout(form)
        rows.addRow(translate("Tetra", "Factor"), self.box)
        rows.addRow(self.slider)
        return form

    def accept(self) -> bool:
        """FreeCAD calls this for OK."""
        self._end("commitTransaction")
        FreeCADGui.Control.closeDialog()
        return True

    def reject(self) -> bool:
        """FreeCAD calls this for Cancel and Esc."""
        self._end("abortTransaction")
        FreeCADGui.Control.closeDialog()
        return True

    def _end(self, how: str) -> None:
        """End the transaction, if the document is still open."""
        document = FreeCAD.listDocuments().get(self.document)
        if document is not None:
            getattr(document, how)()

    def _draw(self, factor: float) -> None:
        self.slider.blockSignals(True)
        self.slider.setValue(round(factor / MOST * STEPS))
        self.slider.blockSignals(False)
        if compat.alive(self.result):
            self.result.Explode = factor
