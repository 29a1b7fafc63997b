# SPDX-License-Identifier: LGPL-2.1-or-later
"""The frozen values that travel through the package: a solid in, cells or tetrahedra out.

All indices are 0-based, lengths are in the unit of the model (mm for B-rep files).
Arrays are C-contiguous and read-only. Nothing here knows FreeCAD, OCC or the kernel.
"""

from __future__ import annotations

import json
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from typing import Any

import numpy as np
import numpy.typing as npt

from freecad_tetra.conversions import CellConversions, TetConversions
from freecad_tetra.errors import Defect, InvalidSolid
from freecad_tetra.labels import Labels

FloatArray = npt.NDArray[np.float64]
IntArray = npt.NDArray[np.int32]
LongArray = npt.NDArray[np.int64]

__all__ = [
    "Cell", "ConvexCells", "Defect", "Labels", "Report", "Solid", "Tet10Mesh", "TetMesh",
    "frozen_array", "rebuilt",
]  # fmt: skip


def frozen_array(values: Any, dtype: Any, shape: tuple[int, ...]) -> npt.NDArray[Any]:
    """Return a read-only C-contiguous copy of `values`.

    Parameters
    ----------
    values : array_like
    dtype : numpy dtype
    shape : tuple of int
        Required shape, -1 for any length.

    Raises
    ------
    InvalidSolid
        With a ``bad_shape`` defect when the values do not fit.
    """
    try:
        source = np.asarray(values)
        if source.size == 0:
            source = source.reshape([max(0, n) if i else 0 for i, n in enumerate(shape)])
        whole = np.issubdtype(dtype, np.integer)
        if whole and source.dtype.kind == "f" and not np.array_equal(source, np.rint(source)):
            raise ValueError("indices must be whole numbers")
        if whole and source.size and source.dtype.kind in "iuf":
            info = np.iinfo(dtype)
            if source.max() > info.max or source.min() < info.min:
                raise ValueError("an index is too large")
        array = np.array(source, dtype=dtype, order="C", copy=True)
    except (TypeError, ValueError, OverflowError) as error:
        raise InvalidSolid([Defect("bad_shape", f"array not understood: {error}")]) from error
    if array.ndim != len(shape) or any(w not in (-1, n) for w, n in zip(shape, array.shape)):
        wanted = "(" + ", ".join("n" if w < 0 else str(w) for w in shape) + ")"
        raise InvalidSolid(
            [Defect("bad_shape", f"an array of shape {wanted} is needed, not {array.shape}")]
        )
    array.flags.writeable = False
    return array


def _freeze(instance: Any, name: str, dtype: Any, *shape: int) -> None:
    object.__setattr__(instance, name, frozen_array(getattr(instance, name), dtype, shape))


@dataclass(frozen=True, eq=False)
class Solid:
    """A triangulated surface that should bound one or more solids; not yet validated.

    Attributes
    ----------
    vertices : (n, 3) float64
        The caller's coordinates, kept bit for bit.
    triangles : (m, 3) int32
        Counter-clockwise seen from outside.
    face_ids : (m,) int32
        B-rep face of each triangle, an index into `face_names`; without names the index
        of the input polygon. Empty: every triangle is a polygon of its own.
    face_names : tuple of str
        ``Face1``, ``Face2``, ... as FreeCAD numbers them; empty for meshes.
    name : str
    solid_ids : (m,) int32 or None
        B-rep solid of each triangle; None when the surface itself has to tell.
    notes : mapping
        How the surface was made (deflections, retries, volume of the B-rep).
    labels : Labels
        Names that the caller gave to solids (as `solid_ids` count) and to groups of faces.
    """

    vertices: FloatArray
    triangles: IntArray
    face_ids: IntArray = field(default_factory=lambda: np.zeros(0, np.int32))
    face_names: tuple[str, ...] = ()
    name: str = ""
    solid_ids: IntArray | None = None
    notes: Mapping[str, Any] = field(default_factory=dict)
    labels: Labels = field(default_factory=Labels)

    def __post_init__(self) -> None:
        _freeze(self, "vertices", np.float64, -1, 3)
        _freeze(self, "triangles", np.int32, -1, 3)
        count = len(self.triangles)
        if len(self.face_ids) == 0:
            object.__setattr__(self, "face_ids", np.arange(count, dtype=np.int32))
        _freeze(self, "face_ids", np.int32, -1)
        if self.solid_ids is not None:
            _freeze(self, "solid_ids", np.int32, -1)
            if len(self.solid_ids) != count:
                raise InvalidSolid([Defect("bad_shape", "solid_ids needs one id per triangle")])
        if len(self.face_ids) != count:
            raise InvalidSolid([Defect("bad_shape", "face_ids needs one id per triangle")])
        bad = (self.triangles < 0) | (self.triangles >= len(self.vertices))
        if bad.any():
            rows = np.flatnonzero(bad.any(axis=1))
            raise InvalidSolid(
                [
                    Defect(
                        "bad_index",
                        f"{len(rows)} triangles name a vertex that does not exist",
                        triangles=tuple(int(i) for i in rows[:100]),
                    )
                ]
            )

    def face_name(self, face: int) -> str:
        """Return the name of a B-rep face, or of an input polygon of a mesh."""
        if 0 <= face < len(self.face_names):
            return self.face_names[face]
        return "" if self.face_names or face < 0 else f"polygon {face}"

    def volume(self) -> float:
        """Return the signed volume by the divergence theorem, O(m)."""
        return surface_volume(self.vertices, self.triangles)

    def diagonal(self) -> float:
        """Return the length of the bounding box's diagonal."""
        if not len(self.vertices):
            return 0.0
        return float(np.linalg.norm(self.vertices.max(0) - self.vertices.min(0)))


