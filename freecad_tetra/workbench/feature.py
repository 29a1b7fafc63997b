# SPDX-License-Identifier: LGPL-2.1-or-later
"""The parametric objects: made by macros and commands, recomputed, their pieces kept.

Documents store the path of this module and the names of its classes: both are a file format.
"""

from __future__ import annotations

import importlib
import json
from collections.abc import Callable, Mapping
from typing import Any
from weakref import WeakKeyDictionary

import FreeCAD

from freecad_tetra.errors import BadOption, TetraError
from freecad_tetra.model import ConvexCells as Cells
from freecad_tetra.model import TetMesh
from freecad_tetra.workbench import (
    compat,
    preferences,
    progress,
    properties,
    runner,
    source,
    store,
    write_back,
)

# The fingerprint of the input that pieces were made of, until they are stored, and the text of
# their shape, until it is made.
_made_of: WeakKeyDictionary[Any, str] = WeakKeyDictionary()
_texts: WeakKeyDictionary[Any, Any] = WeakKeyDictionary()


class Tetrahedra(compat.Stateless):
    """Proxy of an object of face-to-face tetrahedra."""

    task = "tetrahedralize"
    known = properties.TETRAHEDRA
    options: tuple[str, ...] = ("Method", "Direction")

    def __init__(self, obj: Any) -> None:
        obj.Proxy = self
        properties.add(obj, self.known)

    def execute(self, obj: Any) -> None:
        """FreeCAD calls this when something has changed; pieces still good are kept."""
        with compat.errors_for_freecad():
            shape = source.shape_of(obj.Source)
            mark = source.fingerprint(shape, json.dumps(_options(self, obj)))
            if mark != obj.Fingerprint or not obj.PieceLayout:
                job = runner.start(self.task, shape, _options(self, obj), _limit(obj))
                pieces = progress.wait(job, obj.Label)
                _texts[pieces] = job.text
                _keep(obj, pieces, mark)
            _show(obj)

    def onDocumentRestored(self, obj: Any) -> None:
        """FreeCAD calls this after opening a document and for a copy."""
        properties.migrate(obj, self.known)


class ConvexCells(Tetrahedra):
    """Proxy of an object of convex cells."""

    task = "convex_cells"
    known = properties.CONVEX_CELLS
    options = ("Method", "Flatness")


KINDS = {"Tetrahedra": Tetrahedra, "ConvexCells": ConvexCells}


def make_tetrahedra(doc: Any, source: Any, **properties: Any) -> Any:
    """Add a Part::FeaturePython of tetrahedra to a document; recompute the document to fill it.

    Parameters
    ----------
    doc : App.Document
    source : document object
        Body, link, compound or any object with a shape that holds solids.
    **properties
        Method, LinearDeflection (mm, 0 = automatic), AngularDeflection (degrees, 0 = automatic),
        Direction, MaxPieces, Explode, Label.

    Returns
    -------
    document object

    Raises
    ------
    BadOption
        There is no such property, or it does not take the value; nothing was added.
    """
    return _make(doc, "Tetrahedra", source, properties)


def make_convex_cells(doc: Any, source: Any, **properties: Any) -> Any:
    """Add a Part::FeaturePython of convex cells; as `make_tetrahedra`, with Flatness."""
    return _make(doc, "ConvexCells", source, properties)


def make_fem_mesh(
    doc: Any, source: Any, analysis: Any = None, order: int = 2, **properties: Any
) -> Any:
    """Add a FEM mesh of a solid or of a tetrahedra object, into an analysis if one is given.

    See `freecad_tetra.workbench.fem_feature`, which makes it.
    """
    from freecad_tetra.workbench import fem_feature

    return fem_feature.make(doc, source, analysis, order, properties)


def pieces_of(obj: Any) -> Cells | TetMesh | None:
    """Return the pieces stored in an object, also above MaxPieces; None before its first run.

    Raises
    ------
    TetraError
        The document is damaged.
    """
    known = getattr(obj.Proxy, "pieces", None)
    if known is None or known[0] != obj.Fingerprint:
        known = (obj.Fingerprint, store.read(obj))
        obj.Proxy.pieces = known
    return known[1]


