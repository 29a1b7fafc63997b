#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Write the bundled parts below ``resources/parts``; needs cadquery (any environment that has it).

The STEP files are committed beside this script, so nobody needs cadquery to build or to test.

Usage: ``make_parts.py [FOLDER]``
"""

from __future__ import annotations

import re
import sys
from pathlib import Path

import cadquery as cq


def bracket() -> cq.Workplane:
    """One solid, in mm: an angle bracket with rib, boss, holes, keyway, pocket and a closed cavity.

    The base plate lies on z = 0, the upright along y; the cavity is inside the boss, so the
    solid has two shells.
    """
    base = cq.Workplane("XY").box(80, 50, 10, centered=(False, True, False))
    upright = cq.Workplane("XY").box(10, 50, 60, centered=(False, True, False))
    rib = cq.Workplane("XZ").polyline([(10, 10), (48, 10), (10, 48)]).close().extrude(4, both=True)
    boss = cq.Workplane("XY").box(24, 36, 26, centered=(False, True, False)).translate((54, 0, 0))
    part = base.union(upright).union(rib).union(boss)

    cavity = cq.Workplane("XY").box(12, 20, 14, centered=(False, True, False)).translate((60, 0, 7))
    pocket = cq.Workplane("XY").box(16, 16, 4, centered=(True, True, False)).translate((66, 0, 23))
    slot = cq.Workplane("XY").box(24, 5, 10, centered=(False, True, False)).translate((22, 18, 0))
    keyway = cq.Workplane("XY").box(10, 12, 10, centered=(False, True, False)).translate((0, 0, 50))
    bore = cq.Workplane("XY").center(30, -18).circle(4).extrude(10)
    nut_holes = cq.Workplane("YZ").pushPoints([(-16, 42), (16, 42)]).polygon(6, 9).extrude(10)
    groove = cq.Workplane("XY").box(4, 50, 3, centered=(False, True, False)).translate((49, 0, 0))
    for tool in (cavity, pocket, slot, keyway, bore, nut_holes, groove):
        part = part.cut(tool)
    return part


def write(part: cq.Workplane, path: Path) -> None:
    """Write a STEP file that does not change with the time of writing."""
    solid = part.val()
    if isinstance(solid, cq.Compound):
        (solid,) = solid.Solids()
    cq.exporters.export(cq.Workplane(solid), str(path))
    text = path.read_text()
    text = re.sub(r"(FILE_NAME\('[^']*',')[^']*'", r"\g<1>2026-01-01T00:00:00'", text)
    path.write_text(text)


def main(arguments: list[str]) -> int:
    """Write all parts."""
    folder = Path(arguments[0] if arguments else Path(__file__).parents[1] / "resources/parts")
    folder.mkdir(parents=True, exist_ok=True)
    for make in (bracket,):
        path = folder / f"{make.__name__}.step"
        write(make(), path)
        print(path)
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