def surface_volume(vertices: FloatArray, triangles: npt.NDArray[Any]) -> float:
    """Return the signed volume enclosed by oriented `triangles`, O(m)."""
    if not len(triangles):
        return 0.0
    corners = vertices[triangles] - vertices[triangles[0, 0]]
    cross = np.cross(corners[:, 1], corners[:, 2])
    return float(np.einsum("ij,ij->", corners[:, 0], cross) / 6.0)


@dataclass(frozen=True)
class Report:
    """What was done, how long it took and how good the result is.

    Attributes
    ----------
    method, direction : str
    seconds : mapping of str to float
        Per stage.
    counts : mapping of str to int
        Vertices, facets, notches, Steiner points by carrier, pieces ...
    bounds : mapping of str to int
        The papers' bounds on the pieces.
    volume, volume_error : float
        Model unit cubed; the error is relative to the input surface.
    quality : mapping
        Histogram and extremes.
    repairs : mapping
        What was repaired on the way out, and what was said by validation.
    details : mapping
        Everything else the kernel told.
    verdict : str
        ``verified`` when the kernel's own check held.
    """

    method: str = ""
    direction: str = ""
    seconds: Mapping[str, float] = field(default_factory=dict)
    counts: Mapping[str, int] = field(default_factory=dict)
    bounds: Mapping[str, int] = field(default_factory=dict)
    volume: float = 0.0
    volume_error: float = 0.0
    quality: Mapping[str, Any] = field(default_factory=dict)
    repairs: Mapping[str, Any] = field(default_factory=dict)
    details: Mapping[str, Any] = field(default_factory=dict)
    defects: tuple[Defect, ...] = ()
    verdict: str = ""

    def to_dict(self) -> dict[str, Any]:
        """Return plain JSON types."""
        names = [f for f in self.__dataclass_fields__ if f != "defects"]
        out = {name: plain(getattr(self, name)) for name in names}
        out["defects"] = [d.to_dict() for d in self.defects]
        return out

    def to_json(self) -> str:
        """Return the report as indented JSON."""
        return json.dumps(self.to_dict(), indent=1)


def plain(value: Any) -> Any:
    """Turn numpy scalars, arrays, tuples and mappings into plain JSON types."""
    if value is None or type(value) in (int, str, bool):
        return value
    if isinstance(value, Mapping):
        return {str(k): plain(v) for k, v in value.items()}
    if isinstance(value, np.ndarray):
        return [plain(v) for v in value.tolist()]
    if isinstance(value, np.generic):
        return plain(value.item())
    if isinstance(value, list | tuple | set | frozenset):
        return [plain(v) for v in value]
    if isinstance(value, float) and not np.isfinite(value):
        return None
    return value


@dataclass(frozen=True, eq=False)
class Cell:
    """One convex cell with its own points.

    Attributes
    ----------
    points : (k, 3) float64
    facets : tuple of (j,) int32
        Loops into `points`, counter-clockwise seen from outside.
    """

    points: FloatArray
    facets: tuple[IntArray, ...]

    def triangles(self) -> IntArray:
        """Return the facets as fans, (t, 3) int32."""
        rows = [(f[0], f[i], f[i + 1]) for f in self.facets for i in range(1, len(f) - 1)]
        return np.array(rows, dtype=np.int32).reshape(-1, 3)

    def volume(self) -> float:
        """Return the volume, O(points)."""
        return surface_volume(self.points, self.triangles())


