# SPDX-License-Identifier: LGPL-2.1-or-later
"""The command ``robot``: a part as MuJoCo, URDF or SDF model with its cells as collision meshes."""

from __future__ import annotations

import argparse
import json
from collections.abc import Callable
from pathlib import Path

from freecad_tetra import api, export
from freecad_tetra.errors import UnsupportedFormat

SUFFIXES = (".xml", ".mjcf", ".urdf", ".sdf")
Progress = Callable[[str, float], "bool | None"]


def add(commands: argparse._SubParsersAction[argparse.ArgumentParser]) -> None:
    """Add the command to the parser."""
    command = commands.add_parser("robot", help="write a part as a model of a physics engine")
    command.add_argument("input", metavar="INPUT", help="a part, as for cells")
    command.add_argument(
        "-o", "--output", required=True, metavar="OUT", help=".xml (MuJoCo) .urdf .sdf"
    )
    command.add_argument("--density", type=float, default=1000.0, metavar="KG/M3")
    command.add_argument(
        "--scale", type=float, default=0.001, help="metres per unit (default 0.001: mm)"
    )
    command.add_argument("--fixed", action="store_true", help="no free joint (.xml), static (.sdf)")
    command.add_argument("--report", metavar="FILE", help="write a report (JSON)")
    command.set_defaults(surface=None)
    add_limits(command)


def add_limits(command: argparse.ArgumentParser) -> None:
    """Add the limits on cells, which `cells` has too."""
    command.add_argument("--max-cells", type=int, metavar="N", help="merge into at most N hulls")
    command.add_argument(
        "--max-vertices", type=int, metavar="N", help="at most N vertices a hull, 8 or more"
    )


def write(arguments: argparse.Namespace, progress: Progress) -> int:
    """Write the model and return the exit code.

    Raises
    ------
    UnsupportedFormat, and the errors of `convex_cells`
    """
    suffix = Path(arguments.output).suffix.lower()
    if suffix not in SUFFIXES:
        raise UnsupportedFormat(
            f"{arguments.output}: no robot format ends in {suffix or 'nothing'}",
            f"use one of {' '.join(SUFFIXES)}",
        )
    cells = api.convex_cells(
        arguments.input,
        max_cells=arguments.max_cells,
        max_vertices=arguments.max_vertices,
        progress=progress,
    )
    options = {"density": arguments.density, "scale": arguments.scale}
    if suffix == ".urdf":
        cells.write_urdf(arguments.output, **options)
    elif suffix == ".sdf":
        cells.write_sdf(arguments.output, fixed=arguments.fixed, **options)
    else:
        cells.write_mjcf(arguments.output, fixed=arguments.fixed, **options)
    if arguments.report:
        with export.atomic(arguments.report) as stream:
            stream.write(json.dumps(cells.report.to_dict(), indent=1).encode() + b"\n")
    error = cells.report.details.get("limits", {}).get("hull_error", 0.0)
    print(f"{len(cells)} convex cells in {arguments.output}; hull error {error:.4g}")
    return 0
