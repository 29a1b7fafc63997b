# SPDX-License-Identifier: LGPL-2.1-or-later
"""The properties of the parametric objects: added to new ones, completed in older documents."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import FreeCAD

from freecad_tetra.errors import BadOption
from freecad_tetra.workbench import compat, preferences

QT_TRANSLATE_NOOP = FreeCAD.Qt.QT_TRANSLATE_NOOP

SCHEMA = 2
_READ_ONLY, _HIDDEN, _OUTPUT = 1, 4, 8  # App::PropertyType
_INPUT, _RESULT, _DATA = 0, _READ_ONLY | _OUTPUT, _HIDDEN | _OUTPUT


@dataclass(frozen=True)
class Property:
    """One property: FreeCAD's type, group, tip, flags, and the value of new objects."""

    kind: str
    group: str
    tip: str
    flags: int = _INPUT
    value: Any = None


_DEFLECTIONS = ("LinearDeflection", "AngularDeflection")
_BASE = {
    "Source": Property(
        "App::PropertyLinkGlobal", "Base",
        QT_TRANSLATE_NOOP("App::Property", "The solid, body, link or compound to decompose"),
    ),
    "LinearDeflection": Property(
        "App::PropertyLength", "Tessellation",
        QT_TRANSLATE_NOOP(
            "App::Property", "How far chords may be from round faces; 0 chooses by size"
        ), value=0.0,
    ),
    "AngularDeflection": Property(
        "App::PropertyAngle", "Tessellation",
        QT_TRANSLATE_NOOP(
            "App::Property", "Angle between neighbouring chords of round faces; 0 is automatic"
        ), value=0.0,
    ),
    "SchemaVersion": Property(
        "App::PropertyInteger", "Base",
        QT_TRANSLATE_NOOP("App::Property", "Version of this list of properties"),
        _DATA | _READ_ONLY, SCHEMA,
    ),
    "Pieces": Property(
        "App::PropertyInteger", "Result",
        QT_TRANSLATE_NOOP("App::Property", "Number of pieces"), _RESULT,
    ),
    "Notches": Property(
        "App::PropertyInteger", "Result",
        QT_TRANSLATE_NOOP("App::Property", "Number of reflex edges of the solid"), _RESULT,
    ),
    "SteinerPoints": Property(
        "App::PropertyInteger", "Result",
        QT_TRANSLATE_NOOP("App::Property", "Number of points that the solid did not have"),
        _RESULT,
    ),
    "VolumeError": Property(
        "App::PropertyFloat", "Result",
        QT_TRANSLATE_NOOP(
            "App::Property", "Volume of all pieces against the tessellated solid, relative"
        ), _RESULT,
    ),
    "Seconds": Property(
        "App::PropertyFloat", "Result",
        QT_TRANSLATE_NOOP("App::Property", "Time of the computation"), _RESULT,
    ),
    "ReportData": Property("App::PropertyString", "Result", "JSON", _DATA),
    "Fingerprint": Property("App::PropertyString", "Result", "SHA-256", _DATA),
}  # fmt: skip

_PIECES = {
    "MaxPieces": Property(
        "App::PropertyInteger", "Pieces",
        QT_TRANSLATE_NOOP("App::Property", "Up to so many pieces become solids; more are drawn"),
    ),
    "Explode": Property(
        "App::PropertyFloat", "Pieces",
        QT_TRANSLATE_NOOP("App::Property", "How far pieces are moved apart, as a share"),
        value=0.0,
    ),
    "PieceData": Property("App::PropertyFloatList", "Result", "Numbers of PieceLayout", _DATA),
    "PieceLayout": Property("App::PropertyString", "Result", "JSON", _DATA),
}  # fmt: skip

_DIRECTION = Property(
    "App::PropertyString", "Method",
    QT_TRANSLATE_NOOP("App::Property", "Direction of the walls: auto, x, y, z or A,B,C"),
    value="auto",
)  # fmt: skip
_METHOD_TIP = QT_TRANSLATE_NOOP("App::Property", "How the solid is decomposed")
_METHOD = ("App::PropertyEnumeration", "Method", _METHOD_TIP, _INPUT)
TET_METHODS = ["chazelle-palios", "bajaj-dey"]
CELL_METHODS = ["auto", "bajaj-dey", "fences"]

