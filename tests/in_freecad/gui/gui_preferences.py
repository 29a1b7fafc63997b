# SPDX-License-Identifier: LGPL-2.1-or-later
"""The preferences page shows what is stored, stores what is chosen, and is obeyed."""

from __future__ import annotations

from typing import Any

import FreeCADGui
from window import QtCore, QtWidgets, WindowTest, take_picture

from freecad_tetra.workbench import preferences


def in_dialog(act: Any) -> None:
    """Open the page in FreeCAD's modal dialog, act on it, and press OK."""
    failures: list[BaseException] = []
    timer = QtCore.QTimer()

    def inside() -> None:
        dialog = QtWidgets.QApplication.activeModalWidget()
        if dialog is None:
            return
        timer.stop()
        try:
            act(dialog)
        except BaseException as error:  # told below, outside Qt's slot
            failures.append(error)
        dialog.accept()

    timer.timeout.connect(inside)
    timer.start(500)
    FreeCADGui.showPreferences("Tetra", 0)
    timer.stop()
    if failures:
        raise failures[0]


def field(dialog: Any, name: str) -> Any:
    found = dialog.findChild(QtWidgets.QWidget, name)
    assert found is not None, name
    return found


class Preferences(WindowTest):
    def tearDown(self) -> None:
        for name in ("MaxPieces", "CellMethod", "Direction"):
            preferences.group().RemInt(name)
        preferences.group().RemFloat("LinearDeflection")
        preferences.group().RemBool("HideSource")
        super().tearDown()

    def test_defaults(self) -> None:
        self.assertEqual(preferences.max_pieces(), 10_000)
        self.assertTrue(preferences.hide_source())
        self.assertEqual(preferences.choices()["Method"], "auto")
        self.assertEqual(preferences.element_order(), 2)

    def test_page_stores_what_is_chosen(self) -> None:
        def act(dialog: Any) -> None:
            self.assertEqual(field(dialog, "MaxPieces").value(), 10_000)
            self.assertTrue(field(dialog, "HideSource").isChecked())
            take_picture("preferences")
            field(dialog, "MaxPieces").setValue(123)
            field(dialog, "LinearDeflection").setValue(0.25)
            field(dialog, "CellMethod").setCurrentIndex(2)
            field(dialog, "Direction").setCurrentIndex(3)
            field(dialog, "HideSource").setChecked(False)

        in_dialog(act)
        self.assertEqual(preferences.max_pieces(), 123)
        self.assertFalse(preferences.hide_source())
        chosen = preferences.choices()
        self.assertEqual(chosen["LinearDeflection"], 0.25)
        self.assertEqual((chosen["Method"], chosen["Direction"]), ("fences", "z"))

    def test_page_shows_what_is_stored(self) -> None:
        preferences.group().SetInt("MaxPieces", 77)

        def act(dialog: Any) -> None:
            self.assertEqual(field(dialog, "MaxPieces").value(), 77)

        in_dialog(act)
