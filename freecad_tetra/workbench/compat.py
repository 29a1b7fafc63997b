# SPDX-License-Identifier: LGPL-2.1-or-later
"""All that differs between FreeCAD 0.20 and 1.1, and between Python 3.10 and 3.14."""

from __future__ import annotations

import sys
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import FreeCAD

from freecad_tetra.errors import TetraError


def version() -> tuple[int, int]:
    """Return FreeCAD's version, such as (0, 20) or (1, 0)."""
    major, minor = FreeCAD.Version()[:2]
    return int(major), int(minor)


def qt() -> tuple[Any, Any, Any]:
    """Return (QtCore, QtGui, QtWidgets) of FreeCAD's own shim.

    Up to 0.20 the shim has no QtWidgets, its QtGui holds the widgets.

    Raises
    ------
    ImportError
        A FreeCAD without Qt for Python.
    """
    from PySide import QtCore, QtGui

    try:
        from PySide import QtWidgets
    except ImportError:
        QtWidgets = QtGui
    return QtCore, QtGui, QtWidgets


def ask(box: Any) -> int:
    """Show a modal box and return the button pressed: `exec` is `exec_` in Qt 5."""
    run = getattr(box, "exec", None) or box.exec_
    return int(run())


def button_code(button: Any) -> int:
    """Return a standard button as the int that task panels give: Qt 6 has enums for them."""
    return int(getattr(button, "value", button))


def alive(obj: Any) -> bool:
    """Whether a document object is still in its document; False for None.

    An object whose creation was undone raises, or from 1.0 on has None for a name.
    """
    try:
        return obj is not None and bool(obj.Name) and obj.Document.getObject(obj.Name) == obj
    except (AttributeError, ReferenceError, RuntimeError):
        return False


class Stateless:
    """A proxy whose document stores its class and nothing else; all data are properties.

    0.20 and early 0.21 ask __getstate__ and __setstate__, later ones dumps and loads.
    """

    def __getstate__(self) -> Any:
        return None

    def __setstate__(self, state: Any) -> None:
        return None

    def dumps(self) -> Any:
        """Return nothing to store."""
        return None

    def loads(self, state: Any) -> None:
        """Accept what an older version stored."""
        return None


def user_folder() -> Path:
    """Return the folder of user data, which holds Mod (per version from 1.1 on)."""
    return Path(FreeCAD.getUserAppDataDir())


def package_folders() -> list[Path]:
    """Return where the Addon Manager puts Python packages, the most special folder first."""
    tag = f"py{sys.version_info.major}{sys.version_info.minor}"
    bases = [user_folder(), user_folder().parent]  # from 1.1 on the folder of the version, and both
    roots = [base / "AdditionalPythonPackages" for base in bases]
    return [folder for root in roots for folder in (root / tag, root)]


def set_mesh_source(mesh_object: Any, source: Any) -> None:
    """Link a FEM mesh to the object that it meshes: `Part` until 0.21, `Shape` since 1.0."""
    name = _mesh_link(mesh_object)
    if name:
        setattr(mesh_object, name, source)


def mesh_source(mesh_object: Any) -> Any:
    """Return the object that a FEM mesh meshes, or None."""
    name = _mesh_link(mesh_object)
    return getattr(mesh_object, name) if name else None


def _mesh_link(mesh_object: Any) -> str:
    known = [n for n in ("Shape", "Part") if n in mesh_object.PropertiesList]
    return known[0] if known else ""


def millimetres(value: Any) -> float:
    """Return a length property (a Quantity, or a float in old documents) in mm."""
    return float(getattr(value, "Value", value))


def degrees(value: Any) -> float:
    """Return an angle property (a Quantity, or a float in old documents) in degrees."""
    return float(getattr(value, "Value", value))


def newtons(value: Any) -> float:
    """Return a force property in N: a plain float until 0.20, a Quantity since."""
    return float(value.getValueAs("N")) if hasattr(value, "getValueAs") else float(value)


@contextmanager
def errors_for_freecad() -> Iterator[None]:
    """Turn typed errors into those that FreeCAD shows as an object's state, in one line."""
    try:
        yield
    except TetraError as error:
        raise RuntimeError(str(error)) from None
