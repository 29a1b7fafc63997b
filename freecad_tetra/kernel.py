# SPDX-License-Identifier: LGPL-2.1-or-later
"""The only door to the compiled module: plain data in, frozen results or typed errors out.

The kernel is imported on first use, so that reading, writing and the rest of the package
work without it. It counts in triangles of its own numbering; here they are brought back to
the caller's triangles and to B-rep faces.
"""

from __future__ import annotations

import importlib
import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from time import perf_counter
from typing import Any

import numpy as np

from freecad_tetra import kernel_file
from freecad_tetra._version import __version__
from freecad_tetra.errors import (
    BadOption,
    Cancelled,
    Defect,
    InvalidPolygon,
    InvalidSolid,
    KernelMissing,
    VerificationFailed,
)
from freecad_tetra.labels import Labels, distinct
from freecad_tetra.model import (
    ConvexCells,
    FloatArray,
    IntArray,
    Report,
    Solid,
    TetMesh,
    frozen_array,
    plain,
    surface_volume,
)

_LARGEST = 1e60  # products of areas, as lengths to the fourth, stay within doubles

Progress = Callable[[str, float], "bool | None"]


def load() -> Any:
    """Return the compiled module of this very version.

    Raises
    ------
    KernelMissing
        It is absent, does not load, or is of another version.
    """
    try:
        module: Any = importlib.import_module("_tetra_kernel")
    except ImportError as error:
        module = kernel_file.bring_in()
        if module is None:
            raise KernelMissing(f"the compiled module does not load: {error}") from error
    found = module.version()
    if found != __version__:
        raise KernelMissing(
            f"_tetra_kernel is version {found}, freecad_tetra is version {__version__}"
        )
    return module


@dataclass(frozen=True, eq=False)
class Validation:
    """What the exact validation says about a solid.

    Attributes
    ----------
    solid : Solid
        As it was given.
    defects : tuple of Defect
        Empty for a valid solid.
    triangles : (m2, 3) int32
        Oriented outward; what will be decomposed.
    triangle_source : (m2,) int32
        Triangle of `solid` that each came from.
    shell, solid_id : (m2,) int32
    turned : tuple of int
        Shells that were inside out.
    counts : mapping of str to int
        vertices, facets, notches, shells, solids, genus, contacts ...
    seconds : float
    """

    solid: Solid
    defects: tuple[Defect, ...]
    triangles: IntArray
    triangle_source: IntArray
    shell: IntArray
    solid_id: IntArray
    turned: tuple[int, ...] = ()
    counts: Mapping[str, int] = field(default_factory=dict)
    seconds: float = 0.0

    def surface(self) -> Solid:
        """Return the oriented triangles that get decomposed, as a Solid.

        Raises
        ------
        InvalidSolid
            When there are defects.
        """
        if self.defects:
            raise InvalidSolid(self.defects)
        return Solid(
            self.solid.vertices,
            self.triangles,
            self.solid.face_ids[self.triangle_source],
            self.solid.face_names,
            self.solid.name,
            self.solid_id,
            self.solid.notes,
            self.labels(),
        )

    def labels(self) -> Labels:
        """Return the caller's names, solids as `solid_id` counts them."""
        given, ids = self.solid.labels, self.solid.solid_ids
        if ids is None or not any(given.solids):
            return Labels((), given.faces)
        numbers, first = np.unique(self.solid_id, return_index=True)
        names = [""] * (int(numbers.max(initial=-1)) + 1)
        for number, triangle in zip(numbers.tolist(), self.triangle_source[first].tolist()):
            source = int(ids[triangle])
            names[number] = given.solids[source] if source < len(given.solids) else ""
        return Labels(distinct(names), given.faces)

    def crosses_itself(self) -> bool:
        """Return whether a finer tessellation may help."""
        return any(d.kind == "self_crossing" for d in self.defects)


