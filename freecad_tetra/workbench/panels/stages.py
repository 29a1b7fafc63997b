# SPDX-License-Identifier: LGPL-2.1-or-later
"""A progress bar for each stage of the work, in the order in which the stages come."""

from __future__ import annotations

from typing import Any

import FreeCAD

from freecad_tetra.workbench import compat

translate = FreeCAD.Qt.translate


def title(stage: str) -> str:
    """Return what a stage of the library is called in the window."""
    known = {
        "start": translate("Tetra", "Start"),
        "read": translate("Tetra", "Read"),
        "tessellate": translate("Tetra", "Tessellate"),
        "validate": translate("Tetra", "Check"),
        "crossings": translate("Tetra", "Count crossings"),
        "columns": translate("Tetra", "Columns"),
        "fences": translate("Tetra", "Fences"),
        "pull_off": translate("Tetra", "Pull off cups"),
        "skin": translate("Tetra", "Skin"),
        "cells": translate("Tetra", "Cells"),
        "cutting notches": translate("Tetra", "Cut notches"),
        "merging cells": translate("Tetra", "Merge cells"),
        "compact": translate("Tetra", "Remove points"),
        "restore": translate("Tetra", "Restore coordinates"),
        "verify": translate("Tetra", "Verify"),
    }
    return known.get(stage, stage.replace("_", " ").capitalize())


class Stages:
    """A column of titled bars; one is added whenever a new stage is told.

    Attributes
    ----------
    widget : QWidget
    """

    def __init__(self) -> None:
        _, _, self._widgets = compat.qt()
        self.widget = self._widgets.QWidget()
        self._rows = self._widgets.QFormLayout(self.widget)
        self._rows.setContentsMargins(0, 0, 0, 0)
        self._bars: dict[str, Any] = {}
        self._current = ""

    def clear(self) -> None:
        """Take all bars away."""
        while self._rows.count():
            self._rows.takeAt(0).widget().deleteLater()
        self._bars.clear()
        self._current = ""

    def tell(self, stage: str, fraction: float) -> None:
        """Show how far a stage is; the stages before it are complete."""
        if stage != self._current and self._current in self._bars:
            self._bars[self._current].setValue(100)
        self._current = stage
        bar = self._bars.get(stage) or self._add(stage)
        bar.setValue(int(100 * min(1.0, max(0.0, fraction))))

    def finish(self) -> None:
        """Show all stages complete."""
        for bar in self._bars.values():
            bar.setValue(100)

    def _add(self, stage: str) -> Any:
        bar = self._widgets.QProgressBar()
        bar.setRange(0, 100)
        bar.setObjectName(stage)
        self._rows.addRow(title(stage), bar)
        self._bars[stage] = bar
        return bar
