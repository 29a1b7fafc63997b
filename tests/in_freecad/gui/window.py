# SPDX-License-Identifier: LGPL-2.1-or-later
"""What the tests of the window share: waiting, pictures, boxes, parts, and a clean end."""

from __future__ import annotations

import os
import time
import unittest
from collections.abc import Callable
from pathlib import Path
from typing import Any

import FreeCAD
import FreeCADGui
import Part

from freecad_tetra.workbench import compat

ROOT = Path(compat.__file__).resolve().parents[2]
PICTURES = Path(os.environ.get("TETRA_SCREENSHOTS", ROOT / "build/screenshots"))
QtCore, QtGui, QtWidgets = compat.qt()


def pump(seconds: float = 0.3) -> None:
    """Let the window live for a while."""
    end = time.monotonic() + seconds
    while time.monotonic() < end:
        QtWidgets.QApplication.processEvents()
        time.sleep(0.005)


def wait_for(condition: Callable[[], Any], what: str, seconds: float = 60.0) -> float:
    """Let the window live until a condition holds; returns how long it took."""
    start = time.monotonic()
    while not condition():
        if time.monotonic() - start > seconds:
            raise AssertionError(f"waited {seconds} s in vain for {what}")
        QtWidgets.QApplication.processEvents()
        time.sleep(0.005)
    return time.monotonic() - start


def take_picture(name: str, shown: Any = None) -> Path:
    """Save what the screen shows, or where a widget is on it, and return the file."""
    pump(0.5)
    path = PICTURES / f"{name}.png"
    area = () if shown is None else shown.frameGeometry().getRect()
    screen = QtWidgets.QApplication.primaryScreen()
    if not screen.grabWindow(0, *area).save(str(path)):
        raise AssertionError(f"cannot write {path}")
    return path


def status() -> str:
    """Return the line in the status bar."""
    return FreeCADGui.getMainWindow().statusBar().currentMessage()


def tip(command: str) -> str:
    """Return what the status bar says while the mouse is over a command's button."""
    return FreeCADGui.Command.get(command).getAction()[0].statusTip()


def report_view() -> str:
    """Return all that FreeCAD's report view shows."""
    window = FreeCADGui.getMainWindow()
    found = [w for w in window.findChildren(QtWidgets.QTextEdit) if "eport" in w.objectName()]
    assert found, "no report view"
    return "\n".join(w.toPlainText() for w in found)


def select(*objects: Any) -> None:
    """Select objects as a click in the tree does."""
    FreeCADGui.Selection.clearSelection()
    for obj in objects:
        FreeCADGui.Selection.addSelection(obj)
    pump(0.1)


def read(name: str) -> Any:
    """Return the shape of a file that lies beside the checkout or in its resources."""
    shape = Part.Shape()
    shape.read(str(ROOT / name))
    return shape


class WindowTest(unittest.TestCase):
    """Each test gets a new document in the workbench, and leaves no panel and no traceback."""

    def setUp(self) -> None:
        FreeCADGui.activateWorkbench("TetraWorkbench")
        self.doc = FreeCAD.newDocument("Test")
        pump(0.2)
        self.told = len(report_view())

    def tearDown(self) -> None:
        if FreeCADGui.Control.activeDialog():
            FreeCADGui.Control.closeDialog()
        for name in list(FreeCAD.listDocuments()):
            FreeCAD.closeDocument(name)
        pump(0.2)
        self.assertNotIn("Traceback", report_view()[self.told :])

    def add(self, shape: Any, name: str = "Part") -> Any:
        """Add a shape to the document as an object, and show all."""
        obj = self.doc.addObject("Part::Feature", name)
        obj.Shape = shape
        self.doc.recompute()
        FreeCADGui.ActiveDocument.ActiveView.viewIsometric()
        FreeCADGui.SendMsgToActiveView("ViewFit")
        pump(0.1)
        return obj

    def names(self) -> list[str]:
        """Return the names of the document's objects."""
        return [obj.Name for obj in self.doc.Objects]


def widget(name: str, kind: Any = None) -> Any:
    """Return a widget of the open task panel by its name."""
    found = FreeCADGui.getMainWindow().findChildren(kind or QtWidgets.QWidget, name)
    assert found, f"no widget {name}"
    return found[-1]


def children_at_work() -> list[int]:
    """Return the ids of the child processes in which the kernel works."""
    found = []
    for path in Path("/proc").glob("[0-9]*"):
        try:
            state, parent = (path / "stat").read_text().rsplit(")", 1)[1].split()[:2]
            ours = b"freecad_tetra" in (path / "cmdline").read_bytes()
            if ours and int(parent) == os.getpid() and state != "Z":
                found.append(int(path.name))
        except (OSError, ValueError, IndexError):
            continue
    return found


def widen_panel() -> None:
    """Give the task panel the room that it needs for a picture."""
    window = FreeCADGui.getMainWindow()
    docks = [d for d in window.findChildren(QtWidgets.QDockWidget) if d.isVisible()]
    left = [d for d in docks if window.dockWidgetArea(d) == QtCore.Qt.LeftDockWidgetArea]
    window.resizeDocks(left, [380] * len(left), QtCore.Qt.Horizontal)


def dented_through() -> Any:
    """Return a box of 10 whose pyramid-shaped dent of the top comes out below the bottom."""

    def loop(*points: tuple[float, float, float]) -> Any:
        return Part.makePolygon([FreeCAD.Vector(*p) for p in (*points, points[0])])

    box = Part.makeBox(10, 10, 10)
    rim = [(3, 3, 10), (7, 3, 10), (7, 7, 10), (3, 7, 10)]
    top = max(box.Faces, key=lambda face: face.CenterOfMass.z).cut(Part.Face(loop(*rim)))
    sides = [face for face in box.Faces if face.CenterOfMass.z < 9]
    dent = [Part.Face(loop(rim[i - 1], rim[i], (5, 5, -2))) for i in range(4)]
    sewn = Part.Compound([*sides, *top.Faces, *dent])
    sewn.sewShape()
    return Part.Solid(sewn.Shells[0])
