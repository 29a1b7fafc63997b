# SPDX-License-Identifier: LGPL-2.1-or-later
"""Says things to the user: in the status bar, as a button's tip, in a box."""

from __future__ import annotations

import FreeCAD
import FreeCADGui

from freecad_tetra.errors import TetraError
from freecad_tetra.workbench import compat

translate = FreeCAD.Qt.translate

SECONDS = 8
_reasons: dict[str, str] = {}


def explain(command: str, reason: str) -> None:
    """Give a command's button the reason why it is off as its tip; "" gives its own tip back."""
    if _reasons.get(command) == reason:
        return
    _reasons[command] = reason
    known = FreeCADGui.Command.get(command)
    for action in known.getAction() if known is not None else []:
        own = action.property("tetra_tip")
        if own is None:
            own = action.statusTip()
            action.setProperty("tetra_tip", own)
        action.setStatusTip(reason or own)


def reason(command: str) -> str:
    """Return why a command was off when FreeCAD asked last, "" when it was on."""
    return _reasons.get(command, "")


def status(text: str) -> None:
    """Show a line in the status bar for some seconds."""
    FreeCADGui.getMainWindow().statusBar().showMessage(text, SECONDS * 1000)


def show_error(error: TetraError) -> None:
    """Show what is wrong and what to do next in a box, and wait for its button."""
    _, _, widgets = compat.qt()
    box = widgets.QMessageBox(FreeCADGui.getMainWindow())
    box.setIcon(widgets.QMessageBox.Warning)
    box.setWindowTitle(translate("Tetra", "Tetra"))
    box.setText(sentence(error.message))
    box.setInformativeText(sentence(error.next_step))
    compat.ask(box)


def sentence(text: str) -> str:
    """Return a line of the library with a capital letter and a full stop."""
    if not text:
        return ""
    whole = text[0].upper() + text[1:]
    return whole if whole.endswith((".", "!", "?")) else whole + "."
