# SPDX-License-Identifier: LGPL-2.1-or-later
"""Pieces as a light Coin scene: one shape node in which every piece is a part of its own.

FreeCAD's own face node highlights and picks by part, so a piece is preselected and selected
whole, and drawing pieces apart is one write of the coordinates. Nothing here knows documents.
"""

from __future__ import annotations

import colorsys
from typing import Any

import numpy as np
from pivy import coin

from freecad_tetra.model import ConvexCells, LongArray, TetMesh
from freecad_tetra.workbench.piece_drawing import Drawing, drawing

GOLDEN_RATIO = 0.6180339887498949


def colours(count: int) -> list[tuple[float, float, float]]:
    """Return colours of `count` pieces; consecutive ones lie far apart on the circle of hues."""
    tones = [(0.50, 1.0), (0.65, 0.88), (0.35, 0.97)]
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
        self._pieces: ConvexCells | TetMesh | None = None
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
        if pieces is not None and pieces is self._pieces:
            self.explode(factor)
            return
        self._pieces = pieces
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

    def box(self) -> tuple[tuple[float, ...], tuple[float, ...]]:
        """Return the least and the largest coordinates that are drawn; O(vertices)."""
        action = coin.SoGetBoundingBoxAction(coin.SbViewportRegion())
        action.apply(self.root)
        found = action.getBoundingBox()
        return tuple(found.getMin().getValue()), tuple(found.getMax().getValue())

    def set_lines(self, shown: bool, width: float, colour: tuple[float, float, float]) -> None:
        """Set how the edges of the pieces look."""
        self._line_switch.whichChild = coin.SO_SWITCH_ALL if shown else coin.SO_SWITCH_NONE
        self._line_style.lineWidth = width
        self._line_colour.rgb.setValue(*colour)

    def set_transparency(self, share: float) -> None:
        """Set the transparency, 0 (opaque) to 1."""
        self._material.transparency.setValue(share)

    def transparency(self) -> float:
        """Return the transparency, 0 (opaque) to 1."""
        return float(self._material.transparency[0])

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