def validate(
    solid: Solid,
    options: Mapping[str, Any] | None = None,
    progress: Progress | None = None,
) -> Validation:
    """Check exactly that `solid` bounds one or more solids; O(m log m).

    Parameters
    ----------
    solid : Solid
    options : mapping, optional
        Passed to the kernel.
    progress : callable, optional
        ``progress(stage, fraction)``; returning False cancels.

    Returns
    -------
    Validation
        With the defects; they are not raised.

    Raises
    ------
    KernelMissing, Cancelled
    """
    start = perf_counter()
    given = dict(options or {})
    if solid.solid_ids is not None:
        given.setdefault("solid", solid.solid_ids)
    found = _call("validate", solid, None, solid.vertices, solid.triangles, given, progress)
    source = np.asarray(found["triangle_source"], np.int32)
    defects = [_defect(d, solid, None) for d in found["defects"]]
    return Validation(
        solid=solid,
        defects=tuple(defects or _scale_defects(solid)),
        triangles=np.asarray(found["triangles"], np.int32).reshape(-1, 3),
        triangle_source=source,
        shell=np.asarray(found["shell"], np.int32),
        solid_id=np.asarray(found["solid"], np.int32),
        turned=tuple(int(i) for i in found.get("turned", ())),
        counts={str(k): int(v) for k, v in found.get("counts", {}).items()},
        seconds=perf_counter() - start,
    )


def _scale_defects(solid: Solid) -> list[Defect]:
    """Name a size whose volume, a cube, leaves the range of doubles."""
    if len(solid.vertices) == 0:
        return []
    small = np.abs(solid.vertices).max() <= _LARGEST
    if small and np.ptp(solid.vertices, axis=0).max() >= 1 / _LARGEST:
        return []
    message = f"sizes from {1 / _LARGEST:g} to {_LARGEST:g} can be computed; choose another unit"
    return [Defect("scale_out_of_range", message)]


def convex_cells(
    solid: Solid | Validation,
    options: Mapping[str, Any] | None = None,
    progress: Progress | None = None,
) -> ConvexCells:
    """Partition a solid into convex cells.

    Parameters
    ----------
    solid : Solid or Validation
        A Solid is validated first.
    options : mapping, optional
        ``method`` (auto, bajaj-dey, fences), ``plain``, ``merge``, ``flatness`` (grid steps).
    progress : callable, optional

    Raises
    ------
    InvalidSolid, VerificationFailed, Cancelled, KernelMissing
    """
    checked = _validated(solid, progress)
    start = perf_counter()
    found = _decompose("convex_cells", checked, options, progress)
    facet_source, facet_face = _to_caller(checked, found["facet_source"])
    cells = ConvexCells(
        points=found["points"],
        facet_offsets=found["facet_offsets"],
        facet_vertices=found["facet_vertices"],
        cell_offsets=found["cell_offsets"],
        facet_source=facet_source,
        facet_face=facet_face,
        cell_solid=found["cell_solid"],
        point_source=found["point_source"],
        face_names=checked.solid.face_names,
        labels=checked.labels(),
    )
    report = _report(found["report"], checked, perf_counter() - start)
    return replace(cells, report=_with_volume(report, checked, cells.volumes()))


def tetrahedralize(
    solid: Solid | Validation,
    options: Mapping[str, Any] | None = None,
    progress: Progress | None = None,
) -> TetMesh:
    """Fill a solid with face-to-face tetrahedra.

    Parameters
    ----------
    solid : Solid or Validation
        A Solid is validated first.
    options : mapping, optional
        ``method``, ``direction``, ``pull_off``, ``compact``.
    progress : callable, optional

    Raises
    ------
    InvalidSolid, VerificationFailed, Cancelled, KernelMissing
    """
    checked = _validated(solid, progress)
    start = perf_counter()
    given = dict(options or {})
    if checked.solid.face_names:  # edges between coplanar B-rep faces are kept
        given.setdefault("face_ids", checked.solid.face_ids[checked.triangle_source])
    found = _decompose("tetrahedralize", checked, given, progress)
    skin_source, skin_face = _to_caller(checked, found["skin_source"])
    mesh = TetMesh(
        points=found["points"],
        tets=found["tets"],
        skin=found["skin"],
        skin_face=skin_face,
        skin_source=skin_source,
        skin_twin=found.get("skin_twin"),
        tet_solid=found["tet_solid"],
        point_source=found["point_source"],
        face_names=checked.solid.face_names,
        labels=checked.labels(),
    )
    report = _report(found["report"], checked, perf_counter() - start)
    return replace(mesh, report=_with_volume(report, checked, mesh.volumes()))


