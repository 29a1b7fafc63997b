# SPDX-License-Identifier: LGPL-2.1-or-later
"""Tetra_ConvexCells: opens the task panel that cuts a solid into convex cells."""

from __future__ import annotations

from typing import Any

from freecad_tetra.workbench import kernel_path, selection
from freecad_tetra.workbench.commands.command import QT_TRANSLATE_NOOP, Command, opened
from freecad_tetra.workbench.selection import CONVEX_CELLS


class ConvexCells(Command):
    """Cut the selected solid into convex cells."""

    name = "Tetra_ConvexCells"

    def texts(self) -> tuple[str, str]:
        """Return (menu text, tool tip)."""
        return (
            QT_TRANSLATE_NOOP("Tetra_ConvexCells", "Convex cells"),
            QT_TRANSLATE_NOOP(
                "Tetra_ConvexCells",
                "Cuts the selected solid into closed convex pieces that cover it exactly once",
            ),
        )

    def why_not(self) -> str:
        """Return "" when one solid is selected and the kernel is there."""
        return selection.solid()[1] or kernel_path.problem()

    def run(self) -> None:
        """Open the task panel for the selected solid."""
        from freecad_tetra.workbench.panels import decompose

        source: Any = selection.solid()[0]
        opened(decompose.Decompose(CONVEX_CELLS, source))
