# SPDX-License-Identifier: LGPL-2.1-or-later
"""What the command line accepts; a wrong word ends with exit code 2 and the usage."""

from __future__ import annotations

import argparse
import math
from collections.abc import Sequence

from freecad_tetra._version import __version__
from freecad_tetra.cli import robot, shown

PROGRAM = "freecad-tetra"
_INPUTS = ".step .stp .brep .iges .fcstd .stl .obj .off .ply"


def parse(argv: Sequence[str] | None) -> argparse.Namespace:
    """Parse the arguments of ``freecad-tetra``.

    Raises
    ------
    SystemExit
        With code 2 on wrong usage, 0 after ``--help`` and ``--version``.
    """
    return parser().parse_args(argv)


def parser() -> argparse.ArgumentParser:
    """Return the parser of all commands."""
    top = argparse.ArgumentParser(
        prog=PROGRAM,
        description="Exact convex cells and face-to-face tetrahedra of CAD solids.",
        epilog="exit codes: 0 done and verified, 2 usage, 3 invalid solid, 4 unreadable file, "
        "5 verification failed (nothing written), 130 cancelled",
    )
    top.add_argument("--version", action="version", version=f"{PROGRAM} {__version__}")
    commands = top.add_subparsers(dest="command", required=True, metavar="COMMAND")
    _tets(commands.add_parser("tets", help="fill a solid with face-to-face tetrahedra"))
    _cells(commands.add_parser("cells", help="partition a solid into convex cells"))
    _common(commands.add_parser("info", help="validate a solid and count what is in it"))
    quality = commands.add_parser("quality", help="tell the shape of a mesh's tetrahedra")
    quality.add_argument("input", metavar="FILE", help=".vtu .msh .inp .mesh .vtk .med")
    quality.add_argument("--report", metavar="FILE", help="write the figures (JSON)")
    check = commands.add_parser("check", help="verify a result file against its solid")
    _common(check)
    check.add_argument("result", metavar="OUT", help="cells (.obj .vtu) or tetrahedra (.vtu)")
    robot.add(commands)
    shown.add(commands)
    return top


def _tets(command: argparse.ArgumentParser) -> None:
    _common(command)
    _output(command, ".vtu .msh .inp .mesh .vtk .brep .obj (skin)")
    command.add_argument(
        "--method", choices=("chazelle-palios", "bajaj-dey"), default="chazelle-palios"
    )
    command.add_argument(
        "--direction",
        type=_direction,
        default="auto",
        metavar="auto|x|y|z|A,B,C",
        help="direction of the fences",
    )
    command.add_argument("--pull-off", choices=("auto", "on", "off"), default="auto")
    compact = command.add_mutually_exclusive_group()
    compact.add_argument("--compact", choices=("default", "max"), default="default")
    compact.add_argument("--no-compact", dest="compact", action="store_const", const="off")
    _fem(command)


def _fem(command: argparse.ArgumentParser) -> None:
    group = command.add_argument_group(
        "for analysis", "chord, turn and face size act with --quality"
    )
    group.add_argument("--order", type=int, choices=(1, 2), default=1, help="2: nodes amid edges")
    group.add_argument(
        "--refine", type=_times, default=0, metavar="N", help="divide each element into 8, N times"
    )
    group.add_argument("--size", type=_positive, metavar="MM", help="longest edge")
    group.add_argument("--quality", action="store_true", help="better elements, by mmg3d")
    group.add_argument(
        "--chord",
        type=_positive,
        metavar="MM",
        help="distance of edges from round faces",
    )
    group.add_argument(
        "--turn",
        type=_positive,
        default=0.0,
        metavar="N",
        help="elements in a full turn",
    )
    group.add_argument(
        "--face-size", type=_face_size, action="append", default=[], metavar="FaceN=MM",
        help="longest edge on one B-rep face",
    )  # fmt: skip


def _cells(command: argparse.ArgumentParser) -> None:
    _common(command)
    _output(command, ".obj .vtu .glb .brep .step")
    command.add_argument("--method", choices=("auto", "bajaj-dey", "fences"), default="auto")
    command.add_argument("--plain", action="store_true", help="each notch by its own plane")
    command.add_argument("--no-merge", action="store_true", help="leave the pieces as cut")
    command.add_argument(
        "--flatness",
        type=_steps,
        metavar="STEPS",
        help="grid steps within which facets of a plane are coplanar",
    )
    robot.add_limits(command)


def _output(command: argparse.ArgumentParser, suffixes: str) -> None:
    command.add_argument("-o", "--output", required=True, metavar="OUT", help=suffixes)


def _common(command: argparse.ArgumentParser) -> None:
    command.add_argument("input", metavar="INPUT", help=_INPUTS)
    chord = command.add_mutually_exclusive_group()
    chord.add_argument("--linear-deflection", type=_positive, metavar="MM", help="chord height")
    chord.add_argument(
        "--relative-deflection",
        type=_positive,
        metavar="R",
        help="chord height as a share of the diagonal (default 0.001)",
    )
    command.add_argument(
        "--angular-deflection", type=_angle, metavar="DEG", help="angle of chords (default 20)"
    )
    command.add_argument("--solid", type=_number, metavar="N", help="only the N-th solid, from 1")
    command.add_argument("--surface", metavar="FILE", help="write the decomposed triangles (.off)")
    command.add_argument("--report", metavar="FILE", help="write a report (JSON)")


def _positive(word: str) -> float:
    value = float(word)
    if not (value > 0 and math.isfinite(value)):
        raise argparse.ArgumentTypeError(f"{word} is not above zero")
    return value


def _angle(word: str) -> float:
    value = _positive(word)
    if value > 90:
        raise argparse.ArgumentTypeError(f"{word} degrees is too coarse, 90 is the most")
    return value


def _number(word: str) -> int:
    value = int(word)
    if value < 1:
        raise argparse.ArgumentTypeError(f"{word} is below 1")
    return value


def _times(word: str) -> int:
    value = int(word)
    if not 0 <= value <= 4:
        raise argparse.ArgumentTypeError(f"{word} is not between 0 and 4")
    return value


def _face_size(word: str) -> tuple[str, float]:
    name, _, value = word.partition("=")
    if not (name.startswith("Face") and name[4:].isdigit() and value):
        raise argparse.ArgumentTypeError(f"{word} is not like Face3=0.5")
    return name, _positive(value)


def _steps(word: str) -> int:
    value = int(word)
    if not 0 <= value <= 8:
        raise argparse.ArgumentTypeError(f"{word} is not between 0 and 8")
    return value


def _direction(word: str) -> str | tuple[int, ...]:
    if word in ("auto", "x", "y", "z"):
        return word
    try:
        values = tuple(int(part) for part in word.split(","))
    except ValueError:
        values = ()
    if len(values) != 3 or not any(values):
        raise argparse.ArgumentTypeError(f"{word} is neither auto, x, y, z nor A,B,C in integers")
    return values
