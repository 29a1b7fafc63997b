# SPDX-License-Identifier: LGPL-2.1-or-later
"""The choices of a decomposition as a form, with units, whose values are an object's properties."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any

import FreeCAD
import FreeCADGui

from freecad_tetra.workbench import compat, preferences
from freecad_tetra.workbench.properties import CONVEX_CELLS
from freecad_tetra.workbench.selection import TETRAHEDRA

MOST_FLATNESS = 8
MOST_PIECES = 10_000_000
MOST_TRIES = 100

translate = FreeCAD.Qt.translate


def _quantity_box() -> Any:
    """Return FreeCAD's box for a number with a unit.

    Qt may place a new widget where a deleted one was whose Python object still lives: PySide then
    gives that dead object. As the new widget stays, the next one is elsewhere.
    """
    loader = FreeCADGui.UiLoader()
    for _ in range(MOST_TRIES):
        box = loader.createWidget("Gui::QuantitySpinBox")
        try:
            box.objectName()
        except RuntimeError:
            continue
        return box
    raise RuntimeError("FreeCAD gives no box for quantities; close panels and try again")


class Choices:
    """A form for the properties of one kind of object.

    Parameters
    ----------
    kind : {TETRAHEDRA, CONVEX_CELLS}
    given : mapping
        Properties to start with; the preferences give those left out.
    limited : bool
        Ask up to how many pieces become solids.

    Attributes
    ----------
    widget : QWidget
    """

    def __init__(self, kind: str, given: Mapping[str, Any], limited: bool = True) -> None:
        _, _, self._widgets = compat.qt()
        self.widget = self._widgets.QWidget()
        self._form = self._widgets.QFormLayout(self.widget)
        self._form.setContentsMargins(0, 0, 0, 0)
        self._read: dict[str, Any] = {}
        self._fields: dict[str, Any] = {}
        start = {"Flatness": CONVEX_CELLS["Flatness"].value, **preferences.choices(), **given}
        if kind == TETRAHEDRA:
            self._direction(str(start["Direction"]))
        else:
            self._method(str(start["Method"]))
        self._length("LinearDeflection", translate("Tetra", "Chord height"), start)
        self._angle("AngularDeflection", translate("Tetra", "Chord angle"), start)
        if kind != TETRAHEDRA:
            self._count("Flatness", translate("Tetra", "Flatness"), MOST_FLATNESS, start)
        if limited:
            self._count("MaxPieces", translate("Tetra", "Solids up to"), MOST_PIECES, start)
        self._tips()

    def values(self) -> dict[str, Any]:
        """Return the properties as they are chosen now."""
        return {name: read() for name, read in self._read.items()}

    def on_change(self, tell: Callable[[], None]) -> None:
        """Call `tell` whenever the user has changed how the solid is tessellated."""
        for name in ("LinearDeflection", "AngularDeflection"):
            box = self.field(name)
            line = box.findChild(self._widgets.QLineEdit)
            if line is None:  # its wrapper is that of another, deleted widget
                box.editingFinished.connect(tell)
            else:
                line.textChanged.connect(lambda text: tell())

    def enable(self, on: bool) -> None:
        """Let the user change the choices, or not while the work goes on."""
        self.widget.setEnabled(on)

    def field(self, name: str) -> Any:
        """Return the widget of a property."""
        return self._fields[name]

    def _add(self, name: str, title: str, widget: Any) -> None:
        self._fields[name] = widget
        widget.setObjectName(name)
        self._form.addRow(title, widget)

    def _pick(self, name: str, title: str, known: list[tuple[str, str]], value: str) -> Any:
        box = self._widgets.QComboBox()
        box.setSizeAdjustPolicy(self._widgets.QComboBox.AdjustToMinimumContentsLengthWithIcon)
        for item, text in known:
            box.addItem(text, item)
        box.setCurrentIndex(box.findData(value))
        self._add(name, title, box)
        return box

    def _method(self, value: str) -> None:
        box = self._pick("Method", translate("Tetra", "Method"), cell_methods(), value)
        self._read["Method"] = lambda: box.itemData(box.currentIndex())

    def _direction(self, value: str) -> None:
        """Add a box for one of the axes, or for three whole numbers that are typed in."""
        box = self._pick("Direction", translate("Tetra", "Direction"), directions(), value)
        box.setEditable(True)
        if box.currentIndex() < 0:
            box.setEditText(value)

        def read() -> str:
            place = box.findText(box.currentText())
            return str(box.itemData(place) if place >= 0 else box.currentText())

        self._read["Direction"] = read

    def _quantity(self, name: str, title: str, unit: str, value: float) -> None:
        box = _quantity_box()
        box.setProperty("unit", unit)
        box.setProperty("minimum", 0.0)
        box.setProperty("rawValue", value)
        self._add(name, title, box)
        self._read[name] = lambda: float(box.property("rawValue"))

    def _length(self, name: str, title: str, start: Any) -> None:
        self._quantity(name, title, "mm", compat.millimetres(start[name]))

    def _angle(self, name: str, title: str, start: Any) -> None:
        self._quantity(name, title, "deg", compat.degrees(start[name]))

    def _count(self, name: str, title: str, most: int, start: Any) -> None:
        box = self._widgets.QSpinBox()
        box.setRange(0, most)
        box.setValue(int(start[name]))
        self._add(name, title, box)
        self._read[name] = box.value

    def _tips(self) -> None:
        known = {
            "Method": translate("Tetra", "How the solid is cut; automatic takes the fewer pieces"),
            "Direction": translate(
                "Tetra",
                "Direction of the walls: an axis, or three whole numbers such as 1,0,2; "
                "automatic takes the cheapest",
            ),
            "LinearDeflection": translate(
                "Tetra", "How far chords may be from round faces; 0 is automatic"
            ),
            "AngularDeflection": translate(
                "Tetra", "The angle between neighbouring chords of round faces; 0 is automatic"
            ),
            "Flatness": translate(
                "Tetra", "Grid steps within which the facets of one plane count as flat"
            ),
            "MaxPieces": translate(
                "Tetra", "Up to so many pieces become solids; more are drawn only"
            ),
        }
        for name in self._read:
            self.field(name).setToolTip(known[name])


def directions() -> list[tuple[str, str]]:
    """Return (value, text) of the directions to choose from."""
    return [
        ("auto", translate("Tetra", "Automatic")),
        ("x", translate("Tetra", "X axis")),
        ("y", translate("Tetra", "Y axis")),
        ("z", translate("Tetra", "Z axis")),
    ]


def cell_methods() -> list[tuple[str, str]]:
    """Return (value, text) of the methods for convex cells."""
    return [
        ("auto", translate("Tetra", "Automatic")),
        ("bajaj-dey", translate("Tetra", "Cut notches (Bajaj, Dey)")),
        ("fences", translate("Tetra", "Fences (Chazelle, Palios)")),
    ]
