# SPDX-License-Identifier: LGPL-2.1-or-later
"""Tetrahedra of good shape by mmg3d, with every B-rep face, edge and vertex kept.

mmg3d takes the edges where B-rep faces meet for lines that it may divide but not leave, and their
ends for corners; between them it follows a smooth surface through the facets (no ridge is guessed
from angles). References carry the faces and solids through. A planar face has one normal, so it
stays planar; the points of curved ones are brought to the CAD afterwards.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any

import numpy as np

from freecad_tetra.errors import VerificationFailed
from freecad_tetra.fem import mmg, skin
from freecad_tetra.fem.project import Project, project_points
from freecad_tetra.fem.quality import quality
from freecad_tetra.fem.smooth import smooth
from freecad_tetra.fem.triangles import face_areas
from freecad_tetra.model import FloatArray, LongArray, TetMesh, rebuilt

SIZE_SHARE = 1 / 12  # of the diagonal
CHORD_SHARE = 1e-3  # of the diagonal
SHARP = np.radians(20.0)  # from here on the turn at a B-rep edge is a ridge
WANTED_DIHEDRAL = np.radians(10.0)  # below it another pass is tried
PASSES = 2
_AREA_SHARE, _VOLUME_SHARE = 0.05, 0.02  # facets of both are off round faces by so much

Told = Callable[[str, float], "bool | None"] | None


@dataclass(frozen=True)
class Sizes:
    """How large the elements get; lengths in the unit of the model.

    Attributes
    ----------
    size : float or None
        Longest edge wanted; None takes `SIZE_SHARE` of the diagonal.
    chord : float or None
        How far a straight edge may stay off a curved surface, which makes elements smaller
        where it bends more; None takes `CHORD_SHARE` of the diagonal.
    turn : float
        Elements in a full turn of a curved face, at least; 0 leaves it to the chord.
    faces : mapping of int to float
        Longest edge on single B-rep faces (0-based).
    growth : float
        Largest ratio of neighbouring edges.
    """

    size: float | None = None
    chord: float | None = None
    turn: float = 0.0
    faces: Mapping[int, float] = field(default_factory=dict)
    growth: float = 1.3


def remesh(
    mesh: TetMesh,
    program: Path,
    sizes: Sizes | None = None,
    project: Project | None = None,
    told: Told = None,
) -> TetMesh:
    """Return the same solids in tetrahedra of good shape.

    Parameters
    ----------
    mesh : TetMesh
        With a face id per skin triangle.
    program : Path
        From `freecad_tetra.fem.mmg.find`.
    sizes : Sizes, optional
    project : Project, optional
        Takes new boundary points to the CAD.
    told : callable, optional
        ``told(stage, fraction)``; returning False cancels.

    Returns
    -------
    TetMesh
        `point_source` and `skin_source` are -1: all is new but corners. ``report.details`` has
        ``remesh`` with what was done.

    Raises
    ------
    RemeshingFailed, Cancelled
    VerificationFailed
        The area of a face changed by more than 5 %, or a volume by more than 2 %.
    """
    wanted = sizes or Sizes()
    size = wanted.size or SIZE_SHARE * diagonal(mesh)
    chord = wanted.chord or CHORD_SHARE * diagonal(mesh)
    options = ["-nr", "-hmax", f"{size:.9g}", "-hausd", f"{chord:.9g}"]
    options += ["-hgrad", f"{wanted.growth:.9g}"]
    local = _local(mesh, wanted, size, chord)
    watch = None if told is None else lambda seconds: told("remesh", 1 - 1 / (1 + seconds / 10))
    made = _settled(_mesh(mesh, mmg.run(program, _tables(mesh), options, local, watch)), project)
    for _ in range(1, PASSES):
        if made.angle >= WANTED_DIHEDRAL:
            break
        other = _again(made.mesh, program, chord, watch, project)
        if other is None or other.angle <= made.angle:
            break
        made = other
    changes = _require_same(mesh, made.mesh)
    details = {"size": size, "chord": chord, "elements_before": len(mesh), "projected": made.moved,
               "unprojected": made.left, "smoothed": made.smoothed, **changes}  # fmt: skip
    report = replace(mesh.report, details={**mesh.report.details, "remesh": details})
    return replace(made.mesh, report=report)


def diagonal(mesh: TetMesh) -> float:
    """Return the diagonal of the bounding box."""
    return float(np.linalg.norm(np.ptp(mesh.points, axis=0)))


@dataclass(frozen=True)
class _Settled:
    """A mesh whose boundary is on the CAD, its least angle, and what was done for it."""

    mesh: TetMesh
    angle: float
    moved: int
    left: int
    smoothed: int


def _settled(mesh: TetMesh, project: Project | None) -> _Settled:
    """Take new boundary points to the CAD, then better the few worst tetrahedra."""
    moved = left = 0
    if project is not None:
        mesh, moved, left = project_points(mesh, project, np.ones(len(mesh.points), bool))
    mesh, smoothed = smooth(mesh, WANTED_DIHEDRAL, project)
    angle = float(quality(mesh).min_dihedral.min())
    return _Settled(mesh, angle, moved, left, smoothed)


def _again(
    mesh: TetMesh, program: Path, chord: float, watch: Any, project: Project | None
) -> _Settled | None:
    """Run mmg for shape alone, at the sizes the mesh has; None when that fails."""
    options = ["-nr", "-optim", "-hausd", f"{chord:.9g}"]
    try:
        return _settled(_mesh(mesh, mmg.run(program, _tables(mesh), options, "", watch)), project)
    except mmg.RemeshingFailed:
        return None


def _tables(mesh: TetMesh) -> dict[str, Any]:
    """Return the sections of the Medit file; references are ids plus one."""
    triangles = np.hstack([mesh.skin + 1, mesh.skin_face[:, None] + 1])
    # A triangle between two solids stands in the skin of both and is written once.
    _, first = np.unique(np.sort(mesh.skin, axis=1), axis=0, return_index=True)
    edges, ridges, corners = feature_lines(mesh)
    return {
        "Vertices": mesh.points,
        "Triangles": triangles[np.sort(first)],
        "Tetrahedra": np.hstack([mesh.tets + 1, mesh.tet_solid[:, None] + 1]),
        "Edges": edges + 1,
        "Ridges": ridges + 1,
        "Corners": corners + 1,
    }


def feature_lines(mesh: TetMesh) -> tuple[LongArray, LongArray, LongArray]:
    """Return what of a skin has to stay: B-rep edges, the sharp ones, B-rep vertices.

    Returns
    -------
    edges : (e, 3) int64
        Ends, and the number of the set of faces that meet there.
    ridges : (r,) int64
        Rows of `edges` where the surface turns by more than `SHARP`, or more than two sheets meet.
    corners : (c,) int64
        Points where three faces meet, or where lines end or branch.
    """
    table = skin.skin_edges(mesh.skin)
    groups = skin.faces_of_edges(table, mesh.skin_face)
    number = np.full(len(table.ends), -1, np.int64)
    for k, (faces, rows) in enumerate(groups.items()):
        if len(faces) > 1:
            number[rows] = k
    number[(number < 0) & (table.count != 2)] = len(groups)
    rows = np.flatnonzero(number >= 0)
    sharp = _turns(mesh, table)[rows] > SHARP
    edges = np.hstack([table.ends[rows], number[rows, None]])
    degree = np.bincount(edges[:, :2].reshape(-1), minlength=len(mesh.points))
    met = skin.faces_of_points(mesh.skin, mesh.skin_face)
    many = [points for faces, points in met.items() if len(faces) > 2]
    corners = np.union1d(
        np.concatenate(many) if many else np.zeros(0, np.int64),
        np.flatnonzero((degree != 2) & (degree > 0)),
    )
    return edges, np.flatnonzero(sharp).astype(np.int64), corners.astype(np.int64)


def _turns(mesh: TetMesh, table: skin.SkinEdges) -> FloatArray:
    """Return the angle between the normals at each edge, pi where not two triangles meet."""
    p = mesh.points[mesh.skin]
    normal = np.cross(p[:, 1] - p[:, 0], p[:, 2] - p[:, 0])
    index = table.of_triangle.reshape(-1)
    order = np.argsort(index, kind="stable")
    start = np.cumsum(table.count) - table.count
    owner = np.repeat(np.arange(len(mesh.skin)), 3)[order]
    pair = table.count == 2
    a, b = normal[owner[start[pair]]], normal[owner[start[pair] + 1]]
    angle = np.full(len(table.ends), np.pi)
    sine = np.linalg.norm(np.cross(a, b), axis=1)
    angle[pair] = np.arctan2(sine, np.einsum("ij,ij->i", a, b))
    return angle


def _local(mesh: TetMesh, wanted: Sizes, size: float, chord: float) -> str:
    """Return mmg's parameter file with sizes per face, empty when all are alike."""
    rows = {}
    if wanted.turn > 0:
        share = 1 - np.cos(np.pi / wanted.turn)
        for face, radius in face_radii(mesh).items():
            if share * radius < chord:
                rows[face] = (size, share * radius)
    for face, own in wanted.faces.items():
        rows[face] = (own, rows.get(face, (0.0, chord))[1])
    if not rows:
        return ""
    lines = [
        f"{face + 1} Triangle {0.01 * min(own, size):.9g} {own:.9g} {sag:.9g}"
        for face, (own, sag) in sorted(rows.items())
    ]
    return "\n".join(["Parameters", str(len(lines)), *lines, ""])


