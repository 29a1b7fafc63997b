# SPDX-License-Identifier: LGPL-2.1-or-later
"""What all commands share: how FreeCAD asks them, and how they say why they cannot work."""

from __future__ import annotations

from typing import Any

import FreeCAD
import FreeCADGui

from freecad_tetra.errors import TetraError
from freecad_tetra.workbench import messages

translate = FreeCAD.Qt.translate
QT_TRANSLATE_NOOP = FreeCAD.Qt.QT_TRANSLATE_NOOP


class Command:
    """A command that is active only while `why_not` finds nothing in its way.

    Attributes
    ----------
    name : str
        FreeCAD's name of the command, which is its icon's name as well.
    """

    name = ""

    def texts(self) -> tuple[str, str]:
        """Return (menu text, tool tip), which FreeCAD translates under the name."""
        raise NotImplementedError

    def why_not(self) -> str:
        """Return "" when the command can work, or what keeps it; must be fast."""
        raise NotImplementedError

    def run(self) -> None:
        """Do it; a TetraError is shown to the user."""
        raise NotImplementedError

    def GetResources(self) -> dict[str, Any]:
        """Tell FreeCAD what to show."""
        menu_text, tool_tip = self.texts()
        return {"Pixmap": self.name, "MenuText": menu_text, "ToolTip": tool_tip}

    def IsActive(self) -> bool:
        """Whether the button is enabled; FreeCAD asks after every selection."""
        reason = busy() or self.why_not()
        messages.explain(self.name, reason)
        return not reason

    def Activated(self) -> None:
        """FreeCAD calls this on a click, a shortcut or runCommand."""
        try:
            self.run()
        except TetraError as error:
            messages.show_error(error)


def busy() -> str:
    """Return why no command of this workbench can start now, or ""."""
    if FreeCAD.ActiveDocument is None:
        return translate("Tetra", "Open or create a document first")
    if FreeCADGui.Control.activeDialog():
        return translate("Tetra", "Close the open task first")
    return ""


def opened(panel: Any) -> None:
    """Show a task panel."""
    FreeCADGui.Control.showDialog(panel)
