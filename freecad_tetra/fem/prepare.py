# SPDX-License-Identifier: LGPL-2.1-or-later
"""From tetrahedra that fill a solid to a mesh for analysis, with its quality told.

The order is: better elements, refinement, boundary points to the CAD, second order.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path
from time import perf_counter
from typing import Any

from freecad_tetra.errors import Cancelled, MissingDependency
from freecad_tetra.fem import mmg
from freecad_tetra.fem import project as projecting
from freecad_tetra.fem import quality as measuring
from freecad_tetra.fem import remesh as remeshing
from freecad_tetra.fem.bisect import bisect
from freecad_tetra.fem.refine import refine
from freecad_tetra.fem.room import make_room
from freecad_tetra.fem.second_order import Curving, second_order
from freecad_tetra.model import Tet10Mesh, TetMesh

MOST_ROUNDS = 4  # of making room below the curved boundary
SIZE_SHARE = 1 / 8  # of the diagonal: the longest edge when none is asked for

Told = Callable[[str, float], "bool | None"] | None


@dataclass(frozen=True)
class FemOptions:
    """What a mesh for analysis shall be.

    Attributes
    ----------
    order : {1, 2}
    quality : bool
        Rebuild the elements by mmg.
    sizes : Sizes
        Without `quality` only its size counts, by bisection; 0 leaves the elements as they are.
    refine : int
        How often every element is divided into eight.
    packages : tuple of path
        Folders where mmgpy may be, besides those of this Python.
    """

    order: int = 2
    quality: bool = False
    sizes: remeshing.Sizes = field(default_factory=remeshing.Sizes)
    refine: int = 0
    packages: tuple[str | Path, ...] = ()


def prepare(
    mesh: TetMesh,
    options: FemOptions | None = None,
    project: projecting.Project | None = None,
    told: Told = None,
) -> TetMesh | Tet10Mesh:
    """Return the mesh for analysis.

    Parameters
    ----------
    mesh : TetMesh
    options : FemOptions, optional
    project : Project, optional
        Nearest points on the B-rep; without it the facets are the boundary.
    told : callable, optional
        ``told(stage, fraction)``; returning False cancels.

    Returns
    -------
    TetMesh or Tet10Mesh
        ``report.quality`` is that of `freecad_tetra.fem.quality`, ``report.details["fem"]`` says
        what was done and ``report.details["warnings"]`` what to think of it.

    Raises
    ------
    MissingDependency, RemeshingFailed, VerificationFailed, Cancelled
    """
    wanted = options or FemOptions()
    start = perf_counter()
    done: dict[str, Any] = {"order": wanted.order, "refined": wanted.refine}
    if wanted.quality:
        program = _require_mmg(mesh, wanted.packages)
        _tell(told, "remesh", 0.0)
        mesh = remeshing.remesh(mesh, program, wanted.sizes, project, told)
    elif project is not None:
        _tell(told, "project", 0.0)
        mesh, done["projected_points"], done["unprojected_points"] = projecting.project_points(
            mesh, project
        )
    if not wanted.quality and wanted.sizes.size != 0:
        _tell(told, "bisect", 0.0)
        mesh = bisect(mesh, wanted.sizes.size or SIZE_SHARE * remeshing.diagonal(mesh), project)
    for step in range(wanted.refine):
        _tell(told, "refine", step / wanted.refine)
        mesh = refine(mesh, project)
    made: TetMesh | Tet10Mesh = mesh
    curving = Curving()
    if wanted.order == 2:
        _tell(told, "second_order", 0.0)
        made, curving, done["rounds_for_room"] = _curved(mesh, project)
        done["curved_middles"] = curving.curved
        done["straightened_middles"] = curving.straightened
        done["unprojected_middles"] = curving.unprojected
        done["straightened_faces"] = [_name(mesh, f) for f in curving.faces]
    _tell(told, "quality", 0.0)
    return _reported(made, done, perf_counter() - start)


def _curved(mesh: TetMesh, project: projecting.Project | None) -> tuple[Tet10Mesh, Curving, int]:
    """Return the mesh of second order, divided inside where the curved boundary needs room."""
    made, curving = second_order(mesh, project)
    rounds = 0
    while curving.straightened and rounds < MOST_ROUNDS:
        mesh = make_room(mesh, curving.unbearing)
        roomier, then = second_order(mesh, project)
        if then.straightened >= curving.straightened:
            break
        made, curving, rounds = roomier, then, rounds + 1
    return made, curving, rounds


def _require_mmg(mesh: TetMesh, packages: Sequence[str | Path]) -> Path:
    """Return the program, or say what the mesh is like without it."""
    program = mmg.find(packages)
    if program is None:
        least = measuring.quality(mesh).to_dict()["min_dihedral_degrees"]
        raise MissingDependency(
            "mmg3d",
            f"quality (without it the least dihedral angle is {least:.2g} degrees)",
            "mmgpy",
        )
    return program


def _reported(mesh: TetMesh | Tet10Mesh, done: dict[str, Any], seconds: float) -> Any:
    found = measuring.quality(mesh).to_dict()
    report = mesh.report
    details = {**report.details, "fem": done, "warnings": warnings(found, done)}
    counts = {**report.counts, "tets": len(mesh), "points": len(mesh.points),
              "skin_triangles": len(mesh.skin)}  # fmt: skip
    spent = {**report.seconds, "fem": seconds}
    return replace(
        mesh,
        report=replace(report, quality=found, details=details, counts=counts, seconds=spent),
    )


def warnings(quality: dict[str, Any], done: dict[str, Any]) -> list[str]:
    """Return in plain sentences what an analyst has to know before the solver runs."""
    out = []
    if quality.get("nonpositive_jacobians"):
        out.append(
            f"{quality['nonpositive_jacobians']} elements have a Jacobian that is not positive: "
            "a solver refuses them"
        )
    if quality.get("below_good_dihedral"):
        out.append(
            f"{quality['below_good_dihedral']} of {quality['elements']} elements have a dihedral "
            f"angle below {measuring.GOOD_DIHEDRAL:g} degrees (least "
            f"{quality['min_dihedral_degrees']:.2g}): stresses beside them are poor; "
            "ask for quality"
        )
    if done.get("straightened_middles"):
        faces = done["straightened_faces"]
        out.append(
            f"{done['straightened_middles']} middle nodes stay on their chord, off the CAD, on "
            f"{_some(faces)}; ask for quality or a finer tessellation"
        )
    return out


def _some(names: Sequence[str], limit: int = 8) -> str:
    rest = len(names) - limit
    return ", ".join(names[:limit]) + (f" and {rest} more faces" if rest > 0 else "")


def _name(mesh: TetMesh, face: int) -> str:
    return mesh.face_names[face] if mesh.face_names else str(face)


def _tell(told: Told, stage: str, fraction: float) -> None:
    if told is not None and told(stage, fraction) is False:
        raise Cancelled()
