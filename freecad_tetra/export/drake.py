# SPDX-License-Identifier: LGPL-2.1-or-later
"""Drake's compliant bodies: tetrahedra as legacy VTK in metres, and an SDF that uses them."""

from __future__ import annotations

from dataclasses import replace
from os import PathLike
from pathlib import Path
from xml.etree import ElementTree

import numpy as np

from freecad_tetra import export, mass
from freecad_tetra.errors import BadOption
from freecad_tetra.export import elements, robot, sdf, vtk
from freecad_tetra.export.robot import child
from freecad_tetra.labels import group_name
from freecad_tetra.model import TetMesh


def write_drake(
    mesh: TetMesh,
    path: str | PathLike[str],
    *,
    density: float = 1000.0,
    modulus: float = 1e7,
    scale: float = robot.MILLIMETRES,
    name: str = "",
) -> Path:
    """Write an SDF whose collision is compliant hydroelastic, and its ``STEM.vtk`` beside it.

    Tetrahedra whose corners all lie on the skin are divided, see `with_inner_points`.

    Parameters
    ----------
    mesh : TetMesh
    path : path
        Of the SDF.
    density : float
        kg per cubic metre.
    modulus : float
        Hydroelastic modulus, pascal.
    scale : float
        Metres per unit of the model.
    name : str
        Of model and link, the file's stem by default.

    Raises
    ------
    BadOption, UnwritableFile
    """
    for value, label in ((density, "density"), (modulus, "modulus"), (scale, "scale")):
        if not value > 0:
            raise BadOption(f"{label} must be above zero, not {value}", "choose another value")
    file = Path(path)
    tets = file.with_suffix(".vtk")
    full = with_inner_points(mesh)
    grid = elements.elements(replace(full, points=full.points * scale))
    with export.atomic(tets) as stream:
        vtk.write_tets(grid, stream)
    properties = mass.of_surface(mesh.points, mesh.skin).scaled(scale, density)
    body = robot.Body(name or group_name(file.stem), (tets.name,), properties, "")
    root = ElementTree.Element("sdf", {"version": "1.7", "xmlns:drake": "http://drake.mit.edu"})
    link = child(child(root, "model", name=body.name), "link", name=body.name)
    sdf.add_inertial(link, body)
    collision = child(link, "collision", name="tetrahedra")
    child(child(child(collision, "geometry"), "mesh"), "uri", tets.name)
    compliant = child(collision, "drake:proximity_properties")
    child(compliant, "drake:compliant_hydroelastic")
    child(compliant, "drake:hydroelastic_modulus", f"{modulus:.9g}")
    return robot.write_tree(root, file, f" freecad_tetra: {len(mesh)} tetrahedra ")


def with_inner_points(mesh: TetMesh) -> TetMesh:
    """Return the mesh with a point inside each tetrahedron whose corners all lie on the skin.

    Drake's pressure is 0 on the skin and needs a corner inside to be more anywhere. The sides
    stay as they are, so that the tetrahedra still meet face to face.
    """
    on_skin = np.zeros(len(mesh.points), bool)
    on_skin[mesh.skin] = True
    flat = on_skin[mesh.tets].all(axis=1)
    rows = mesh.tets[flat]
    made = len(mesh.points) + np.arange(len(rows))
    quarters = np.repeat(rows[:, None], 4, axis=1)
    quarters[:, np.arange(4), np.arange(4)] = made[:, None]
    return replace(
        mesh,
        points=np.concatenate([mesh.points, mesh.points[rows].mean(axis=1)]),
        tets=np.concatenate([mesh.tets[~flat], quarters.reshape(-1, 4)]),
        tet_solid=np.concatenate([mesh.tet_solid[~flat], np.repeat(mesh.tet_solid[flat], 4)]),
        point_source=np.concatenate([mesh.point_source, np.full(len(rows), -1)]),
    )
