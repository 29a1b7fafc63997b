# SPDX-License-Identifier: LGPL-2.1-or-later
"""Tetra_CheckSolid: lists what keeps a shape from being a solid and selects the faces at fault."""

from __future__ import annotations

from freecad_tetra.workbench import kernel_path, selection
from freecad_tetra.workbench.commands.command import QT_TRANSLATE_NOOP, Command, opened


class CheckSolid(Command):
    """List the defects of the selected solid."""

    name = "Tetra_CheckSolid"

    def texts(self) -> tuple[str, str]:
        """Return (menu text, tool tip)."""
        return (
            QT_TRANSLATE_NOOP("Tetra_CheckSolid", "Check solid"),
            QT_TRANSLATE_NOOP(
                "Tetra_CheckSolid",
                "Lists what is wrong with the selected solid and selects the faces at fault",
            ),
        )

    def why_not(self) -> str:
        """Return "" when one solid is selected and the kernel is there."""
        return selection.solid()[1] or kernel_path.problem()

    def run(self) -> None:
        """Open the task panel, which checks at once."""
        from freecad_tetra.workbench.panels import check

        opened(check.Check(selection.solid()[0]))
