# SPDX-License-Identifier: LGPL-2.1-or-later
"""What every robot format needs: collision files, mass properties, names and numbers as text."""

from __future__ import annotations

import os
from collections.abc import Iterable
from dataclasses import dataclass
from os import PathLike
from pathlib import Path
from xml.etree import ElementTree

from freecad_tetra import export, mass
from freecad_tetra.errors import BadOption
from freecad_tetra.export import parts
from freecad_tetra.labels import group_name
from freecad_tetra.mass import MassProperties
from freecad_tetra.model import ConvexCells

MILLIMETRES = 0.001


@dataclass(frozen=True)
class Body:
    """A rigid body ready for writing, in metres and kilograms.

    Attributes
    ----------
    name : str
    meshes : tuple of str
        Collision files, relative to the robot file, with ``/``.
    mass : MassProperties
        Mass, centre of mass and inertia about it.
    remark : str
        What a reader of the file should know.
    """

    name: str
    meshes: tuple[str, ...]
    mass: MassProperties
    remark: str


def body(
    cells: ConvexCells, path: str | PathLike[str], density: float, scale: float, name: str
) -> Body:
    """Write the collision files into the folder ``STEM_cells`` beside `path`; return the body.

    Raises
    ------
    BadOption, UnwritableFile
    """
    for value, label in ((density, "density"), (scale, "scale")):
        if not value > 0:
            raise BadOption(f"{label} must be above zero, not {value}", "choose another value")
    file = Path(path)
    folder = file.with_name(f"{file.stem}_cells")
    written = parts.write_parts(cells, folder, ".obj", scale)
    return Body(
        name or group_name(file.stem),
        tuple(f"{folder.name}/{mesh.name}" for mesh in written),
        mass.of_cells(cells).scaled(scale, density),
        _remark(cells, len(cells) - len(written), scale),
    )


def _remark(cells: ConvexCells, thin: int, scale: float) -> str:
    limits = cells.report.details.get("limits")
    error = limits["hull_error"] * scale if limits else 0.0
    exact = "exact convex cells" if not error else f"convex hulls, at most {error:.3g} m too large"
    left_out = f"; {thin} flat cells left out" if thin else ""
    return f" freecad_tetra: {len(cells) - thin} {exact}{left_out} "


def numbers(values: Iterable[float]) -> str:
    """Return numbers in 9 digits, parted by blanks."""
    return " ".join(f"{v:.9g}" for v in values)


def upper(properties: MassProperties) -> dict[str, str]:
    """Return ixx, ixy, ixz, iyy, iyz and izz as URDF and SDF name them."""
    axes = "xyz"
    return {
        f"i{axes[i]}{axes[j]}": f"{properties.inertia[i, j]:.9g}"
        for i in range(3)
        for j in range(i, 3)
    }


def write_tree(root: ElementTree.Element, path: str | PathLike[str], remark: str) -> Path:
    """Write an indented XML file, whole or not at all."""
    root.insert(0, ElementTree.Comment(remark.replace("--", "-")))
    ElementTree.indent(root)
    with export.atomic(path) as stream:
        stream.write(b'<?xml version="1.0" encoding="utf-8"?>\n')
        stream.write(ElementTree.tostring(root, encoding="utf-8") + b"\n")
    return Path(os.fspath(path))


def child(
    parent: ElementTree.Element, tag: str, text: str = "", **attributes: str
) -> ElementTree.Element:
    """Return a new element below `parent`."""
    made = ElementTree.SubElement(parent, tag, attributes)
    made.text = text or None
    return made
