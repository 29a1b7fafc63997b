# SPDX-License-Identifier: LGPL-2.1-or-later
"""Ten real parts: both objects are valid, fill the source, and neighbours share faces."""

from __future__ import annotations

import unittest

import Part
from parts import CORPUS, InDocument, face_uses

from freecad_tetra.workbench import feature, source

NAMES = ("example_2", "example_3", "Window_Type", "Page_028", "Page_061", "Page_079", "Page_080",
         "Page_093", "Page_108", "page68")  # fmt: skip


@unittest.skipUnless(CORPUS.is_dir(), "the corpus lies beside the checkout, in ../shared")
class RealParts(InDocument):
    def test_ten_parts(self) -> None:
        for name in NAMES:
            shape = Part.Shape()
            shape.importBrep(str(next(CORPUS.glob(f"{name}*.brep"))))
            for make in (feature.make_tetrahedra, feature.make_convex_cells):
                with self.subTest(name=name, maker=make.__name__):
                    obj = make(self.doc, self.feature_of(shape))
                    self.doc.recompute()
                    surface = source.solid_of(obj.Source)
                    self.assertEqual(obj.State, ["Up-to-date"], obj.getStatusString())
                    self.assertTrue(obj.Shape.isValid())
                    volume = sum(s.Volume for s in obj.Shape.Solids)
                    wanted = feature.pieces_of(obj).report.volume
                    self.assertAlmostEqual(volume / wanted, 1.0, delta=1e-6)
                    if feature.pieces_of(obj).report.details["surface"]["retries"] == 0:
                        self.assertAlmostEqual(volume / surface.volume(), 1.0, delta=1e-6)
                    uses = face_uses(obj.Shape)
                    self.assertEqual(set(uses), {1, 2})