def face_radii(mesh: TetMesh) -> dict[int, float]:
    """Return a radius of curvature of every curved face, from the turns between its facets.

    The lower tenth over the edges inside a face of (mean height of the two triangles over the
    edge) / (angle between them), so a single bad facet does not decide.
    """
    table = skin.skin_edges(mesh.skin)
    inner = skin.faces_of_edges(table, mesh.skin_face)
    turn = _turns(mesh, table)
    corners = mesh.points[mesh.skin]
    double = np.linalg.norm(
        np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]), axis=1
    )
    length = np.linalg.norm(mesh.points[table.ends[:, 1]] - mesh.points[table.ends[:, 0]], axis=1)
    index = table.of_triangle.reshape(-1)
    order = np.argsort(index, kind="stable")
    start = np.cumsum(table.count) - table.count
    owner = np.repeat(np.arange(len(mesh.skin)), 3)[order]
    out = {}
    for faces, rows in inner.items():
        bent = rows[(table.count[rows] == 2) & (turn[rows] > 1e-3)]
        if len(faces) > 1 or not len(bent):
            continue
        heights = double[owner[start[bent]]] + double[owner[start[bent] + 1]]
        radius = heights / (2 * length[bent] * turn[bent])
        out[faces[0]] = float(np.quantile(radius, 0.1))
    return out


