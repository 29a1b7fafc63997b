# SPDX-License-Identifier: LGPL-2.1-or-later
"""Solids of a B-rep that touch get common faces, so that these are tessellated once.

Without it the two sides of a contact have triangles of their own: on curved faces these do not
match, and on slanted planes rounding makes them cross. OpenCascade's general fuse divides the
faces where they touch and shares the parts; nothing is united, every solid keeps its volume.
"""

from __future__ import annotations

from collections import Counter
from dataclasses import dataclass
from typing import Any

from OCP.Bnd import Bnd_Box
from OCP.BOPAlgo import BOPAlgo_Builder
from OCP.BRepBndLib import BRepBndLib
from OCP.TopAbs import TopAbs_ShapeEnum
from OCP.TopExp import TopExp
from OCP.TopTools import TopTools_IndexedMapOfShape

FACE, SOLID = TopAbs_ShapeEnum.TopAbs_FACE, TopAbs_ShapeEnum.TopAbs_SOLID

# Faces are told by the kernel's exact test too: a slip of the modeller's size is enough here.
GAP = 1e-6


@dataclass(frozen=True)
class SharedSolids:
    """Solids that share the faces in which they touch.

    Attributes
    ----------
    shape : TopoDS_Shape
        Holds all of them.
    solids : list of TopoDS_Shape
        One for each solid that was given.
    origin : list of TopTools_IndexedMapOfShape to face numbers
        Per solid: 1-based index in `faces` to the 0-based number of the face it is part of.
    faces : TopTools_IndexedMapOfShape
    contacts : int
        Faces that two solids share.
    """

    shape: Any
    solids: list[Any]
    origin: list[dict[int, int]]
    faces: Any
    contacts: int


def share_contacts(solids: list[Any], numbers: Any) -> SharedSolids | None:
    """Return the solids with common faces, or None when none touch in a face.

    Parameters
    ----------
    solids : list of TopoDS_Solid
    numbers : TopTools_IndexedMapOfShape
        The faces of the model; a face's index less one is its number.

    None is also the answer where the solids overlap or OpenCascade fails: what is wrong is then
    told by the validation of the solids as they are.
    """
    if len(solids) < 2 or not _boxes_touch(solids):
        return None
    builder = BOPAlgo_Builder()
    for solid in solids:
        builder.AddArgument(solid)
    builder.SetNonDestructive(True)
    builder.SetRunParallel(False)
    builder.Perform()
    if builder.HasErrors():
        return None
    images = [_images(builder, solid) for solid in solids]
    if any(len(parts) != 1 for parts in images):
        return None
    faces = TopTools_IndexedMapOfShape()
    TopExp.MapShapes_s(builder.Shape(), FACE, faces)
    origin = [_origin(builder, solid, faces, numbers) for solid in solids]
    uses = Counter(index for table in origin for index in table)
    contacts = sum(count > 1 for count in uses.values())
    if contacts == 0:
        return None
    return SharedSolids(builder.Shape(), [p[0] for p in images], origin, faces, contacts)


def _boxes_touch(solids: list[Any]) -> bool:
    boxes = []
    for solid in solids:
        box = Bnd_Box()
        BRepBndLib.Add_s(solid, box, False)
        box.Enlarge(GAP)
        boxes.append(box)
    return any(not a.IsOut(b) for i, a in enumerate(boxes) for b in boxes[i + 1 :])


def _images(builder: Any, shape: Any) -> list[Any]:
    """Return what a shape became, itself when nothing."""
    if builder.IsDeleted(shape):
        return []
    return list(builder.Modified(shape)) or [shape]


def _origin(builder: Any, solid: Any, faces: Any, numbers: Any) -> dict[int, int]:
    own = TopTools_IndexedMapOfShape()
    TopExp.MapShapes_s(solid, FACE, own)
    table: dict[int, int] = {}
    for i in range(1, own.Extent() + 1):
        face = own.FindKey(i)
        for part in _images(builder, face):
            table[int(faces.FindIndex(part))] = int(numbers.FindIndex(face)) - 1
    return table
