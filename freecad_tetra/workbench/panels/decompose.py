# SPDX-License-Identifier: LGPL-2.1-or-later
"""The task panel of Tetrahedralize and Convex cells: facts, choices, Compute, progress, Cancel.

The work goes on in a child process; the document is touched once, when the result is there,
in one transaction. Cancelled or failed work leaves the document as it was.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import FreeCAD
import FreeCADGui

from freecad_tetra.errors import Cancelled, InvalidSolid, TetraError
from freecad_tetra.workbench import compat, feature, messages, preferences
from freecad_tetra.workbench.panels.choices import Choices
from freecad_tetra.workbench.panels.defect_text import title
from freecad_tetra.workbench.panels.facts_box import FactsBox, number
from freecad_tetra.workbench.panels.stages import Stages
from freecad_tetra.workbench.panels.work import Work
from freecad_tetra.workbench.runner import State
from freecad_tetra.workbench.selection import TETRAHEDRA

translate = FreeCAD.Qt.translate


class Decompose:
    """A panel for a new object of a solid, or for one that is there.

    Parameters
    ----------
    kind : {TETRAHEDRA, CONVEX_CELLS}
    source : document object
    result : document object, optional
        The object to compute anew; without it each run that succeeds fills one new object.
    """

    def __init__(self, kind: str, source: Any, result: Any = None) -> None:
        self.kind = kind
        self.source = source
        self.result = result
        self.facts = FactsBox(kind, lambda known: None)
        self.choices = Choices(kind, _stored(result))
        self.stages = Stages()
        self.work = Work(self._told, self._ended)
        self.form = self._layout()
        self.facts.work.end_with(self.form)
        self.work.end_with(self.form)
        self._say("")
        self.facts.count(source)

    def _layout(self) -> Any:
        _, _, widgets = compat.qt()
        form = widgets.QWidget()
        name = translate("Tetra", "Tetrahedralize")
        if self.kind != TETRAHEDRA:
            name = translate("Tetra", "Convex cells")
        form.setWindowTitle(name)
        choices = widgets.QGroupBox(translate("Tetra", "Choices"))
        widgets.QVBoxLayout(choices).addWidget(self.choices.widget)
        self.compute_button = widgets.QPushButton(translate("Tetra", "Compute"))
        self.compute_button.clicked.connect(self.compute)
        self.cancel_button = widgets.QPushButton(translate("Tetra", "Cancel"))
        self.cancel_button.clicked.connect(self.work.cancel)
        self.cancel_button.setEnabled(False)
        self.compute_button.setObjectName("TetraCompute")
        self.cancel_button.setObjectName("TetraCancel")
        buttons = widgets.QHBoxLayout()
        buttons.addWidget(self.compute_button)
        buttons.addWidget(self.cancel_button)
        self.message = widgets.QLabel()
        self.message.setWordWrap(True)
        self.message.setObjectName("TetraMessage")
        column = widgets.QVBoxLayout(form)
        for part in (self.facts.widget, choices):
            column.addWidget(part)
        column.addLayout(buttons)
        column.addWidget(self.stages.widget)
        column.addWidget(self.message)
        return form

    def getStandardButtons(self) -> int:
        """FreeCAD asks which buttons to show above the panel."""
        _, _, widgets = compat.qt()
        return compat.button_code(widgets.QDialogButtonBox.Close)

    def reject(self) -> bool:
        """FreeCAD calls this for Close and Esc; work that goes on is cancelled."""
        FreeCADGui.Control.closeDialog()
        return True

    def compute(self) -> None:
        """Start the work; the window stays alive."""
        self.stages.clear()
        self._say("")
        try:
            job = feature.start(self.kind, self.source, self.choices.values())
        except TetraError as error:
            self._fail(error)
            return
        self._busy(True)
        self.work.follow(job)

    def _told(self, state: State) -> None:
        if not state.done:
            self.stages.tell(state.stage, state.fraction)

    def _ended(self, state: State) -> None:
        self._busy(False)
        if state.error is not None:
            self._fail(state.error)
            return
        self.stages.finish()
        try:
            self._store(state.result)
        except TetraError as error:
            self._fail(error)

    def _store(self, pieces: Any) -> None:
        """Make or change the object, as one step that can be undone."""
        if not compat.alive(self.source):
            self._say(translate("Tetra", "The solid is gone: nothing was made"))
            return
        document = self.source.Document
        document.openTransaction(self.form.windowTitle())
        try:
            self._fill(document, pieces)
        except Exception:
            document.abortTransaction()
            raise
        document.commitTransaction()
        said = translate("Tetra", "{0} pieces, volume error {1:.0e}, {2:.1f} s")
        self._say(said.format(number(len(pieces)), self.result.VolumeError, self.result.Seconds))

    def _fill(self, document: Any, pieces: Any) -> None:
        chosen = self.choices.values()
        if not compat.alive(self.result):
            make = feature.make_tetrahedra
            if self.kind != TETRAHEDRA:
                make = feature.make_convex_cells
            self.result = make(document, self.source, **chosen)
        else:
            for name, value in chosen.items():
                setattr(self.result, name, value)
        feature.accept(self.result, pieces)
        document.recompute([self.result])
        if preferences.hide_source():
            self.source.ViewObject.Visibility = False

    def _fail(self, error: TetraError) -> None:
        if isinstance(error, Cancelled):
            self._say(translate("Tetra", "Cancelled: the document is as it was"))
            return
        if isinstance(error, InvalidSolid):
            kinds = ", ".join(dict.fromkeys(title(defect.kind) for defect in error.defects))
            text = translate("Tetra", "Not a valid solid: {0}. Check solid shows where.")
            self._say(text.format(kinds))
            return
        self._say(f"{messages.sentence(error.message)} {messages.sentence(error.next_step)}")

    def _say(self, text: str) -> None:
        self.message.setText(text)
        if text:
            messages.status(text)

    def _busy(self, on: bool) -> None:
        self.compute_button.setEnabled(not on)
        self.cancel_button.setEnabled(on)
        self.choices.enable(not on)


def _stored(result: Any) -> Mapping[str, Any]:
    """Return the properties of an object that is there, {} for None."""
    if result is None:
        return {}
    return {name: getattr(result, name) for name in result.PropertiesList}
