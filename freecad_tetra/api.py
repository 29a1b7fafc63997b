# SPDX-License-Identifier: LGPL-2.1-or-later
"""The functions of the package, for any kind of input.

Everything optional (OCP, trimesh, the kernel) is imported by the call that needs it.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import replace
from os import PathLike, fspath
from pathlib import Path
from typing import Any

from freecad_tetra import brep, directions, kernel, limits
from freecad_tetra.brep import fill
from freecad_tetra.errors import (
    BadOption,
    Cancelled,
    Defect,
    InvalidSolid,
    TetraError,
    UnsupportedFormat,
)
from freecad_tetra.kernel import Progress, Validation
from freecad_tetra.model import ConvexCells, IntArray, Solid, Tet10Mesh, TetMesh

# A tessellation whose volume strays more than this from the B-rep's is made finer.
VOLUME_SHARE = 0.01
RETRIES = 3
# How much finer (chord height, angle) for each reason: a crossing needs both, a volume that is
# off comes from chords of thin round walls, where the angle alone is much cheaper.
FINER = {"self_crossing": (0.5, 0.5), "volume": (1.0, 0.45)}


def as_solid(
    source: Any,
    *,
    linear_deflection: float | None = None,
    relative_deflection: float | None = None,
    angular_deflection: float | None = None,
    solid: int | None = None,
    name: str = "",
) -> Solid:
    """Turn any supported input into one triangulated Solid, without validating it.

    Parameters
    ----------
    source : path, Solid, shape, trimesh or (vertices, triangles)
        A shape is a cadquery or build123d object, a sequence of them, an OCP
        ``TopoDS_Shape``, or inside FreeCAD a ``Part.Shape``; a trimesh is a ``Trimesh`` or a
        ``Scene``. The names of parts, labels and tags go into ``labels``.
    linear_deflection : float, optional
        Chord height in mm; overrides `relative_deflection`.
    relative_deflection : float, optional
        Chord height as a share of the bounding box's diagonal, 0.001 by default.
    angular_deflection : float, optional
        Degrees between neighbouring chords, 20 by default.
    solid : int, optional
        1-based number of the one B-rep solid wanted.
    name : str
        Name of the result; a file's stem by default.

    Raises
    ------
    InvalidSolid, UnreadableFile, UnsupportedFormat, MissingDependency
    """
    wanted = _deflection(linear_deflection, relative_deflection, angular_deflection)
    shape = shape_of(source)
    if shape is not None:
        return shape.tessellate(wanted, only=solid, name=name or shape.name)
    return _mesh(source, name)


def validate(
    source: Any,
    *,
    linear_deflection: float | None = None,
    relative_deflection: float | None = None,
    angular_deflection: float | None = None,
    solid: int | None = None,
    progress: Progress | None = None,
) -> Validation:
    """Check exactly that an input bounds one or more solids.

    Parameters are those of `as_solid`. A B-rep whose tessellation crosses itself is
    tessellated finer, up to three times; so is one whose volume is more than 1 % off,
    when no deflection was asked for. ``result.solid.notes`` tells.

    Returns
    -------
    Validation
        ``defects`` is empty for a valid solid; they are not raised.

    Raises
    ------
    InvalidSolid, UnreadableFile, UnsupportedFormat, MissingDependency, KernelMissing, Cancelled
    """
    if isinstance(source, Validation):
        return source
    wanted = _deflection(linear_deflection, relative_deflection, angular_deflection)
    free = linear_deflection is relative_deflection is angular_deflection is None
    _stage(progress, "read")
    shape = shape_of(source)
    if shape is None:
        return _choose(kernel.validate(_mesh(source, ""), None, progress), solid)
    return _validate_shape(shape, wanted, free, solid, progress)


def convex_cells(
    source: Any,
    *,
    method: str = "auto",
    plain: bool = False,
    merge: bool = True,
    flatness: int | None = None,
    max_cells: int | None = None,
    max_vertices: int | None = None,
    progress: Progress | None = None,
    **reading: Any,
) -> ConvexCells:
    """Partition a solid into convex cells that cover it exactly once.

    Parameters
    ----------
    source : see `as_solid`
    method : {"auto", "bajaj-dey", "fences"}
    plain : bool
        Cut each notch by a plane of its own, as in Chazelle's rule.
    merge : bool
        Merge neighbours whose union is convex.
    flatness : int, optional
        Grid steps within which facets of one plane count as coplanar.
    max_cells, max_vertices : int, optional
        Limits of a physics engine: cells are merged into hulls that cover the part and no
        longer partition it, at an error that is reported; see `freecad_tetra.limits.limit`.
        With method "auto" several partitions are merged, and the one that errs least is taken.
    progress : callable, optional
        ``progress(stage, fraction)``; returning False cancels.
    **reading
        Deflections and `solid` as in `as_solid`.

    Raises
    ------
    InvalidSolid, VerificationFailed, Cancelled, KernelMissing
        and the errors of `as_solid`.
    """
    options: dict[str, Any] = {"method": method, "plain": plain, "merge": merge}
    if flatness is not None:
        options["flatness"] = flatness
    found = validate(source, progress=progress, **reading)
    cells = kernel.convex_cells(found, options, progress)
    if max_cells is None and max_vertices is None:
        return cells
    if method == "auto":
        return limits.least_error(found, cells, max_cells, max_vertices, progress)
    return limits.limit(cells, max_cells, max_vertices, progress)


def tetrahedralize(
    source: Any,
    *,
    method: str = "chazelle-palios",
    direction: str | Sequence[int] = "auto",
    pull_off: str = "auto",
    compact: str = "default",
    improve: bool = False,
    progress: Progress | None = None,
    **reading: Any,
) -> TetMesh:
    """Fill a solid with face-to-face tetrahedra that keep its boundary exactly.

    Several solids that touch give one mesh: where they meet in planes, or share faces of the
    B-rep, both have the same nodes and triangles (`TetMesh.skin_twin`), whatever their
    tessellations were.

    Parameters
    ----------
    source : see `as_solid`
    method : {"chazelle-palios", "bajaj-dey"}
        Pull-off and fences (Chazelle and Palios 1990), or the convex cells of notch cutting,
        overlaid and coned (Bajaj and Dey 1990, 3).
    direction : "auto", "x", "y", "z" or three integers
        Direction of the fences; of chazelle-palios only, as `pull_off`.
    pull_off : {"auto", "on", "off"}
    compact : {"default", "max", "off"}
    improve : bool
        Better the shape of the worst tetrahedra by flips; they get a few more.
    progress : callable, optional
    **reading
        Deflections and `solid` as in `as_solid`.

    Raises
    ------
    InvalidSolid, VerificationFailed, Cancelled, KernelMissing
        and the errors of `as_solid`.
    """
    axis = direction if isinstance(direction, str) else [int(i) for i in direction]
    found = validate(source, progress=progress, **reading)
    options: dict[str, Any] = {"method": method, "direction": axis}
    options.update(pull_off=pull_off, compact=compact)
    if improve:
        options["quality"] = True
    # Of a bare mesh the kernel finds large planes itself, when it does not do with an axis.
    if axis == "auto" and not found.defects and found.solid.face_names:
        options["directions"] = directions.candidates(found.surface())
    return kernel.tetrahedralize(found, options, progress)


def fem_mesh(
    source: Any,
    *,
    order: int = 2,
    quality: bool = False,
    size: float | None = None,
    chord: float | None = None,
    turn: float = 0.0,
    face_sizes: Mapping[str, float] | None = None,
    refine: int = 0,
    shape: Any = None,
    progress: Progress | None = None,
    **options: Any,
) -> TetMesh | Tet10Mesh:
    """Mesh a solid for analysis; boundary nodes lie on the B-rep, quality is in the report.

    Parameters
    ----------
    source : see `as_solid`
        A `Validation` has forgotten its B-rep: pass it as `shape`, or nodes stay on the facets.
    order : {1, 2}
        Straight tetrahedra, or curved ones with a node amid every edge.
    quality : bool
        Rebuild the elements by the optional program mmg3d.
    size : float, optional
        Longest edge; by default an eighth of the diagonal, with `quality` a twelfth. 0 without
        `quality` leaves the elements as they are.
    chord, turn, face_sizes
        For `quality`, see `freecad_tetra.fem.remesh.Sizes`; faces by name, such as ``Face3``.
    refine : int
        How often every element is divided into eight.
    progress : callable, optional
    **options
        Those of `tetrahedralize`.

    Raises
    ------
    BadOption, MissingDependency, RemeshingFailed
        and the errors of `tetrahedralize`.
    """
    from freecad_tetra.fem.prepare import FemOptions, prepare
    from freecad_tetra.fem.remesh import Sizes

    checked = isinstance(source, Validation)
    named = shape_of(source if shape is None and not checked else shape)
    reading = {name: options.pop(name) for name in _READING if name in options}
    known = checked or named is None
    found = validate(source if known else named, progress=progress, **reading)
    mesh = tetrahedralize(found, progress=progress, **{"improve": True, **options})
    faces = _face_numbers(mesh, face_sizes or {})
    wanted = FemOptions(order, quality, Sizes(size, chord, turn, faces), refine)
    project = None if named is None else brep.projector(named.shape)
    return prepare(mesh, wanted, project, progress)


_READING = ("linear_deflection", "relative_deflection", "angular_deflection", "solid")


def _face_numbers(mesh: TetMesh, sizes: Mapping[str, float]) -> dict[int, float]:
    known = {name: i for i, name in enumerate(mesh.face_names)}
    lost = [name for name in sizes if name not in known]
    if lost:
        raise BadOption(f"there is no face {lost[0]}", f"choose Face1 to Face{len(known)}")
    return {known[name]: float(value) for name, value in sizes.items()}


def triangulate_polygon(points: Any, loops: Sequence[Any] | None = None) -> IntArray:
    """Triangulate a planar polygon with holes, exactly; see `freecad_tetra.kernel`.

    Parameters
    ----------
    points : (n, 2) float64
    loops : sequence of (k,) int, optional
        Ids into `points`; by default all points form one loop.

    Returns
    -------
    (t, 3) int32
    """
    return kernel.triangulate_polygon(points, _loops(points, loops))


def place_guards(points: Any, loops: Sequence[Any] | None = None) -> IntArray:
    """Return vertices of a polygon with holes that together see all of it, (g,) int32.

    Parameters are those of `triangulate_polygon`; at most floor((n + 2 h) / 3) guards for n
    vertices and h holes.
    """
    return kernel.place_guards(points, _loops(points, loops))


def _loops(points: Any, loops: Sequence[Any] | None) -> Sequence[Any]:
    return [range(len(points))] if loops is None else loops


def check(
    source: Any, path: str | PathLike[str], *, progress: Progress | None = None, **reading: Any
) -> dict[str, Any]:
    """Verify a result file (.obj or .vtu) against the solid that it decomposes.

    Returns
    -------
    dict
        Figures of the check.

    Raises
    ------
    VerificationFailed, UnreadableFile, InvalidSolid and the errors of `as_solid`
    """
    from freecad_tetra import verify
    from freecad_tetra.io import results

    stored = results.read_result(path)
    found = validate(source, progress=progress, **reading)
    if isinstance(stored, results.StoredTets):
        surface = kernel.outer_surface(found, progress)
        return verify.check_tets(surface, stored.points, stored.tets, progress)
    return verify.check_cells(found.surface(), stored.points, stored.cells, progress)


def write(
    result: ConvexCells | TetMesh | Tet10Mesh | Solid, path: str | PathLike[str], order: int = 1
) -> Path:
    """Write a result to a file, whole or not at all; see `freecad_tetra.export.write`."""
    from freecad_tetra import export

    return export.write(result, path, order)


def _deflection(
    linear: float | None, relative: float | None, angular: float | None
) -> brep.Deflection:
    for value, label in ((linear, "linear"), (relative, "relative"), (angular, "angular")):
        if value is not None and not (value > 0 and math.isfinite(value)):
            raise TetraError(f"the {label} deflection must be above zero, not {value}")
    share = 0.001 if relative is None else relative
    return brep.Deflection(linear, share, math.radians(20.0 if angular is None else angular))


def _stage(progress: Progress | None, stage: str) -> None:
    if progress is not None and progress(stage, 0.0) is False:
        raise Cancelled()


def shape_of(source: Any) -> brep.Shape | None:
    """Return the B-rep shape of a file or CAD object, None for meshes."""
    if isinstance(source, brep.Shape):
        return source
    if isinstance(source, str | PathLike):
        path = Path(fspath(source))
        if path.suffix.lower() in brep.SUFFIXES:
            return brep.Shape(brep.read_shape(path), path.stem)
        return None
    return brep.as_named(source)


def _mesh(source: Any, name: str) -> Solid:
    """Return the Solid of a mesh file, a trimesh or its scene, a Solid or (vertices, triangles)."""
    if isinstance(source, Solid):
        return source
    if isinstance(source, str | PathLike):
        from freecad_tetra import io

        return io.read_mesh(fspath(source), split=_split)
    if hasattr(source, "geometry") and hasattr(source, "graph"):  # trimesh.Scene
        from freecad_tetra.adapters import trimesh

        return _welded(trimesh.solid_of_scene(source), name)
    if not callable(getattr(source, "vertices", len)) and hasattr(source, "faces"):  # Trimesh
        return _arrays(source.vertices, source.faces, name)
    if isinstance(source, Sequence) and len(source) == 2:
        return _arrays(source[0], source[1], name)
    raise UnsupportedFormat(
        f"cannot make a solid of {type(source).__name__}",
        "pass a path, a CAD shape, a trimesh or (vertices, triangles)",
    )


def _arrays(vertices: Any, triangles: Any, name: str) -> Solid:
    return _welded(Solid(vertices, triangles), name)


def _welded(solid: Solid, name: str) -> Solid:
    """Merge vertices with equal coordinates."""
    from freecad_tetra.io import weld

    return replace(solid, triangles=weld.merged(solid.vertices, solid.triangles), name=name)


def _split(points: Any, loop: Any) -> IntArray:
    """Triangulate one non-convex polygon of a mesh file."""
    return kernel.triangulate_polygon(points, [loop])


def _validate_shape(
    shape: brep.Shape,
    wanted: brep.Deflection,
    free: bool,
    only: int | None,
    progress: Progress | None,
) -> Validation:
    """Validate a tessellation, finer while it crosses itself or strays in volume."""
    reasons: list[str] = []
    found: Validation | None = None
    while True:
        _stage(progress, "tessellate")
        try:
            solid = shape.tessellate(wanted, only=only)
        except InvalidSolid:
            if found is None:
                raise
            return found  # finer is more than OpenCascade can do
        chord = float(solid.notes.get("linear_deflection", 0.0))
        solid = fill.filled(solid, kernel.triangulate_polygon, chord)
        found = kernel.validate(_noted(solid, reasons), None, progress)
        reason = _why_finer(found, free)
        if not reason or len(reasons) == RETRIES:
            return found
        reasons.append(reason)
        wanted = wanted.finer(*FINER[reason])


def _noted(solid: Solid, reasons: Sequence[str]) -> Solid:
    notes = {**solid.notes, "retries": len(reasons), "retried_for": list(reasons)}
    return replace(solid, notes=notes)


def _why_finer(found: Validation, free: bool) -> str:
    """Return why a finer tessellation is wanted, or an empty string."""
    if found.crosses_itself():
        return "self_crossing"
    volume = found.solid.notes.get("brep_volume", 0.0)
    judged = free and not found.defects and volume > 0
    strays = judged and abs(abs(found.solid.volume()) / volume - 1) > VOLUME_SHARE
    return "volume" if strays else ""


def _choose(found: Validation, number: int | None) -> Validation:
    """Return the validation of one solid of a mesh, `number` 1-based."""
    if number is None or found.defects:
        return found
    count = int(found.solid_id.max()) + 1 if len(found.solid_id) else 0
    if not 1 <= number <= count:
        raise InvalidSolid(
            [Defect("no_solid", f"there is no solid {number}, the mesh has {count}")],
            next_step=f"choose a solid from 1 to {count}",
        )
    keep = found.triangle_source[found.solid_id == number - 1]
    solid = found.solid
    part = replace(
        solid,
        triangles=solid.triangles[keep],
        face_ids=solid.face_ids[keep],
        solid_ids=None if solid.solid_ids is None else solid.solid_ids[keep],
    )
    return kernel.validate(part)