@dataclass(frozen=True, eq=False)
class ConvexCells(CellConversions):
    """A partition of a solid into closed convex polyhedra.

    Attributes
    ----------
    points : (p, 3) float64
    facet_offsets : (F + 1,) int64
        Facet f has the loop ``facet_vertices[facet_offsets[f]:facet_offsets[f + 1]]``.
    facet_vertices : (...,) int32
    cell_offsets : (C + 1,) int64
        Cell k has the facets ``cell_offsets[k] .. cell_offsets[k + 1] - 1``.
    facet_source : (F,) int32
        An input triangle whose plane carries the facet, -1 inside the solid.
    facet_face : (F,) int32
        B-rep face (index into `face_names`) of the facet, -1 inside the solid.
    cell_solid : (C,) int32
    point_source : (p,) int32
        Input vertex, or -1 for a point that was made.
    face_names : tuple of str
    report : Report
    labels : Labels
        Names that the caller gave to solids and to groups of faces.
    """

    points: FloatArray
    facet_offsets: LongArray
    facet_vertices: IntArray
    cell_offsets: LongArray
    facet_source: IntArray
    facet_face: IntArray
    cell_solid: IntArray
    point_source: IntArray
    face_names: tuple[str, ...] = ()
    report: Report = field(default_factory=Report)
    labels: Labels = field(default_factory=Labels)

    def __post_init__(self) -> None:
        _freeze(self, "points", np.float64, -1, 3)
        for name in ("facet_offsets", "cell_offsets"):
            _freeze(self, name, np.int64, -1)
        for name in ("facet_vertices", "facet_source", "facet_face", "cell_solid", "point_source"):
            _freeze(self, name, np.int32, -1)

    def __len__(self) -> int:
        return max(0, len(self.cell_offsets) - 1)

    def facet(self, index: int) -> IntArray:
        """Return the loop of one facet as global point ids."""
        return self.facet_vertices[self.facet_offsets[index] : self.facet_offsets[index + 1]]

    def cell_facets(self, k: int) -> range:
        """Return the facet ids of cell `k`."""
        return range(int(self.cell_offsets[k]), int(self.cell_offsets[k + 1]))

    def cell(self, k: int) -> Cell:
        """Return cell `k` with its points renumbered from 0."""
        if not -len(self) <= k < len(self):
            raise IndexError(f"cell {k} of {len(self)}")
        loops = [self.facet(f) for f in self.cell_facets(k % len(self))]
        ids = np.unique(np.concatenate(loops))
        return Cell(
            self.points[ids], tuple(np.searchsorted(ids, f).astype(np.int32) for f in loops)
        )

    def __iter__(self) -> Iterator[Cell]:
        return (self.cell(k) for k in range(len(self)))

    def fans(self) -> tuple[LongArray, LongArray]:
        """Return every facet as a fan: triangles (t, 3) and their facet ids (t,), O(t)."""
        sizes = np.diff(self.facet_offsets) - 2
        facet = np.repeat(np.arange(len(sizes)), sizes)
        start = self.facet_offsets[:-1][facet]
        step = np.arange(len(facet)) - np.repeat(np.cumsum(sizes) - sizes, sizes)
        corners = np.stack([start, start + step + 1, start + step + 2], axis=1)
        return self.facet_vertices[corners].astype(np.int64), facet.astype(np.int64)

    def volumes(self) -> FloatArray:
        """Return the volume of every cell, (C,) float64, O(size)."""
        if not len(self):
            return np.zeros(0)
        triangles, facet = self.fans()
        cell_of_facet = np.repeat(np.arange(len(self)), np.diff(self.cell_offsets))
        cell = cell_of_facet[facet]
        first = self.facet_offsets[self.cell_offsets[:-1]]
        origin = self.points[self.facet_vertices[first]][cell]
        a, b, c = (self.points[triangles[:, i]] - origin for i in range(3))
        parts = np.einsum("ij,ij->i", a, np.cross(b, c)) / 6.0
        return np.bincount(cell, weights=parts, minlength=len(self)).astype(np.float64)


