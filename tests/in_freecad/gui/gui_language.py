# SPDX-License-Identifier: LGPL-2.1-or-later
"""The workbench speaks German when FreeCAD does, and the compiled file is up to date."""

from __future__ import annotations

import xml.etree.ElementTree as ET

import FreeCAD
import FreeCADGui
import Part
from window import ROOT, WindowTest, pump, select, take_picture, tip, widen_panel


class German(WindowTest):
    def setUp(self) -> None:
        super().setUp()
        FreeCADGui.setLocale("German")
        pump(0.3)

    def tearDown(self) -> None:
        FreeCADGui.setLocale("English")
        pump(0.3)
        super().tearDown()

    def test_every_translation_is_compiled(self) -> None:
        root = ET.parse(ROOT / "resources/translations/tetra_de.ts").getroot()
        count = 0
        for context in root.iter("context"):
            for message in context.iter("message"):
                source, wanted = message.findtext("source"), message.findtext("translation")
                told = FreeCAD.Qt.translate(context.findtext("name"), source)
                self.assertEqual(told, wanted, "run tools/translate.sh")
                count += 1
        self.assertGreater(count, 100)

    def test_commands_and_panel_are_translated(self) -> None:
        select(self.add(Part.makeBox(1, 1, 1)))
        action = FreeCADGui.Command.get("Tetra_ConvexCells").getAction()[0]
        self.assertEqual(action.text(), "Konvexe Zellen")
        FreeCADGui.runCommand("Tetra_ConvexCells")
        pump(0.5)
        widen_panel()
        take_picture("german")

    def test_reason_is_translated(self) -> None:
        select()
        FreeCADGui.Command.get("Tetra_ConvexCells").isActive()
        self.assertIn("auswählen", tip("Tetra_ConvexCells"))