def limit_cells(
    cells: ConvexCells, max_cells: int, max_vertices: int, progress: Progress | None = None
) -> dict[str, Any]:
    """Merge convex cells within limits (0: none), as the arrays of the kernel.

    Raises
    ------
    BadOption, Cancelled, KernelMissing
    """
    solid = Solid(cells.points, np.zeros((0, 3), np.int32))
    return _call(
        "limit_cells",
        solid,
        None,
        cells.points,
        cells.facet_offsets,
        cells.facet_vertices,
        cells.facet_source,
        cells.cell_offsets,
        cells.cell_solid,
        max_cells,
        max_vertices,
        progress,
    )


def outer_surface(checked: Validation, progress: Progress | None = None) -> Solid:
    """Return what bounds all solids together: their surface without contacts between them.

    That is what tetrahedra of several solids are bounded by. Planes in contact are divided as
    they are for the tetrahedra, so there may be more vertices than in `checked`; for one solid it
    is ``checked.surface()``.

    Raises
    ------
    InvalidSolid, VerificationFailed, Cancelled, KernelMissing
    """
    whole = checked.surface()
    if whole.solid_ids is None or len(np.unique(whole.solid_ids)) < 2:
        return whole
    found = _call(
        "outer_surface", checked.solid, checked.triangle_source, whole.vertices, whole.triangles,
        whole.solid_ids, progress,
    )  # fmt: skip
    source = np.asarray(found["triangle_source"], np.int64)
    return Solid(
        found["vertices"], found["triangles"], whole.face_ids[source], whole.face_names, whole.name,
        whole.solid_ids[source], whole.notes, whole.labels,
    )  # fmt: skip


def triangulate_polygon(points: Any, loops: Sequence[Any]) -> IntArray:
    """Triangulate a planar polygon with holes, exactly, O(n log n).

    Parameters
    ----------
    points : (n, 2) float64
    loops : sequence of (k,) int
        Ids into `points`; the region is where their parity is odd. They may touch in
        vertices and nowhere else.

    Returns
    -------
    (t, 3) int32
        Counter-clockwise triangles.

    Raises
    ------
    InvalidPolygon, KernelMissing
    """
    return _polygon("triangulate_polygon", points, loops).reshape(-1, 3)


def place_guards(points: Any, loops: Sequence[Any]) -> IntArray:
    """Return vertices that together see a whole polygon with holes, (g,) int32.

    At most floor((n + 2 h) / 3) for n vertices and h holes; parameters and errors are those
    of `triangulate_polygon`, O(n log n).
    """
    return _polygon("place_guards", points, loops)


def _polygon(name: str, points: Any, loops: Sequence[Any]) -> IntArray:
    module = load()
    flat = frozen_array(points, np.float64, (-1, 2))
    rows = [frozen_array(loop, np.int32, (-1,)) for loop in loops]
    try:
        return np.asarray(getattr(module, name)(flat, rows), np.int32)
    except AttributeError as error:
        raise KernelMissing(f"this build of _tetra_kernel has no {name}") from error
    except module.InvalidPolygon as error:
        raise InvalidPolygon(str(error), error.edges, error.points) from error


def _validated(solid: Solid | Validation, progress: Progress | None) -> Validation:
    checked = solid if isinstance(solid, Validation) else validate(solid, None, progress)
    if checked.defects:
        raise InvalidSolid(checked.defects)
    return checked


def _decompose(
    name: str,
    checked: Validation,
    options: Mapping[str, Any] | None,
    progress: Progress | None,
) -> dict[str, Any]:
    return _call(
        name,
        checked.solid,
        checked.triangle_source,
        checked.solid.vertices,
        checked.triangles,
        checked.solid_id,
        dict(options or {}),
        progress,
    )


