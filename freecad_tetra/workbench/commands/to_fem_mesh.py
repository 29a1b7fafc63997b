# SPDX-License-Identifier: LGPL-2.1-or-later
"""Tetra_ToFemMesh: opens the task panel that makes a FEM mesh of a solid or of its tetrahedra."""

from __future__ import annotations

from freecad_tetra.workbench import kernel_path, selection
from freecad_tetra.workbench.commands.command import QT_TRANSLATE_NOOP, Command, opened
from freecad_tetra.workbench.selection import TETRAHEDRA


class ToFemMesh(Command):
    """Make a FEM mesh of the selected solid or tetrahedra."""

    name = "Tetra_ToFemMesh"

    def texts(self) -> tuple[str, str]:
        """Return (menu text, tool tip)."""
        return (
            QT_TRANSLATE_NOOP("Tetra_ToFemMesh", "To FEM mesh"),
            QT_TRANSLATE_NOOP(
                "Tetra_ToFemMesh",
                "Makes a FEM mesh of the selected solid or of its tetrahedra: "
                "nodes, volume elements and faces of the skin",
            ),
        )

    def why_not(self) -> str:
        """Return "" when a solid or tetrahedra are selected and the kernel is there."""
        if not selection.result((TETRAHEDRA,))[1]:
            return ""
        return selection.solid()[1] or kernel_path.problem()

    def run(self) -> None:
        """Open the task panel for what is selected."""
        from freecad_tetra.workbench.panels import fem_mesh

        tetrahedra, reason = selection.result((TETRAHEDRA,))
        opened(fem_mesh.ToFemMesh(selection.solid()[0] if reason else tetrahedra))
