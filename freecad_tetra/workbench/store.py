# SPDX-License-Identifier: LGPL-2.1-or-later
"""Pieces go into the properties of a document object, and come back when it is opened again.

All numbers are in one list of doubles, which FreeCAD saves in binary: coordinates bit for bit,
ids as whole numbers.
"""

from __future__ import annotations

import json
from typing import Any

import numpy as np

from freecad_tetra.errors import InvalidSolid, TetraError
from freecad_tetra.model import ConvexCells, Report, Tet10Mesh, TetMesh

_ARRAYS = {
    "TetMesh": ("points", "tets", "skin", "skin_face", "skin_source", "tet_solid", "point_source"),
    "ConvexCells": ("points", "facet_offsets", "facet_vertices", "cell_offsets", "facet_source",
                    "facet_face", "cell_solid", "point_source"),
}  # fmt: skip
_KINDS = {"TetMesh": TetMesh, "ConvexCells": ConvexCells}


def write(obj: Any, pieces: ConvexCells | TetMesh) -> None:
    """Set PieceData, PieceLayout, ReportData and the figures of an object."""
    kind = type(pieces).__name__
    arrays = [getattr(pieces, name) for name in _ARRAYS[kind]]
    layout = {
        "kind": kind,
        "shapes": [list(a.shape) for a in arrays],
        "face_names": list(pieces.face_names),
    }
    obj.PieceData = np.concatenate([a.ravel() for a in arrays]).astype(np.float64).tolist()
    obj.PieceLayout = json.dumps(layout, separators=(",", ":"))
    figures(obj, pieces)


def figures(obj: Any, pieces: ConvexCells | TetMesh | Tet10Mesh) -> None:
    """Set ReportData and the read-only figures of an object."""
    report = pieces.report
    obj.ReportData = json.dumps(report.to_dict(), separators=(",", ":"))
    obj.Pieces = len(pieces)
    obj.Notches = int(report.counts.get("notches", 0))
    obj.SteinerPoints = int((pieces.point_source < 0).sum())
    obj.VolumeError = float(report.volume_error)
    seconds = report.seconds
    obj.Seconds = float(seconds.get("validate", 0.0) + seconds.get("kernel", 0.0))


def read(obj: Any) -> ConvexCells | TetMesh | None:
    """Return the pieces of an object, None before its first run.

    Raises
    ------
    TetraError
        The document is damaged.
    """
    if not getattr(obj, "PieceLayout", ""):
        return None
    try:
        layout = json.loads(obj.PieceLayout)
        numbers = np.array(obj.PieceData, np.float64)
        shapes = [tuple(shape) for shape in layout["shapes"]]
        cuts = np.cumsum([int(np.prod(shape)) for shape in shapes])
        if len(numbers) != cuts[-1]:
            raise ValueError(f"{len(numbers)} numbers in place of {cuts[-1]}")
        arrays = [a.reshape(s) for a, s in zip(np.split(numbers, cuts[:-1]), shapes)]
        fields = dict(zip(_ARRAYS[layout["kind"]], arrays))
        made: ConvexCells | TetMesh = _KINDS[layout["kind"]](
            **fields, face_names=tuple(layout["face_names"]), report=report(obj)
        )
        return made
    except (ValueError, KeyError, TypeError, InvalidSolid) as error:
        raise TetraError(
            f"the pieces stored in {obj.Label} are damaged: {error}", "recompute the object"
        ) from error


def report(obj: Any) -> Report:
    """Return the report stored in an object, an empty one before its first run."""
    if not getattr(obj, "ReportData", ""):
        return Report()
    raw = json.loads(obj.ReportData)
    raw.pop("defects", None)
    return Report(**{k: v for k, v in raw.items() if k in Report.__dataclass_fields__})
