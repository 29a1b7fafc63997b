# SPDX-License-Identifier: LGPL-2.1-or-later
"""What a CalculiX deck that FreeCAD wrote says about loads, and a .dat about reactions."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from freecad_tetra.model import FloatArray

# Corners of CalculiX's sides 1 to 4 in its own order of nodes.
_SIDES = ((0, 1, 2), (0, 3, 1), (1, 3, 2), (2, 3, 0))
_MIDDLE = {(0, 1): 4, (1, 2): 5, (0, 2): 6, (0, 3): 7, (1, 3): 8, (2, 3): 9}
# FreeCAD writes its elements with the corners (2, 1, 3, 4).
_WRITTEN = (1, 0, 2, 3, 4, 6, 5, 8, 7, 9)


@dataclass(frozen=True)
class Loads:
    """The loads of a deck.

    Attributes
    ----------
    force : (3,) float64
        Sum of all nodal forces.
    pressed : tuple of (element, side)
        Sides under pressure, elements from 1, sides 1 to 4.
    """

    force: FloatArray
    pressed: tuple[tuple[int, int], ...]


def read(path: str | Path) -> Loads:
    """Read *CLOAD and *DLOAD of a deck and of the files it includes."""
    force, pressed, card = np.zeros(3), [], ""
    for line in _lines(Path(path)):
        if line.startswith("*"):
            card = line.split(",")[0].upper()
            continue
        words = [word.strip() for word in line.split(",")]
        if card == "*CLOAD" and len(words) >= 3 and words[1] in "123":
            force[int(words[1]) - 1] += float(words[2])
        elif card == "*DLOAD" and len(words) >= 3 and words[1][:1] == "P" and words[0].isdigit():
            pressed.append((int(words[0]), int(words[1][1:])))
    return Loads(force, tuple(pressed))


def _lines(path: Path) -> Any:
    for line in path.read_text(errors="replace").splitlines():
        text = line.strip()
        if not text or text.startswith("**"):
            continue
        if text.upper().startswith("*INCLUDE"):
            name = text.split("=", 1)[1].strip().strip('"')
            yield from _lines(path.parent / name)
        else:
            yield text


def side_nodes(nodes: Any, side: int) -> list[int]:
    """Return the nodes of a side of a tetrahedron, 3 or 6, as triangles have them.

    Parameters
    ----------
    nodes : sequence of 4 or 10 int
        In FreeCAD's order.
    side : int
        1 to 4, as CalculiX counts the sides of the element that FreeCAD writes.
    """
    own = [nodes[i] for i in _WRITTEN[: len(nodes)]]
    a, b, c = _SIDES[side - 1]
    if len(nodes) == 4:
        return [own[a], own[b], own[c]]
    middles = [_MIDDLE[(min(i, j), max(i, j))] for i, j in ((a, b), (b, c), (c, a))]
    return [own[i] for i in (a, b, c, *middles)]


def reactions(path: str | Path) -> dict[str, FloatArray]:
    """Return the total force (3,) of every node set that a .dat file prints, names in capitals."""
    out: dict[str, FloatArray] = {}
    name = ""
    for line in Path(path).read_text(errors="replace").splitlines():
        if "total force" in line:
            name = line.split("for set")[1].split()[0].upper()
        elif name and line.strip():
            out[name] = np.array([float(word) for word in line.split()[:3]])
            name = ""
    return out
