# SPDX-License-Identifier: LGPL-2.1-or-later
"""Pieces ready for drawing: facets with their piece, B-rep face and the piece's quality."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from freecad_tetra.errors import TetraError
from freecad_tetra.export import pieces
from freecad_tetra.model import ConvexCells, FloatArray, IntArray, LongArray, TetMesh


@dataclass(frozen=True, eq=False)
class Scene:
    """Convex pieces as polygons.

    Attributes
    ----------
    points : (p, 3) float64
    offsets : (F + 1,) int64
        Facet f has the corners ``corners[offsets[f]:offsets[f + 1]]``, counter-clockwise from
        outside its piece.
    corners : (...,) int32
    piece : (F,) int32
        Increasing.
    face : (F,) int32
        B-rep face, -1 inside the solid and where no faces are known.
    quality : (pieces,) float64
        From 0, flat, to 1, regular: of tetrahedra the mean ratio, of other cells the
        isoperimetric quotient, which is 1 for a ball.
    kind : {"cells", "tetrahedra"}
    """

    points: FloatArray
    offsets: LongArray
    corners: IntArray
    piece: IntArray
    face: IntArray
    quality: FloatArray
    kind: str

    def loop(self, facet: int) -> FloatArray:
        """Return the points of a facet, (k, 3) float64."""
        return self.points[self.corners[self.offsets[facet] : self.offsets[facet + 1]]]


def scene_of(result: ConvexCells | TetMesh) -> Scene:
    """Return the pieces of a result, O(size).

    Raises
    ------
    TetraError
        There are no pieces.
    """
    tets = isinstance(result, TetMesh)
    cells = pieces.as_cells(result) if isinstance(result, TetMesh) else result
    if not len(cells):
        raise TetraError("there are no pieces to show", "choose another solid")
    return Scene(
        points=cells.points,
        offsets=cells.facet_offsets,
        corners=cells.facet_vertices,
        piece=np.repeat(np.arange(len(cells)), np.diff(cells.cell_offsets)).astype(np.int32),
        face=cells.facet_face,
        quality=mean_ratios(result.points[result.tets])
        if isinstance(result, TetMesh)
        else roundness(cells),
        kind="tetrahedra" if tets else "cells",
    )


def mean_ratios(corners: FloatArray) -> FloatArray:
    """Return 12 (3 V)^(2/3) / sum of squared edges of tetrahedra (t, 4, 3); 1 when regular.

    Liu and Joe 1994.
    """
    a, b, c = (corners[:, i] - corners[:, 0] for i in (1, 2, 3))
    volume = np.abs(np.einsum("ij,ij->i", a, np.cross(b, c))) / 6
    pairs = [(0, 1), (0, 2), (0, 3), (1, 2), (1, 3), (2, 3)]
    edges = sum(((corners[:, i] - corners[:, j]) ** 2).sum(axis=1) for i, j in pairs)
    ratios: FloatArray = 12 * np.cbrt(3 * volume) ** 2 / np.maximum(edges, 1e-300)
    return ratios


def roundness(cells: ConvexCells) -> FloatArray:
    """Return 36 pi V^2 / A^3 of every cell, 1 for a ball, (C,) float64."""
    triangles, facet = cells.fans()
    corners = cells.points[triangles]
    vectors = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    owner = np.repeat(np.arange(len(cells)), np.diff(cells.cell_offsets))[facet]
    area = np.bincount(owner, np.linalg.norm(vectors, axis=1) / 2, minlength=len(cells))
    quotient: FloatArray = 36 * np.pi * cells.volumes() ** 2 / np.maximum(area, 1e-300) ** 3
    return np.clip(quotient, 0, 1)


def middles(scene: Scene) -> FloatArray:
    """Return the middle of the box of every piece, (pieces, 3) float64."""
    corners = scene.points[scene.corners]
    starts = scene.offsets[np.searchsorted(scene.piece, np.arange(len(scene.quality)))]
    low, high = (f.reduceat(corners, starts, axis=0) for f in (np.minimum, np.maximum))
    return np.asarray((low + high) / 2)


def clipped(scene: Scene, normal: Any, height: float) -> Scene:
    """Return what is left of the pieces below a plane, each closed by a facet in the plane.

    Parameters
    ----------
    scene : Scene
    normal : (3,) float
        Points to the side that goes.
    height : float
        Of the plane along `normal`.

    Raises
    ------
    TetraError
        Nothing is left.
    """
    unit = np.asarray(normal, np.float64)
    loops: list[FloatArray] = []
    owner: list[int] = []
    face: list[int] = []
    for k in range(len(scene.quality)):
        first, last = np.searchsorted(scene.piece, [k, k + 1])
        cut: list[FloatArray] = []
        for f in range(int(first), int(last)):
            loop, ends = _clip(scene.loop(f), unit, height)
            cut += ends
            if len(loop) > 2:
                loops.append(loop)
                owner.append(k)
                face.append(int(scene.face[f]))
        if len(cut) > 2 and owner and owner[-1] == k:
            loops.append(_ring(np.array(cut), unit))
            owner.append(k)
            face.append(-1)
    if not loops:
        raise TetraError("nothing is left in front of the cut", "cut at another height")
    kept, piece = np.unique(owner, return_inverse=True)
    points = np.concatenate(loops)
    return replace(
        scene,
        points=points,
        offsets=np.append(0, np.cumsum([len(loop) for loop in loops])),
        corners=np.arange(len(points), dtype=np.int32),
        piece=piece.reshape(-1).astype(np.int32),
        face=np.array(face, np.int32),
        quality=scene.quality[kept],
    )


def _clip(loop: FloatArray, normal: FloatArray, height: float) -> tuple[Any, list[FloatArray]]:
    """Return the part of a convex loop below a plane, and its points in the plane."""
    side = loop @ normal - height
    kept: list[FloatArray] = []
    ends: list[FloatArray] = []
    for i in range(len(loop)):
        j = (i + 1) % len(loop)
        if side[i] <= 0:
            kept.append(loop[i])
            if side[i] == 0:
                ends.append(loop[i])
        if (side[i] < 0) != (side[j] < 0) and side[i] != 0 and side[j] != 0:
            t = side[i] / (side[i] - side[j])
            ends.append(loop[i] + t * (loop[j] - loop[i]))
            kept.append(ends[-1])
    return np.array(kept).reshape(-1, 3), ends


def _ring(points: FloatArray, normal: FloatArray) -> FloatArray:
    """Return the corners of a convex polygon in order, counter-clockwise seen along -normal."""
    x = np.cross(normal, np.eye(3)[int(np.argmin(np.abs(normal)))])
    around = points - points.mean(axis=0)
    angle = np.arctan2(around @ np.cross(normal, x), around @ x)
    return points[np.argsort(angle, kind="stable")]