def _call(name: str, solid: Solid, source: IntArray | None, *arguments: Any) -> dict[str, Any]:
    """Call the kernel and turn its exceptions into those of this package."""
    module = load()
    function = getattr(module, name, None)
    if function is None:
        raise KernelMissing(f"this build of _tetra_kernel has no {name}")
    try:
        result: dict[str, Any] = function(*arguments)
        return result
    except ValueError as error:
        if not str(error).startswith("option "):
            raise  # a callback's own
        raise BadOption(str(error), "choose another value") from error
    except module.InvalidSolid as error:
        rows = getattr(error, "defects", None) or _defects_in(error)
        raise InvalidSolid([_defect(d, solid, source) for d in rows]) from error
    except module.VerificationFailed as error:
        raise VerificationFailed(str(error)) from error
    except module.Cancelled as error:
        raise Cancelled() from error


def _defects_in(error: BaseException) -> list[Mapping[str, Any]]:
    for argument in error.args:
        if isinstance(argument, list | tuple) and argument and isinstance(argument[0], Mapping):
            return list(argument)
    return [{"kind": "invalid_solid", "message": str(error)}]


def _defect(raw: Mapping[str, Any], solid: Solid, source: IntArray | None) -> Defect:
    """Bring a kernel defect back to the caller's triangles and name their faces."""
    triangles = [int(t) for t in raw.get("triangles", ())]
    if source is not None:
        triangles = [int(source[t]) for t in triangles if 0 <= t < len(source)]
    known = [t for t in triangles if 0 <= t < len(solid.face_ids)]
    faces = dict.fromkeys(solid.face_name(int(solid.face_ids[t])) for t in known)
    return Defect(
        str(raw["kind"]),
        str(raw.get("message", "")),
        tuple(int(v) for v in raw.get("vertices", ())),
        tuple(triangles),
        tuple(f for f in faces if f) if solid.face_names else (),
    )


def _to_caller(checked: Validation, source: Any) -> tuple[IntArray, IntArray]:
    """Map validated triangles to (the caller's triangles, their B-rep faces), -1 kept."""
    ids = np.asarray(source, np.int64)
    inner = ids < 0
    triangle = np.where(inner, -1, checked.triangle_source[np.where(inner, 0, ids)])
    face = np.where(inner, -1, checked.solid.face_ids[np.where(inner, 0, triangle)])
    return triangle.astype(np.int32), face.astype(np.int32)


_REPORT_FIELDS = ("method", "direction", "counts", "bounds", "volume", "volume_error", "quality",
                  "repairs", "verdict")  # fmt: skip


def _report(raw: Mapping[str, Any], checked: Validation, seconds: float) -> Report:
    """Gather what validation and kernel told into one report."""
    raw = plain(raw)
    known = {k: raw[k] for k in _REPORT_FIELDS if k in raw}
    known["counts"] = {**checked.counts, **dict(raw.get("counts", {}))}
    notches = known["counts"].get("notches")
    if notches is not None:
        known["bounds"] = {"bajaj_dey": piece_bound(notches), **dict(raw.get("bounds", {}))}
    spent = {"validate": checked.seconds, **dict(raw.get("seconds", {})), "kernel": seconds}
    repairs = {"turned_shells": list(checked.turned), **dict(raw.get("repairs", {}))}
    rest = {k: v for k, v in raw.items() if k not in (*_REPORT_FIELDS, "seconds")}
    rest["surface"] = plain(checked.solid.notes)
    return Report(**{**known, "seconds": spent, "repairs": repairs, "details": rest})


def _with_volume(report: Report, checked: Validation, pieces: FloatArray) -> Report:
    """Add the volume of all pieces and its error against the surface that was given."""
    total = math.fsum(pieces.tolist())
    wanted = surface_volume(checked.solid.vertices, checked.triangles)
    return replace(report, volume=total, volume_error=abs(total - wanted) / abs(wanted or 1.0))


def piece_bound(notches: int) -> int:
    """Return r^2/2 + r/2 + 1, the most pieces that r notches can need (Chazelle 1984)."""
    return notches * (notches + 1) // 2 + 1
