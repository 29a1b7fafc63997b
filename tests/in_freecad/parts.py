# SPDX-License-Identifier: LGPL-2.1-or-later
"""Documents and shapes that the tests in FreeCAD share, and what is asked of every result."""

from __future__ import annotations

import unittest
from pathlib import Path
from typing import Any

import FreeCAD
import numpy as np
import Part
from FreeCAD import Placement, Rotation, Vector

CORPUS = Path(__file__).resolve().parents[3] / "shared" / "corpus" / "brep"


class InDocument(unittest.TestCase):
    """A test with an empty document that records undo."""

    def setUp(self) -> None:
        self.doc = FreeCAD.newDocument("tetra_test")
        self.doc.UndoMode = 1

    def tearDown(self) -> None:
        for name in list(FreeCAD.listDocuments()):
            FreeCAD.closeDocument(name)

    def feature_of(self, shape: Any, name: str = "Solid") -> Any:
        """Return a Part::Feature with a shape."""
        obj = self.doc.addObject("Part::Feature", name)
        obj.Shape = shape
        return obj

    def assertFillsSource(self, obj: Any, volume: float) -> None:
        """Assert that an object's shape is valid, has its pieces and the volume."""
        self.assertEqual(obj.State, ["Up-to-date"], obj.getStatusString())
        self.assertTrue(obj.Shape.isValid())
        self.assertEqual(len(obj.Shape.Solids), obj.Pieces)
        self.assertAlmostEqual(obj.Shape.Volume / volume, 1.0, delta=1e-9)


def angle_block() -> Any:
    """Return an L of volume 7: two boxes fused, one notch, no curved face."""
    return Part.makeBox(3, 3, 1).cut(Part.makeBox(2, 1, 1, Vector(1, 0, 0)))


def drilled_block() -> Any:
    """Return a block with a round hole."""
    return Part.makeBox(10, 10, 4).cut(Part.makeCylinder(3, 4, Vector(5, 5, 0)))


def thin_tube() -> Any:
    """Return a tube whose wall is thinner than the default chords: it has to be meshed finer."""
    hole = Part.makeCylinder(9.99, 5)
    hole.rotate(Vector(), Vector(0, 0, 1), 9)  # its chords do not lie along those outside
    return Part.makeCylinder(10, 5).cut(hole)


def two_boxes_with_common_face() -> Any:
    """Return a compound of two solids that share one face."""
    return Part.makeBox(2, 2, 2).generalFuse([Part.makeBox(2, 2, 2, Vector(2, 0, 0))])[0]


def placement(x: float, y: float, z: float, angle: float = 0.0) -> Any:
    """Return a placement turned by `angle` degrees about z."""
    return Placement(Vector(x, y, z), Rotation(Vector(0, 0, 1), angle))


def is_closed(triangles: Any) -> bool:
    """Whether every directed edge has its opposite as often as itself."""
    sides = np.concatenate([triangles[:, [i, (i + 1) % 3]] for i in range(3)]).astype(np.int64)
    size = int(sides.max()) + 1
    forth, back = sides[:, 0] * size + sides[:, 1], sides[:, 1] * size + sides[:, 0]
    return np.array_equal(np.sort(forth), np.sort(back))


def face_uses(shape: Any) -> list[int]:
    """Return in how many solids each face of a shape is, in the order of its faces."""
    uses: dict[int, list[Any]] = {}
    for solid in shape.Solids:
        for face in solid.Faces:
            uses.setdefault(face.hashCode(), []).append(face)
    return [sum(f.isSame(face) for f in uses[face.hashCode()]) for face in shape.Faces]
