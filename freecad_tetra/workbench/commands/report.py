# SPDX-License-Identifier: LGPL-2.1-or-later
"""Tetra_Report: shows counts, bounds, volumes and quality of a result."""

from __future__ import annotations

from freecad_tetra.workbench import selection
from freecad_tetra.workbench.commands.command import QT_TRANSLATE_NOOP, Command, opened


class Report(Command):
    """Show figures of the selected result."""

    name = "Tetra_Report"

    def texts(self) -> tuple[str, str]:
        """Return (menu text, tool tip)."""
        return (
            QT_TRANSLATE_NOOP("Tetra_Report", "Report"),
            QT_TRANSLATE_NOOP(
                "Tetra_Report",
                "Shows counts, bounds, volumes and the quality of the selected object's pieces",
            ),
        )

    def why_not(self) -> str:
        """Return "" when one result is selected."""
        return selection.result()[1]

    def run(self) -> None:
        """Open the figures."""
        from freecad_tetra.workbench.panels import report

        opened(report.Report(selection.result()[0]))
