# SPDX-License-Identifier: LGPL-2.1-or-later
"""The task panel of Check solid: a list of defects whose faces are selected in the 3D view."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

import FreeCAD
import FreeCADGui

from freecad_tetra.errors import Defect, InvalidSolid, TetraError
from freecad_tetra.workbench import compat, facts, messages
from freecad_tetra.workbench.panels.defect_text import line
from freecad_tetra.workbench.panels.forms import close_only, new_form
from freecad_tetra.workbench.panels.work import Work
from freecad_tetra.workbench.runner import State

translate = FreeCAD.Qt.translate


class Check:
    """Checks one object when it is opened; the document is not touched."""

    def __init__(self, source: Any) -> None:
        self.source = source
        self.defects: tuple[Defect, ...] = ()
        self.work = Work(self._told, self._ended)
        self.form = self._layout()
        self.work.end_with(self.form)
        self.verdict.setText(translate("Tetra", "Checking {0}...").format(source.Label))
        try:
            self.work.follow(facts.start_facts(source))
        except TetraError as error:
            self._ended(State(done=True, error=error))

    def _layout(self) -> Any:
        _, _, widgets = compat.qt()
        form = new_form(translate("Tetra", "Check solid"), "Tetra_CheckSolid")
        self.verdict = widgets.QLabel()
        self.verdict.setWordWrap(True)
        self.verdict.setObjectName("TetraMessage")
        self.bar = widgets.QProgressBar()
        self.list = widgets.QListWidget()
        self.list.setWordWrap(True)
        self.list.setObjectName("TetraDefects")
        self.list.currentRowChanged.connect(self._select_row)
        self.all_button = widgets.QPushButton(translate("Tetra", "Select all faces at fault"))
        self.all_button.clicked.connect(self.select_all)
        column = widgets.QVBoxLayout(form)
        for part in (self.verdict, self.bar, self.list, self.all_button):
            column.addWidget(part)
        self.list.hide()
        self.all_button.hide()
        return form

    def getStandardButtons(self) -> int:
        """FreeCAD asks which buttons to show above the panel."""
        return close_only()

    def reject(self) -> bool:
        """FreeCAD calls this for Close and Esc; the selected faces stay selected."""
        FreeCADGui.Control.closeDialog()
        return True

    def select_all(self) -> None:
        """Select the faces of all defects."""
        self._select(name for defect in self.defects for name in defect.faces)

    def _told(self, state: State) -> None:
        self.bar.setValue(int(100 * state.fraction))

    def _ended(self, state: State) -> None:
        self.bar.hide()
        if isinstance(state.error, InvalidSolid):
            self._show(state.error.defects)
        elif state.error is not None:
            self.verdict.setText(messages.sentence(str(state.error)))
        else:
            self._show(state.result["defects"])

    def _show(self, defects: Iterable[Defect]) -> None:
        self.defects = tuple(defects)
        name = self.source.Label
        if not self.defects:
            text = translate("Tetra", "{0} is a valid solid: it can be decomposed.").format(name)
            self.verdict.setText(text)
            return
        text = translate("Tetra", "{0} is not a valid solid. What is wrong: {1}")
        self.verdict.setText(text.format(name, len(self.defects)))
        for defect in self.defects:
            self.list.addItem(line(defect))
        self.list.show()
        self.all_button.setVisible(any(defect.faces for defect in self.defects))
        self.select_all()

    def _select_row(self, row: int) -> None:
        if 0 <= row < len(self.defects):
            self._select(self.defects[row].faces)

    def _select(self, faces: Iterable[str]) -> None:
        if not compat.alive(self.source):
            return
        FreeCADGui.Selection.clearSelection()
        for face in dict.fromkeys(faces):
            FreeCADGui.Selection.addSelection(self.source, face)
