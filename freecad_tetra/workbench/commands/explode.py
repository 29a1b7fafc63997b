# SPDX-License-Identifier: LGPL-2.1-or-later
"""Tetra_Explode: opens the slider that draws the pieces of a result apart."""

from __future__ import annotations

from freecad_tetra.workbench import selection
from freecad_tetra.workbench.commands.command import QT_TRANSLATE_NOOP, Command, opened


class Explode(Command):
    """Draw the pieces of the selected result apart."""

    name = "Tetra_Explode"

    def texts(self) -> tuple[str, str]:
        """Return (menu text, tool tip)."""
        return (
            QT_TRANSLATE_NOOP("Tetra_Explode", "Explode"),
            QT_TRANSLATE_NOOP(
                "Tetra_Explode", "Draws the pieces of the selected object apart by a factor"
            ),
        )

    def why_not(self) -> str:
        """Return "" when one result is selected."""
        return selection.result()[1]

    def run(self) -> None:
        """Open the slider."""
        from freecad_tetra.workbench.panels import explode

        opened(explode.Explode(selection.result()[0]))
