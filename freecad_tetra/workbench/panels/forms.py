# SPDX-License-Identifier: LGPL-2.1-or-later
"""The empty form of a task panel, with its title and icon."""

from __future__ import annotations

from typing import Any

from freecad_tetra.workbench import compat, places


def new_form(title: str, icon: str) -> Any:
    """Return a QWidget that FreeCAD shows with a title and the icon of a command."""
    _, gui, widgets = compat.qt()
    form = widgets.QWidget()
    form.setObjectName("TetraPanel")
    form.setWindowTitle(title)
    form.setWindowIcon(gui.QIcon(places.icon(icon)))
    return form


def close_only() -> int:
    """Return the standard buttons of a panel that has nothing to accept."""
    _, _, widgets = compat.qt()
    return compat.button_code(widgets.QDialogButtonBox.Close)
