# SPDX-License-Identifier: LGPL-2.1-or-later
"""The commands of the workbench, one file each.

A new command is a file with a class derived from `Command` and one entry in `all_commands`.
"""

from __future__ import annotations

import FreeCADGui

from freecad_tetra.workbench.commands.check_solid import CheckSolid
from freecad_tetra.workbench.commands.command import Command
from freecad_tetra.workbench.commands.convex_cells import ConvexCells
from freecad_tetra.workbench.commands.explode import Explode
from freecad_tetra.workbench.commands.report import Report
from freecad_tetra.workbench.commands.tetrahedralize import Tetrahedralize
from freecad_tetra.workbench.commands.to_fem_mesh import ToFemMesh


def all_commands() -> tuple[Command, ...]:
    """Return the commands in the order of the tool bar."""
    return (
        Tetrahedralize(),
        ConvexCells(),
        ToFemMesh(),
        CheckSolid(),
        Explode(),
        Report(),
    )


def register() -> list[str]:
    """Make the commands known to FreeCAD and return their names."""
    commands = all_commands()
    for command in commands:
        FreeCADGui.addCommand(command.name, command)
    return [command.name for command in commands]
