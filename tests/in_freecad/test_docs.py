# SPDX-License-Identifier: LGPL-2.1-or-later
"""The macro in docs/freecad.md runs as it stands there."""

from __future__ import annotations

import contextlib
import io
import re
import unittest
from pathlib import Path

import FreeCAD

PAGE = Path(__file__).resolve().parents[2] / "docs" / "freecad.md"


class Macro(unittest.TestCase):
    def tearDown(self) -> None:
        for name in list(FreeCAD.listDocuments()):
            FreeCAD.closeDocument(name)

    def test_macro_runs(self) -> None:
        blocks = re.findall(r"```python\n(.*?)```", PAGE.read_text(encoding="utf-8"), re.DOTALL)
        self.assertEqual(len(blocks), 1)
        told = io.StringIO()
        names: dict[str, object] = {}
        with contextlib.redirect_stdout(told):
            exec(blocks[0], names)
        cells, mesh = names["cells"], names["mesh"]
        self.assertGreater(cells.Pieces, 10)
        self.assertGreater(mesh.FemMesh.VolumeCount, 10)
        self.assertIn(f"{cells.Pieces} cells, {cells.Notches} notches", told.getvalue())

    def test_pictures_are_there(self) -> None:
        names = re.findall(r"!\[[^]]*\]\(([^)]*)\)", PAGE.read_text(encoding="utf-8"))
        self.assertGreater(len(names), 5)
        for name in names:
            self.assertTrue((PAGE.parent / name).is_file(), name)
