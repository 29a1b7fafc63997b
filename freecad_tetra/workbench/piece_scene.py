# SPDX-License-Identifier: LGPL-2.1-or-later
"""Pieces as a light Coin scene: one shape node in which every piece is a part of its own.

FreeCAD's own face node highlights and picks by part, so a piece is preselected and selected
whole, and drawing pieces apart is one write of the coordinates. Nothing here knows documents.
"""

from __future__ import annotations

import colorsys
from dataclasses import dataclass
from typing import Any

import numpy as np
from pivy import coin

from freecad_tetra.model import ConvexCells, FloatArray, LongArray, TetMesh
from freecad_tetra.workbench.piece_centres import centres

# Faces of a positive tetrahedron, counter-clockwise seen from outside, and its edges.
TET_FACES = np.array([[0, 2, 1], [0, 1, 3], [1, 2, 3], [0, 3, 2]])
TET_EDGES = np.array([[0, 1], [0, 2], [0, 3], [1, 2], [1, 3], [2, 3]])
GOLDEN_RATIO = 0.6180339887498949


@dataclass(frozen=True)
class Drawing:
    """Arrays of a scene; no vertex belongs to two pieces.

    Attributes
    ----------
    points : (v, 3) float64
    piece : (v,) int64
        Piece of each vertex, ascending.
    triangles : (t, 3) int64
        Ids into `points`, ordered by piece, counter-clockwise seen from outside.
    parts : (pieces,) int64
        How many triangles each piece has.
    edges : (e, 2) int64
        Ids into `points`.
    shifts : (v, 3) float64
        How each vertex moves when pieces are drawn apart by the factor 1.
    """

    points: FloatArray
    piece: LongArray
    triangles: LongArray
    parts: LongArray
    edges: LongArray
    shifts: FloatArray


def drawing(pieces: ConvexCells | TetMesh) -> Drawing:
    """Return the arrays that show the pieces, O(size log size)."""
    if isinstance(pieces, TetMesh):
        corner, piece, triangles, edges = _of_tets(pieces)
    else:
        corner, piece, triangles, edges = _of_cells(pieces)
    count = len(pieces)
    middle = centres(pieces)
    shifts = (middle - middle.mean(axis=0))[piece] if count else np.zeros((0, 3))
    parts = np.bincount(piece[triangles[:, 0]], minlength=count).astype(np.int64)
    return Drawing(pieces.points[corner], piece, triangles, parts, edges, shifts)


def _of_tets(mesh: TetMesh) -> tuple[LongArray, LongArray, LongArray, LongArray]:
    """Return (corner of each vertex, its piece, triangles, edges)."""
    first = 4 * np.arange(len(mesh), dtype=np.int64)[:, None, None]
    corner = mesh.tets.astype(np.int64).ravel()
    piece = np.repeat(np.arange(len(mesh), dtype=np.int64), 4)
    return corner, piece, (first + TET_FACES).reshape(-1, 3), (first + TET_EDGES).reshape(-1, 2)


def _of_cells(cells: ConvexCells) -> tuple[LongArray, LongArray, LongArray, LongArray]:
    """Return (corner of each vertex, its piece, triangles, edges)."""
    fans, facet = cells.fans()
    cell_of_facet = np.repeat(np.arange(len(cells), dtype=np.int64), np.diff(cells.cell_offsets))
    stride = max(1, len(cells.points))
    size = np.diff(cells.facet_offsets)
    tail = np.arange(len(cells.facet_vertices))
    last = np.repeat(cells.facet_offsets[1:] - 1, size)
    head = np.where(tail == last, np.repeat(cells.facet_offsets[:-1], size), tail + 1)
    loops = np.stack([cells.facet_vertices[tail], cells.facet_vertices[head]], axis=1)
    by_fan = cell_of_facet[facet][:, None] * stride + fans
    by_edge = np.sort(np.repeat(cell_of_facet, size)[:, None] * stride + loops, axis=1)
    by_edge = np.unique(by_edge, axis=0)
    keys = np.unique(by_fan)
    triangles = np.searchsorted(keys, by_fan)
    return keys % stride, keys // stride, triangles, np.searchsorted(keys, by_edge)


def colours(count: int) -> list[tuple[float, float, float]]:
    """Return colours of `count` pieces; consecutive ones lie far apart on the circle of hues."""
    tones = [(0.55, 0.92), (0.70, 0.80), (0.40, 0.98)]
    found = []
    for k in range(count):
        saturation, value = tones[k % len(tones)]
        hue = (0.12 + k * GOLDEN_RATIO) % 1.0
        found.append(colorsys.hsv_to_rgb(hue, saturation, value))
    return found


