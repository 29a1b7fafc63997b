# SPDX-License-Identifier: LGPL-2.1-or-later
"""Fills the workbench: tool bar, menu, context menu, and the hint about the selection."""

from __future__ import annotations

from typing import Any

import FreeCAD
import FreeCADGui

from freecad_tetra.workbench import commands, messages, selection

QT_TRANSLATE_NOOP = FreeCAD.Qt.QT_TRANSLATE_NOOP

_names: list[str] = []
_watchers: list[Any] = []


def fill(workbench: Any) -> None:
    """Register the commands and put them into a tool bar and a menu."""
    _names[:] = commands.register()
    workbench.appendToolbar(QT_TRANSLATE_NOOP("Workbench", "Tetra"), _names)
    workbench.appendMenu(QT_TRANSLATE_NOOP("Workbench", "&Tetra"), _names)


def fill_context_menu(workbench: Any) -> None:
    """Offer the commands that can work on the selection."""
    usable = [name for name in _names if FreeCADGui.Command.get(name).isActive()]
    if usable:
        workbench.appendContextMenu(QT_TRANSLATE_NOOP("Workbench", "Tetra"), usable)


class Watcher:
    """Says in the status bar why a selection will not do, while the workbench is open."""

    def addSelection(self, document: str, name: str, element: str, point: Any) -> None:
        """FreeCAD calls this after a selection."""
        reason = selection.result()[1] and selection.solid()[1]
        if reason:
            messages.status(reason)


def watch(on: bool) -> None:
    """Start or end the hints about the selection."""
    while _watchers:
        FreeCADGui.Selection.removeObserver(_watchers.pop())
    if on:
        _watchers.append(Watcher())
        FreeCADGui.Selection.addObserver(_watchers[-1])
