# SPDX-License-Identifier: LGPL-2.1-or-later
"""Tetra_Tetrahedralize: opens the task panel that fills a solid with tetrahedra."""

from __future__ import annotations

from typing import Any

from freecad_tetra.workbench import kernel_path, selection
from freecad_tetra.workbench.commands.command import QT_TRANSLATE_NOOP, Command, opened
from freecad_tetra.workbench.selection import TETRAHEDRA


class Tetrahedralize(Command):
    """Fill the selected solid with face-to-face tetrahedra."""

    name = "Tetra_Tetrahedralize"

    def texts(self) -> tuple[str, str]:
        """Return (menu text, tool tip)."""
        return (
            QT_TRANSLATE_NOOP("Tetra_Tetrahedralize", "Tetrahedralize"),
            QT_TRANSLATE_NOOP(
                "Tetra_Tetrahedralize",
                "Fills the selected solid with tetrahedra that meet face to face "
                "and keep its surface exactly",
            ),
        )

    def why_not(self) -> str:
        """Return "" when one solid is selected and the kernel is there."""
        return selection.solid()[1] or kernel_path.problem()

    def run(self) -> None:
        """Open the task panel for the selected solid."""
        from freecad_tetra.workbench.panels import decompose

        source: Any = selection.solid()[0]
        opened(decompose.Decompose(TETRAHEDRA, source))