def _mesh(mesh: TetMesh, found: mmg.Table) -> TetMesh:
    """Turn mmg's tables into a mesh, its skin rebuilt and matched with the references."""
    tets, solid = found["Tetrahedra"][:, :4] - 1, found["Tetrahedra"][:, 4] - 1
    used, tets = np.unique(tets, return_inverse=True)
    tets = tets.reshape(-1, 4)
    back = np.full(len(found["Vertices"]), -1, np.int64)
    back[used] = np.arange(len(used))
    rows, _ = skin.skin_of(tets, solid)
    given = np.sort(back[found["Triangles"][:, :3] - 1], axis=1)
    _, index = np.unique(
        np.concatenate([given, np.sort(rows, axis=1)]), axis=0, return_inverse=True
    )
    index = index.reshape(-1)
    place = np.full(int(index.max()) + 1, -1, np.int64)
    place[index[: len(given)]] = found["Triangles"][:, 3] - 1
    face = place[index[len(given) :]]
    if (face < 0).any():
        raise mmg.RemeshingFailed(f"mmg3d lost the face of {int((face < 0).sum())} triangles")
    points = found["Vertices"][used, :3]
    return rebuilt(
        mesh, points, tets, solid, rows, face, np.full(len(rows), -1), np.full(len(points), -1)
    )


def _require_same(before: TetMesh, after: TetMesh) -> dict[str, float]:
    """Return the largest change of volume and of a face's area, or refuse."""
    volumes = [np.bincount(m.tet_solid, m.volumes()) for m in (before, after)]
    if len(volumes[0]) != len(volumes[1]):
        raise VerificationFailed("remeshing lost a solid", "try a smaller size")
    volume = float(np.abs(volumes[1] / np.where(volumes[0] > 0, volumes[0], 1) - 1).max())
    old, new = face_areas(before), face_areas(after)
    change = {f: abs(new.get(f, 0.0) / a - 1) for f, a in old.items() if a > 0}
    worst = max(change, key=lambda f: change[f], default=-1)
    if volume > _VOLUME_SHARE:
        raise VerificationFailed(
            f"remeshing changed the volume by {volume:.2%}", "try a smaller size"
        )
    if worst >= 0 and change[worst] > _AREA_SHARE:
        name = before.face_names[worst] if before.face_names else str(worst)
        raise VerificationFailed(
            f"remeshing changed the area of {name} by {change[worst]:.2%}", "try a smaller size"
        )
    return {"volume_change": volume, "largest_area_change": change.get(worst, 0.0)}