@dataclass(frozen=True, eq=False)
class TetMesh(TetConversions):
    """Face-to-face tetrahedra that fill a solid.

    Attributes
    ----------
    points : (p, 3) float64
    tets : (t, 4) int32
        Positively oriented: det(b - a, c - a, d - a) > 0.
    skin : (s, 3) int32
        Triangles of the boundary of each solid, counter-clockwise seen from its outside.
        Where two solids touch, a triangle comes twice, once for each with its own face:
        groups per face are complete for every solid.
    skin_face : (s,) int32
        B-rep face of each skin triangle, an index into `face_names`.
    skin_source : (s,) int32
        Input triangle that carries the skin triangle.
    skin_twin : (s,) int32
        Row of the skin triangle of the touching solid with the same corners, or -1: the rows
        of -1 are the outer skin of all solids together.
    tet_solid : (t,) int32
    point_source : (p,) int32
        Input vertex, or -1 for a Steiner point.
    face_names : tuple of str
    report : Report
    labels : Labels
        Names that the caller gave to solids and to groups of faces.
    """

    points: FloatArray
    tets: IntArray
    skin: IntArray
    skin_face: IntArray
    skin_source: IntArray
    tet_solid: IntArray
    point_source: IntArray
    face_names: tuple[str, ...] = ()
    report: Report = field(default_factory=Report)
    skin_twin: IntArray | None = None
    labels: Labels = field(default_factory=Labels)

    def __post_init__(self) -> None:
        _freeze(self, "points", np.float64, -1, 3)
        _freeze(self, "tets", np.int32, -1, 4)
        _freeze(self, "skin", np.int32, -1, 3)
        if self.skin_twin is None:
            object.__setattr__(self, "skin_twin", _twins(self.skin))
        for name in ("skin_face", "skin_source", "skin_twin", "tet_solid", "point_source"):
            _freeze(self, name, np.int32, -1)

    def __len__(self) -> int:
        return len(self.tets)

    def volumes(self) -> FloatArray:
        """Return the volume of every tetrahedron, (t,) float64."""
        p = self.points[self.tets]
        a, b, c = (p[:, i] - p[:, 0] for i in (1, 2, 3))
        return np.einsum("ij,ij->i", a, np.cross(b, c)) / 6.0


def _twins(skin: IntArray) -> IntArray:
    """Return for each triangle the row of the other one with the same corners, or -1, (s,)."""
    _, name, count = np.unique(np.sort(skin, axis=1), axis=0, return_inverse=True,
                               return_counts=True)  # fmt: skip
    order = np.argsort(name.reshape(-1), kind="stable")
    paired = order[count[name.reshape(-1)[order]] == 2].reshape(-1, 2)
    twin = np.full(len(skin), -1, np.int32)
    twin[paired[:, 0]], twin[paired[:, 1]] = paired[:, 1], paired[:, 0]
    return twin


def rebuilt(
    mesh: TetMesh, points: Any, tets: Any, tet_solid: Any, skin: Any, skin_face: Any,
    skin_source: Any, point_source: Any,
) -> TetMesh:  # fmt: skip
    """Return a mesh of the same solid with other elements; names and report are kept."""
    return TetMesh(
        points, tets, skin, skin_face, skin_source, tet_solid, point_source, mesh.face_names,
        mesh.report, labels=mesh.labels,
    )  # fmt: skip


@dataclass(frozen=True, eq=False)
class Tet10Mesh:
    """A tetrahedron mesh of second order, whose sides and edges may be curved.

    Attributes
    ----------
    points : (p, 3) float64
        The corners, numbered as in the straight mesh, then the nodes in the middle of edges.
    tets : (t, 10) int32
        Corners, then the middles of 01, 12, 20, 03, 13, 23.
    skin : (s, 6) int32
        Corners, counter-clockwise seen from outside, then the middles of 01, 12, 20.
    skin_face, skin_source, tet_solid, face_names, report, labels
        As in `TetMesh`.
    point_source : (p,) int32
        Input vertex, or -1 for a Steiner point or a middle.
    """

    points: FloatArray
    tets: IntArray
    skin: IntArray
    skin_face: IntArray
    skin_source: IntArray
    tet_solid: IntArray
    point_source: IntArray
    face_names: tuple[str, ...] = ()
    report: Report = field(default_factory=Report)
    labels: Labels = field(default_factory=Labels)

    def __post_init__(self) -> None:
        _freeze(self, "points", np.float64, -1, 3)
        _freeze(self, "tets", np.int32, -1, 10)
        _freeze(self, "skin", np.int32, -1, 6)
        for name in ("skin_face", "skin_source", "tet_solid", "point_source"):
            _freeze(self, name, np.int32, -1)

    def __len__(self) -> int:
        return len(self.tets)