TETRAHEDRA: dict[str, Property] = {
    **_BASE, **_PIECES, "Method": Property(*_METHOD, value=TET_METHODS), "Direction": _DIRECTION,
}  # fmt: skip
CONVEX_CELLS: dict[str, Property] = {
    **_BASE, **_PIECES, "Method": Property(*_METHOD, value=CELL_METHODS),
    "Flatness": Property(
        "App::PropertyInteger", "Method",
        QT_TRANSLATE_NOOP(
            "App::Property", "Grid steps within which facets of one plane are coplanar, 0 to 8"
        ), value=4,
    ),
}  # fmt: skip
FEM_MESH: dict[str, Property] = {
    **_BASE, "Method": Property(*_METHOD, value=TET_METHODS), "Direction": _DIRECTION,
    "Order": Property(
        "App::PropertyInteger", "Method",
        QT_TRANSLATE_NOOP("App::Property", "1 for straight tetrahedra, 2 for middle nodes too"),
        value=2,
    ),
    "Quality": Property(
        "App::PropertyBool", "Elements",
        QT_TRANSLATE_NOOP("App::Property", "Rebuild the elements by the program mmg3d"),
        value=False,
    ),
    "ElementSize": Property(
        "App::PropertyLength", "Elements",
        QT_TRANSLATE_NOOP("App::Property", "Longest edge of elements; 0 chooses by size"),
        value=0.0,
    ),
    "ElementsPerTurn": Property(
        "App::PropertyInteger", "Elements",
        QT_TRANSLATE_NOOP(
            "App::Property", "Elements around a round face, with Quality; 0 is automatic"
        ), value=0,
    ),
    "FaceSizes": Property(
        "App::PropertyStringList", "Elements",
        QT_TRANSLATE_NOOP("App::Property", "Longest edges on faces, with Quality: Face3=0.5"),
    ),
    "Refinement": Property(
        "App::PropertyInteger", "Elements",
        QT_TRANSLATE_NOOP("App::Property", "How often every element is divided into eight"),
        value=0,
    ),
    "LoadCheck": Property(
        "App::PropertyEnumeration", "Elements",
        QT_TRANSLATE_NOOP("App::Property", "What to do when a load does not arrive on the mesh"),
        value=["Warn", "Error", "Off"],
    ),
    "Constraints": Property(
        "App::PropertyLinkListGlobal", "Result",
        QT_TRANSLATE_NOOP("App::Property", "Those of the analysis that the mesh has groups for"),
        _DATA,
    ),
}  # fmt: skip


def add(obj: Any, known: Mapping[str, Property]) -> None:
    """Give an object all properties that it lacks, with the values of new objects."""
    for name, wanted in known.items():
        if name in obj.PropertiesList:
            continue
        obj.addProperty(wanted.kind, name, wanted.group, wanted.tip, wanted.flags)
        value = preferences.max_pieces() if name == "MaxPieces" else wanted.value
        if value is not None:
            setattr(obj, name, value)


def fill(obj: Any, known: Mapping[str, Property], given: Mapping[str, Any]) -> None:
    """Set properties by name.

    Raises
    ------
    BadOption
        There is no such input, or it does not take the value.
    """
    require(known, given)
    for name, value in given.items():
        try:
            setattr(obj, name, value)
        except (TypeError, ValueError, RuntimeError) as error:
            raise BadOption(
                f"{name} cannot be {value!r}: {error}", "choose another value"
            ) from error


def require(known: Mapping[str, Property], given: Mapping[str, Any]) -> None:
    """Raise BadOption when a name is not that of an input."""
    inputs = [name for name, wanted in known.items() if wanted.flags == _INPUT]
    for name in given:
        if name not in inputs:
            raise BadOption(f"there is no property {name}", f"use {', '.join(inputs)}")


def migrate(obj: Any, known: Mapping[str, Property]) -> None:
    """Bring an object of an older document up to date; its inputs keep their values."""
    before = int(getattr(obj, "SchemaVersion", 1))
    for name, wanted in known.items():
        if name in obj.PropertiesList and obj.getTypeIdOfProperty(name) != wanted.kind:
            kept = getattr(obj, name)
            obj.removeProperty(name)
            add(obj, {name: wanted})
            setattr(obj, name, kept)
    add(obj, known)
    if before < SCHEMA:
        obj.SchemaVersion = SCHEMA


def reading(obj: Any) -> dict[str, Any]:
    """Return the keywords of `freecad_tetra.api` for the deflections of an object."""
    return reading_of({name: getattr(obj, name) for name in _DEFLECTIONS})


def reading_of(given: Mapping[str, Any]) -> dict[str, Any]:
    """Return the same for a mapping, in which deflections that are left out are automatic."""
    linear, angular = (given.get(name, 0.0) for name in _DEFLECTIONS)
    return {
        "linear_deflection": compat.millimetres(linear) or None,
        "angular_deflection": compat.degrees(angular) or None,
    }