class Scene:
    """The nodes of one object's pieces; `root` goes into its view provider."""

    def __init__(self) -> None:
        self.root = coin.SoSeparator()
        self._coordinates = coin.SoCoordinate3()
        self._normals = coin.SoNormal()
        self._material = coin.SoMaterial()
        self._faces = coin.SoType.fromName("SoBrepFaceSet").createInstance()
        self._lines = coin.SoIndexedLineSet()
        self._line_colour = coin.SoBaseColor()
        self._line_style = coin.SoDrawStyle()
        self._line_switch = coin.SoSwitch()
        self._drawing: Drawing | None = None
        self._build()

    def _build(self) -> None:
        hints = coin.SoShapeHints()
        hints.vertexOrdering = coin.SoShapeHints.COUNTERCLOCKWISE
        hints.shapeType = coin.SoShapeHints.SOLID
        by_part = coin.SoMaterialBinding()
        by_part.value = coin.SoMaterialBinding.PER_PART
        by_face = coin.SoNormalBinding()
        by_face.value = coin.SoNormalBinding.PER_FACE
        behind = coin.SoPolygonOffset()  # so that lines are seen on the faces they bound
        for node in (self._coordinates, self._lines_below(), hints, by_part, by_face, behind):
            self.root.addChild(node)
        for node in (self._material, self._normals, self._faces):
            self.root.addChild(node)

    def _lines_below(self) -> Any:
        """Return the switch with the edges, which are seen but never picked."""
        group = coin.SoSeparator()
        flat = coin.SoLightModel()
        flat.model = coin.SoLightModel.BASE_COLOR
        no_pick = coin.SoPickStyle()
        no_pick.style = coin.SoPickStyle.UNPICKABLE
        for node in (flat, no_pick, self._line_style, self._line_colour, self._lines):
            group.addChild(node)
        self._line_switch.addChild(group)
        self._line_switch.whichChild = coin.SO_SWITCH_ALL
        return self._line_switch

    def show(self, pieces: ConvexCells | TetMesh | None, factor: float) -> None:
        """Show other pieces, drawn apart by `factor`; None shows nothing."""
        if pieces is None:
            self._drawing = None
            for field in (self._faces.coordIndex, self._lines.coordIndex):
                field.setNum(0)
            self._part_field().setNum(0)
            return
        self._drawing = drawing(pieces)
        self._set_topology(self._drawing)
        self.explode(factor)

    def explode(self, factor: float) -> None:
        """Draw the pieces apart by a factor, 0 leaves them in place, O(vertices)."""
        if self._drawing is None:
            return
        moved = np.ascontiguousarray(
            self._drawing.points + factor * self._drawing.shifts, dtype=np.float32
        )
        _fill(self._coordinates.point, moved)

    def set_lines(self, shown: bool, width: float, colour: tuple[float, float, float]) -> None:
        """Set how the edges of the pieces look."""
        self._line_switch.whichChild = coin.SO_SWITCH_ALL if shown else coin.SO_SWITCH_NONE
        self._line_style.lineWidth = width
        self._line_colour.rgb.setValue(*colour)

    def set_transparency(self, share: float) -> None:
        """Set the transparency, 0 (opaque) to 1."""
        self._material.transparency.setValue(share)

    def _part_field(self) -> Any:
        return self._faces.getField("partIndex")

    def _set_topology(self, found: Drawing) -> None:
        corners = found.points[found.triangles]
        normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
        length = np.linalg.norm(normals, axis=1, keepdims=True)
        normals = normals / np.where(length > 0, length, 1.0)
        _fill(self._normals.vector, np.ascontiguousarray(normals, dtype=np.float32))
        _fill(self._material.diffuseColor, colours(len(found.parts)))
        _fill(self._part_field(), found.parts.astype(np.int32).tolist())
        _fill(self._faces.coordIndex, _ended(found.triangles))
        _fill(self._lines.coordIndex, _ended(found.edges))


def _ended(rows: LongArray) -> list[int]:
    """Return rows of ids one after the other, each ended by -1 as Coin wants them."""
    ends = np.full((len(rows), 1), -1, dtype=np.int64)
    return np.hstack([rows, ends]).ravel().tolist()


def _fill(field: Any, values: Any) -> None:
    """Replace the values of a multiple field, with one notification."""
    field.enableNotify(False)
    field.setNum(len(values))
    if len(values):
        field.setValues(0, len(values), values)
    field.enableNotify(True)
    field.touch()
