# SPDX-License-Identifier: LGPL-2.1-or-later
"""The box with live facts of the solid: counted in the background, shown when known."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import FreeCAD

from freecad_tetra.errors import TetraError
from freecad_tetra.workbench import compat, facts, messages
from freecad_tetra.workbench.panels.work import Work
from freecad_tetra.workbench.runner import State
from freecad_tetra.workbench.selection import CONVEX_CELLS

translate = FreeCAD.Qt.translate


class FactsBox:
    """Figures of a solid in two columns.

    Attributes
    ----------
    widget : QGroupBox
    known : mapping
        What `facts.facts` tells, empty until it is there.
    work : Work
        The counting.
    """

    def __init__(self, kind: str) -> None:
        _, _, widgets = compat.qt()
        self.widget = widgets.QGroupBox()
        self._form = widgets.QFormLayout(self.widget)
        self._label = widgets.QLabel
        self._rows: dict[str, Any] = {}
        self.known: Mapping[str, Any] = {}
        self._kind = kind
        self.work = Work(lambda state: None, self._end)

    def show(self, result: Any) -> None:
        """Show the figures of an object of this workbench, which are known."""
        self.widget.setTitle(result.Label)
        self._row("pieces", translate("Tetra", "Pieces"), number(result.Pieces))
        self._row("notches", translate("Tetra", "Notches"), number(result.Notches))

    def count(self, source: Any, given: Mapping[str, Any]) -> None:
        """Start to count the facts of a solid, tessellated as the given choices say."""
        if not compat.alive(source):
            return
        self.widget.setTitle(source.Label)
        self._row("state", translate("Tetra", "State"), translate("Tetra", "counting..."))
        try:
            self.work.follow(facts.start_facts(source, given))
        except TetraError as error:
            self._end(State(done=True, error=error))

    def _end(self, state: State) -> None:
        if state.error is not None:
            self._row("state", translate("Tetra", "State"), messages.sentence(str(state.error)))
            return
        self.known = state.result
        for name, title, text in rows(self._kind, self.known):
            self._row(name, title, text)

    def _row(self, name: str, title: str, text: str) -> None:
        if name not in self._rows:
            label = self._label()
            label.setWordWrap(True)
            self._form.addRow(title, label)
            self._rows[name] = label
        self._rows[name].setText(text)


def rows(kind: str, known: Mapping[str, Any]) -> list[tuple[str, str, str]]:
    """Return (name, title, text) of the facts to show, in this order."""
    faults = len(known["defects"])
    sound = translate("Tetra", "valid")
    bad = translate("Tetra", "{0} defects, see Check solid").format(faults)
    shown = [
        ("state", translate("Tetra", "State"), bad if faults else sound),
        ("faces", translate("Tetra", "Faces"), number(known["faces"])),
        ("triangles", translate("Tetra", "Triangles"), number(known["triangles"])),
        ("notches", translate("Tetra", "Notches"), number(known["notches"])),
    ]
    if kind == CONVEX_CELLS:
        shown.append(("bound", translate("Tetra", "Pieces at most"), number(known["bound"])))
    expected = known["expected"].get(kind)
    if expected:
        shown.append(
            ("expected", translate("Tetra", "Expected pieces"), number(expected["pieces"]))
        )
        shown.append(("cost", translate("Tetra", "Expected time"), duration(expected["seconds"])))
    return shown


def number(value: int) -> str:
    """Return a count with its thousands apart."""
    return f"{value:,}".replace(",", "\u2009")


def duration(seconds: float) -> str:
    """Return a time that is easily read."""
    if seconds < 1.0:
        return translate("Tetra", "under 1 s")
    if seconds < 90.0:
        return translate("Tetra", "about {0} s").format(round(seconds))
    return translate("Tetra", "about {0} min").format(round(seconds / 60.0))
