# SPDX-License-Identifier: LGPL-2.1-or-later
"""Objects of cadquery and build123d become one shape, with the names they carry.

Neither library is imported: their objects are known by their attributes.
"""

from __future__ import annotations

import contextlib
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Any

from OCP.TopAbs import TopAbs_ShapeEnum
from OCP.TopExp import TopExp
from OCP.TopLoc import TopLoc_Location
from OCP.TopoDS import TopoDS_Iterator
from OCP.TopTools import TopTools_IndexedMapOfShape

from freecad_tetra.brep import as_shape
from freecad_tetra.brep.read import compound
from freecad_tetra.brep.remnants import remnants
from freecad_tetra.labels import Labels, distinct, group_name

SOLID, FACE = TopAbs_ShapeEnum.TopAbs_SOLID, TopAbs_ShapeEnum.TopAbs_FACE


@dataclass(frozen=True)
class NamedShape:
    """A shape and the names of some of its parts.

    Attributes
    ----------
    shape : TopoDS_Shape
    solids, faces : tuple of (str, TopoDS_Shape)
        A name, and a shape all of whose solids (faces) it names.
    """

    shape: Any
    solids: tuple[tuple[str, Any], ...] = ()
    faces: tuple[tuple[str, Any], ...] = ()

    def labels(self) -> Labels:
        """Return the names by number: solids and faces as they are counted in `shape`.

        A tagged face that later cuts have changed names what is left of it.
        """
        table = _numbers(self.shape, SOLID)
        names = [""] * table.Extent()
        for name, shape in self.solids:
            for number in _found(table, shape, SOLID):
                names[number] = names[number] or group_name(name)
        table = _numbers(self.shape, FACE)
        groups: dict[str, list[int]] = {}
        for name, shape in self.faces:
            ids = _found(table, shape, FACE) or _remnants(table, shape)
            groups.setdefault(group_name(name), []).extend(ids)
        faces = {name: tuple(sorted(set(ids))) for name, ids in groups.items() if ids}
        return Labels(distinct(names) if any(names) else (), faces)


def named_shape(value: Any) -> NamedShape | None:
    """Return the shape and names of a CAD object, a sequence of them, or None for others."""
    if hasattr(value, "toCompound") and hasattr(value, "children"):
        return _joined(list(_assembly_parts(value, TopLoc_Location(), root=True)))
    if hasattr(value, "vals") and hasattr(value, "ctx"):
        return _workplane(value)
    if isinstance(value, list | tuple):
        parts = [named_shape(v) for v in value]
        return _joined([p for p in parts if p is not None])
    if hasattr(value, "part") and not hasattr(value, "wrapped"):  # build123d BuildPart
        return None if value.part is None else named_shape(value.part)
    shape = as_shape(value)
    return None if shape is None else NamedShape(shape, tuple(_labelled(value, shape, "")))


def _joined(parts: Sequence[NamedShape]) -> NamedShape | None:
    if not parts:
        return None
    solids = tuple(entry for part in parts for entry in part.solids)
    faces = tuple(entry for part in parts for entry in part.faces)
    return NamedShape(compound([part.shape for part in parts]), solids, faces)


def _workplane(plane: Any) -> NamedShape | None:
    """Return the objects of a cadquery Workplane, or the solid they belong to, and its tags."""
    shape = as_shape(plane)
    if shape is None or not _numbers(shape, SOLID).Extent():
        with contextlib.suppress(ValueError):  # cadquery's answer when there is none
            shape = as_shape(plane.findSolid()) or shape
    if shape is None:
        return None
    solids: list[tuple[str, Any]] = []
    faces: list[tuple[str, Any]] = []
    for name, tagged in plane.ctx.tags.items():
        for value in tagged.vals():
            part = as_shape(value)
            if part is None:
                continue
            holds_solids = _numbers(part, SOLID).Extent() > 0
            (solids if holds_solids else faces).append((name, part))
    for value in plane.vals():
        own = as_shape(value)
        if own is not None:
            solids.extend(_labelled(value, own, ""))
    return NamedShape(shape, tuple(solids), tuple(faces))


def _assembly_parts(node: Any, place: Any, root: bool = False) -> Iterator[NamedShape]:
    """Yield the placed shapes of a cadquery Assembly; groups get the name of their part first."""
    place = place.Multiplied(node.loc.wrapped)
    part = None if node.obj is None else named_shape(node.obj)
    if part is not None:
        own = [(name, s.wrapped) for s, name in dict(getattr(node, "_subshape_names", {})).items()]
        solids = part.solids if root and _is_unnamed(node.name) else ((node.name, part.shape),)
        prefix = "" if root else f"{node.name}_"
        faces = [(f"{prefix}{name}", face) for name, face in (*part.faces, *own)]
        yield NamedShape(
            part.shape.Moved(place),
            tuple((name, shape.Moved(place)) for name, shape in solids),
            tuple((name, face.Moved(place)) for name, face in faces),
        )
    for child in node.children:
        yield from _assembly_parts(child, place)


def _is_unnamed(name: str) -> bool:
    """Return whether a name is one of the UUIDs that cadquery gives to unnamed assemblies."""
    return len(name) == 36 and name.count("-") == 4


def _labelled(value: Any, shape: Any, outer: str) -> Iterator[tuple[str, Any]]:
    """Yield the label of an object and those of its children (build123d), innermost first."""
    label = str(getattr(value, "label", "") or "") or outer
    children = getattr(value, "children", ())
    children = [] if callable(children) else list(children)  # cadquery's is a method
    parts = list(_direct_parts(shape)) if children else []
    if len(parts) == len(children):
        for child, part in zip(children, parts):
            yield from _labelled(child, part, label)
    if label:
        yield label, shape


def _direct_parts(shape: Any) -> Iterator[Any]:
    steps = TopoDS_Iterator(shape)
    while steps.More():
        yield steps.Value()
        steps.Next()


def _numbers(shape: Any, kind: Any) -> Any:
    table = TopTools_IndexedMapOfShape()
    TopExp.MapShapes_s(shape, kind, table)
    return table


def _found(table: Any, shape: Any, kind: Any) -> list[int]:
    """Return the 0-based numbers in `table` of all parts of `shape` of a kind."""
    parts = _numbers(shape, kind)
    ids = [int(table.FindIndex(parts.FindKey(i + 1))) - 1 for i in range(parts.Extent())]
    return [i for i in ids if i >= 0]


def _remnants(table: Any, shape: Any) -> list[int]:
    """Return the 0-based numbers of the faces that are left of the faces of `shape`."""
    faces = [table.FindKey(i + 1) for i in range(table.Extent())]
    tagged = _numbers(shape, FACE)
    return [i for n in range(tagged.Extent()) for i in remnants(tagged.FindKey(n + 1), faces)]
