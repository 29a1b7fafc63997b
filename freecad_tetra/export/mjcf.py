# SPDX-License-Identifier: LGPL-2.1-or-later
"""MuJoCo's MJCF: one body whose mesh geoms are the convex cells."""

from __future__ import annotations

from os import PathLike
from pathlib import Path
from xml.etree import ElementTree

from freecad_tetra.export import robot
from freecad_tetra.export.robot import child, numbers
from freecad_tetra.model import ConvexCells


def write_mjcf(
    cells: ConvexCells,
    path: str | PathLike[str],
    *,
    density: float = 1000.0,
    scale: float = robot.MILLIMETRES,
    fixed: bool = False,
    name: str = "",
) -> Path:
    """Write a model that ``mujoco.MjModel.from_xml_path`` loads, and the cells beside it.

    Parameters
    ----------
    cells : ConvexCells
        All solids become one rigid body.
    path : path
        Of the XML; the cells go into the folder ``STEM_cells`` beside it.
    density : float
        kg per cubic metre; mass and inertia are those of the exact volume, whatever was merged.
    scale : float
        Metres per unit of the model.
    fixed : bool
        Whether the body is part of the world; otherwise it has a free joint.
    name : str
        Of model and body, the file's stem by default.

    Raises
    ------
    BadOption, UnwritableFile
    """
    body = robot.body(cells, path, density, scale, name)
    root = ElementTree.Element("mujoco", model=body.name)
    assets = child(root, "asset")
    holder = child(child(root, "worldbody"), "body", name=body.name)
    if not fixed:
        child(holder, "freejoint")
    inertia = robot.upper(body.mass)
    order = ("ixx", "iyy", "izz", "ixy", "ixz", "iyz")
    child(
        holder,
        "inertial",
        pos=numbers(body.mass.centre),
        mass=f"{body.mass.volume:.9g}",
        fullinertia=" ".join(inertia[key] for key in order),
    )
    for mesh in body.meshes:
        part = f"{body.name}_{Path(mesh).stem}"
        # Mass comes from the body; as a shell a mesh may be as small as it likes.
        child(assets, "mesh", name=part, file=mesh, inertia="shell")
        child(holder, "geom", name=part, type="mesh", mesh=part)
    return robot.write_tree(root, path, body.remark)
