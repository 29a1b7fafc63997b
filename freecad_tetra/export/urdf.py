# SPDX-License-Identifier: LGPL-2.1-or-later
"""URDF: one link whose collision geometry are the convex cells."""

from __future__ import annotations

from os import PathLike
from pathlib import Path
from xml.etree import ElementTree

from freecad_tetra.export import robot
from freecad_tetra.export.robot import child, numbers
from freecad_tetra.model import ConvexCells


def write_urdf(
    cells: ConvexCells,
    path: str | PathLike[str],
    *,
    density: float = 1000.0,
    scale: float = robot.MILLIMETRES,
    name: str = "",
    package: str = "",
) -> Path:
    """Write a robot of one link, with the cells as collision and visual meshes beside it.

    Parameters
    ----------
    cells, path, density, scale, name
        As of `freecad_tetra.export.mjcf.write_mjcf`.
    package : str
        ROS package of the files: they are then named ``package://PACKAGE/...``.

    Raises
    ------
    BadOption, UnwritableFile
    """
    body = robot.body(cells, path, density, scale, name)
    prefix = f"package://{package}/" if package else ""
    root = ElementTree.Element("robot", name=body.name)
    link = child(root, "link", name=body.name)
    inertial = child(link, "inertial")
    child(inertial, "origin", xyz=numbers(body.mass.centre), rpy="0 0 0")
    child(inertial, "mass", value=f"{body.mass.volume:.9g}")
    child(inertial, "inertia", **robot.upper(body.mass))
    for kind in ("visual", "collision"):
        for mesh in body.meshes:
            holder = child(link, kind, name=f"{Path(mesh).stem}_{kind}")
            child(child(holder, "geometry"), "mesh", filename=prefix + mesh)
    return robot.write_tree(root, path, body.remark)
