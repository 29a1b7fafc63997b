# SPDX-License-Identifier: LGPL-2.1-or-later
"""SDFormat, which Gazebo and Drake read: one link whose collisions are the convex cells."""

from __future__ import annotations

from os import PathLike
from pathlib import Path
from xml.etree import ElementTree

from freecad_tetra.export import robot
from freecad_tetra.export.robot import child, numbers
from freecad_tetra.model import ConvexCells


def write_sdf(
    cells: ConvexCells,
    path: str | PathLike[str],
    *,
    density: float = 1000.0,
    scale: float = robot.MILLIMETRES,
    fixed: bool = False,
    name: str = "",
) -> Path:
    """Write a model of one link, with the cells as collision and visual meshes beside it.

    Parameters are those of `freecad_tetra.export.mjcf.write_mjcf`; `fixed` makes it static.

    Raises
    ------
    BadOption, UnwritableFile
    """
    body = robot.body(cells, path, density, scale, name)
    root = ElementTree.Element("sdf", version="1.7")
    model = child(root, "model", name=body.name)
    child(model, "static", "true" if fixed else "false")
    link = child(model, "link", name=body.name)
    add_inertial(link, body)
    for kind in ("visual", "collision"):
        for mesh in body.meshes:
            holder = child(link, kind, name=f"{Path(mesh).stem}_{kind}")
            shape = child(child(holder, "geometry"), "mesh")
            child(shape, "uri", mesh)
            # Drake takes a hull for what it is only when told so.
            child(shape, "drake:declare_convex")
    root.set("xmlns:drake", "http://drake.mit.edu")
    return robot.write_tree(root, path, body.remark)


def add_inertial(link: ElementTree.Element, body: robot.Body) -> None:
    """Add mass, centre of mass and inertia to a link."""
    inertial = child(link, "inertial")
    child(inertial, "pose", numbers([*body.mass.centre, 0, 0, 0]))
    child(inertial, "mass", f"{body.mass.volume:.9g}")
    inertia = child(inertial, "inertia")
    for key, value in robot.upper(body.mass).items():
        child(inertia, key, value)