def start(kind: str, source_object: Any, given: Mapping[str, Any]) -> runner.Job:
    """Start a computation in the background for a task panel; no object is touched.

    Parameters
    ----------
    kind : {"Tetrahedra", "ConvexCells"}
    source_object : document object
    given : mapping
        Properties as those of `make_tetrahedra`; those left out are those of a new object.

    Raises
    ------
    InvalidSolid, BadOption, KernelMissing
    """
    proxy = KINDS[kind]
    properties.require(proxy.known, given)
    chosen = _Chosen({name: p.value for name, p in proxy.known.items()} | dict(given))
    shape, options = source.shape_of(source_object), _options(proxy, chosen)
    mark = source.fingerprint(shape, json.dumps(options))
    limit = int(given.get("MaxPieces", preferences.max_pieces()))
    job = runner.start(proxy.task, shape, options, 0 if given.get("Explode") else limit)

    def finish(pieces: Any) -> Any:
        _made_of[pieces], _texts[pieces] = mark, job.text
        return pieces

    job.finish = finish
    return job


def accept(obj: Any, pieces: Cells | TetMesh) -> None:
    """Store the result of `start`; the next recompute makes the shape and computes nothing.

    It holds for the source and the properties as they were at `start`, and when they have
    changed since, the next recompute computes anew.
    """
    _keep(obj, pieces, mark_of(pieces))
    obj.touch()


def mark_of(pieces: Cells | TetMesh) -> str:
    """Return the fingerprint of the input of `start`, "" for other pieces."""
    return _made_of.get(pieces, "")


def make_compound(obj: Any) -> None:
    """Give an object above MaxPieces its compound all the same, on request."""
    pieces = pieces_of(obj)
    if pieces is not None:
        obj.MaxPieces = max(obj.MaxPieces, len(pieces))
        obj.Document.recompute([obj])


def options_of(obj: Any) -> dict[str, Any]:
    """Return the keywords of `freecad_tetra.api.tetrahedralize` for an object's properties."""
    return _options(Tetrahedra, obj)


class _Chosen:
    """Properties that no object has yet."""

    def __init__(self, values: Mapping[str, Any]) -> None:
        self.__dict__.update(values)


def _make(doc: Any, kind: str, source_object: Any, given: Mapping[str, Any]) -> Any:
    proxy = KINDS[kind]
    label = given.get("Label", kind)
    inputs = {name: value for name, value in given.items() if name != "Label"}
    properties.require(proxy.known, inputs)
    obj = doc.addObject("Part::FeaturePython", kind)
    try:
        proxy(obj)
        obj.Label = label
        obj.Source = source_object
        properties.fill(obj, proxy.known, inputs)
        _options(proxy, obj)
    except TetraError:
        doc.removeObject(obj.Name)
        raise
    if FreeCAD.GuiUp:
        view = importlib.import_module("freecad_tetra.workbench.view")
        getattr(view, f"ViewProvider{kind}")(obj.ViewObject)
    return obj


def _options(proxy: Any, obj: Any) -> dict[str, Any]:
    """Return the keywords of `freecad_tetra.api` for an object's properties."""
    out = properties.reading(obj)
    turn: dict[str, Callable[[Any], Any]] = {
        "Method": _first,
        "Direction": direction,
        "Flatness": int,
    }
    for name in proxy.options:
        out[name.lower()] = turn[name](getattr(obj, name))
    return out


def _first(method: Any) -> str:
    """Return a method; the value of a new object is the list of all, the first of them chosen."""
    return str(method[0] if isinstance(method, list) else method)


def direction(text: str) -> str | list[int]:
    """Return a direction of the API: auto, x, y, z, or three whole numbers.

    Raises
    ------
    BadOption
    """
    word = str(text).strip().lower() or "auto"
    if word in ("auto", "x", "y", "z"):
        return word
    try:
        numbers = [int(part) for part in word.split(",")]
    except ValueError:
        numbers = []
    if len(numbers) != 3 or not any(numbers):
        raise BadOption(f"{text!r} is no direction", "use auto, x, y, z or A,B,C of whole numbers")
    return numbers


def _keep(obj: Any, pieces: Cells | TetMesh, mark: str) -> None:
    store.write(obj, pieces)
    obj.Fingerprint = mark
    obj.Proxy.pieces = (mark, pieces)


def _limit(obj: Any) -> int:
    """Return up to how many pieces the child makes the text of a shape: exploded ones get none."""
    return 0 if obj.Explode else int(obj.MaxPieces)


def _show(obj: Any) -> None:
    """Make the shape of an object's pieces, or none when they are too many."""
    import Part

    pieces = pieces_of(obj)
    shape = Part.Shape()
    if pieces is not None and len(pieces) <= obj.MaxPieces:
        shape = write_back.shape_of_pieces(pieces, float(obj.Explode), _texts.pop(pieces, None))
        shape.Placement = obj.Placement
    obj.Shape = shape
