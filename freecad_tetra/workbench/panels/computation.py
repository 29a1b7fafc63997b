# SPDX-License-Identifier: LGPL-2.1-or-later
"""A task panel that computes: facts, choices, Compute, a bar for each stage, Cancel.

The work goes on in a child process; the document is touched once, when the result is there,
in one transaction. Cancelled or failed work leaves the document as it was.
"""

from __future__ import annotations

from typing import Any

import FreeCAD
import FreeCADGui

from freecad_tetra.errors import Cancelled, InvalidSolid, TetraError
from freecad_tetra.workbench import compat, messages
from freecad_tetra.workbench.panels.defect_text import title
from freecad_tetra.workbench.panels.facts_box import FactsBox
from freecad_tetra.workbench.panels.forms import close_only, new_form
from freecad_tetra.workbench.panels.stages import Stages
from freecad_tetra.workbench.panels.work import Work
from freecad_tetra.workbench.runner import Job, State

translate = FreeCAD.Qt.translate

PAUSE = 500  # milliseconds


class Computation:
    """What the panels of Tetrahedralize, Convex cells and To FEM mesh have in common.

    Parameters
    ----------
    name : str
        Title of the panel and of the step in the undo list.
    icon : str
        Of the command.
    kind : {TETRAHEDRA, CONVEX_CELLS}
        Whose facts are told.
    source : document object
        The solid, or another object that needs no facts.
    choices : object with `widget`, `values`, `enable` and `on_change`
    """

    def __init__(self, name: str, icon: str, kind: str, source: Any, choices: Any) -> None:
        self.name = name
        self.icon = icon
        self.source = source
        self.choices = choices
        self.facts = FactsBox(kind)
        self.stages = Stages()
        self.work = Work(self._told, self._ended)
        self.form = self._layout()
        self.facts.work.end_with(self.form)
        self._pause = self._new_pause()
        self.work.end_with(self.form)

    def count_facts(self) -> None:
        """Count the facts of the solid now, and again whenever choices change."""
        self.choices.on_change(self._pause.start)
        self._recount()

    def _recount(self) -> None:
        self.facts.count(self.source, self.choices.values())

    def _new_pause(self) -> Any:
        """Return the timer that lets the user finish typing before the facts are counted."""
        core, _, _ = compat.qt()
        pause = core.QTimer(self.form)
        pause.setSingleShot(True)
        pause.setInterval(PAUSE)
        pause.timeout.connect(self._recount)
        return pause

    def begin(self) -> Job | None:
        """Start the work and return its job, or None when there is nothing to wait for."""
        raise NotImplementedError

    def fill(self, document: Any, result: Any) -> str:
        """Make or change the object of a result and return what to say; in a transaction."""
        raise NotImplementedError

    def _layout(self) -> Any:
        _, _, widgets = compat.qt()
        form = new_form(self.name, self.icon)
        choices = widgets.QGroupBox(translate("Tetra", "Choices"))
        widgets.QVBoxLayout(choices).addWidget(self.choices.widget)
        self.compute_button = self._button("TetraCompute", translate("Tetra", "Compute"))
        self.compute_button.clicked.connect(self.compute)
        self.cancel_button = self._button("TetraCancel", translate("Tetra", "Cancel"))
        self.cancel_button.clicked.connect(self.work.cancel)
        self.cancel_button.setEnabled(False)
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
        for part in (self.message, self.stages.widget):
            column.addWidget(part)
        return form

    def _button(self, name: str, text: str) -> Any:
        _, _, widgets = compat.qt()
        button = widgets.QPushButton(text)
        button.setObjectName(name)
        return button

    def getStandardButtons(self) -> int:
        """FreeCAD asks which buttons to show above the panel."""
        return close_only()

    def reject(self) -> bool:
        """FreeCAD calls this for Close and Esc; work that goes on ends with the form."""
        FreeCADGui.Control.closeDialog()
        return True

    def compute(self) -> None:
        """Start the work; the window stays alive."""
        self.stages.clear()
        self.say("")
        try:
            job = self.begin()
        except TetraError as error:
            self._fail(error)
            return
        if job is None:
            self._ended(State(done=True))
            return
        self._busy(True)
        self.work.follow(job)

    def say(self, text: str) -> None:
        """Show a line in the panel and in the status bar."""
        self.message.setText(text)
        if text:
            messages.status(text)

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

    def _store(self, result: Any) -> None:
        """Make or change the object, as one step that can be undone."""
        if not compat.alive(self.source):
            self.say(translate("Tetra", "The solid is gone: nothing was made"))
            return
        document = self.source.Document
        document.openTransaction(self.name)
        try:
            said = self.fill(document, result)
        except Exception:
            document.abortTransaction()
            raise
        document.commitTransaction()
        self.say(said)

    def _fail(self, error: TetraError) -> None:
        if isinstance(error, Cancelled):
            self.say(translate("Tetra", "Cancelled: the document is as it was"))
            return
        if isinstance(error, InvalidSolid):
            kinds = ", ".join(dict.fromkeys(title(defect.kind) for defect in error.defects))
            text = translate("Tetra", "Not a valid solid: {0}. Check solid shows where.")
            self.say(text.format(kinds))
            return
        self.say(f"{messages.sentence(error.message)} {messages.sentence(error.next_step)}")

    def _busy(self, on: bool) -> None:
        self.compute_button.setEnabled(not on)
        self.cancel_button.setEnabled(on)
        self.choices.enable(not on)


def recompute(obj: Any) -> None:
    """Recompute one object.

    Raises
    ------
    TetraError
        FreeCAD has marked the object as faulty.
    """
    obj.Document.recompute([obj])
    if "Invalid" in obj.State:
        raise TetraError(obj.getStatusString(), "nothing was made; please report the part")
