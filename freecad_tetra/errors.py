# SPDX-License-Identifier: LGPL-2.1-or-later
"""Every failure that a caller may meet, typed, with the ids at fault and the next step.

The library raises these and nothing else for bad input; it never prints and never exits.
Indices are 0-based, names of B-rep faces are FreeCAD's (``Face1`` is the first).
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any


@dataclass(frozen=True)
class Defect:
    """One reason why a surface does not bound a solid.

    Attributes
    ----------
    kind : str
        Snake-case name of the cause: ``open_edge``, ``inconsistent_orientation``,
        ``degenerate_triangle``, ``duplicate_triangle``, ``self_crossing``,
        ``nonfinite_coordinate``, ``flat_solid``, ``empty``, ``bad_nesting``,
        ``non_planar_contact``, ``bad_index``, ``no_solid``, ``scale_out_of_range``.
    message : str
        One line for people.
    vertices, triangles : tuple of int
        0-based ids in the caller's arrays.
    faces : tuple of str
        B-rep faces (or input polygons) that carry the triangles.
    """

    kind: str
    message: str
    vertices: tuple[int, ...] = ()
    triangles: tuple[int, ...] = ()
    faces: tuple[str, ...] = ()

    def to_dict(self) -> dict[str, Any]:
        """Return plain JSON types."""
        return {
            "kind": self.kind,
            "message": self.message,
            "vertices": list(self.vertices),
            "triangles": list(self.triangles),
            "faces": list(self.faces),
        }

    def __str__(self) -> str:
        where = []
        if self.faces:
            where.append("faces " + _some(self.faces))
        if self.triangles:
            where.append("triangles " + _some(self.triangles))
        if self.vertices:
            where.append("vertices " + _some(self.vertices))
        tail = f" ({'; '.join(where)})" if where else ""
        return f"{self.kind}: {self.message}{tail}"


def _some(ids: Sequence[Any], limit: int = 12) -> str:
    """Join the first ids of a list, saying how many are left out."""
    shown = ", ".join(str(i) for i in ids[:limit])
    rest = len(ids) - limit
    return shown if rest <= 0 else f"{shown} and {rest} more"


class TetraError(Exception):
    """Base of every error of this package.

    Attributes
    ----------
    message : str
        What is wrong, one line.
    next_step : str
        What the caller can do about it.
    """

    def __init__(self, message: str, next_step: str = "") -> None:
        super().__init__(message)
        self.message = message
        self.next_step = next_step

    def __str__(self) -> str:
        return f"{self.message}; {self.next_step}" if self.next_step else self.message

    def __reduce__(self) -> tuple[Any, ...]:
        """Keep all attributes on the way to another process, whatever ``__init__`` takes."""
        return _revived, (type(self), self.args, self.__dict__)


def _revived(kind: type[TetraError], args: tuple[Any, ...], state: dict[str, Any]) -> TetraError:
    error = kind.__new__(kind, *args)
    error.args = args
    error.__dict__.update(state)
    return error


class InvalidSolid(TetraError):
    """The input is readable but does not bound a solid; ``defects`` says where."""

    def __init__(self, defects: Sequence[Defect], message: str = "", next_step: str = "") -> None:
        self.defects = tuple(defects)
        kinds = sorted({d.kind for d in self.defects})
        count = len(self.defects)
        text = message or f"not a valid solid: {count} defect{'s' * (count != 1)}" + (
            f" ({', '.join(kinds)})" if kinds else ""
        )
        super().__init__(text, next_step or "repair the faces named and try again")


class InvalidPolygon(TetraError):
    """The loops do not bound a region: they cross, overlap or name missing points.

    Attributes
    ----------
    edges : tuple of (loop, corner)
        Edges at fault, each from a corner of a loop to the next.
    points : tuple of int
    """

    def __init__(
        self, message: str, edges: Sequence[tuple[int, int]] = (), points: Sequence[int] = ()
    ) -> None:
        self.edges = tuple((int(a), int(b)) for a, b in edges)
        self.points = tuple(int(p) for p in points)
        super().__init__(message, "repair the edges named and try again")


class UnreadableFile(TetraError):
    """A file that is missing, empty, truncated or not what its suffix says."""

    def __init__(self, path: object, reason: str, next_step: str = "") -> None:
        self.path = str(path)
        self.reason = reason
        super().__init__(
            f"cannot read {self.path}: {reason}",
            next_step or "check the file or export it again",
        )


class UnsupportedFormat(TetraError):
    """A suffix or a variant of a format that is not handled."""


class BadOption(TetraError):
    """An option has a value that the kernel does not know."""


class VerificationFailed(TetraError):
    """The kernel's own check rejected its result; nothing was handed out."""

    def __init__(self, message: str, next_step: str = "", cells: Sequence[int] = ()) -> None:
        self.cells = tuple(cells)
        super().__init__(message, next_step or "please report the part; no result was written")


class Cancelled(TetraError):
    """The caller stopped the work through ``progress`` or Ctrl-C."""

    def __init__(self, message: str = "cancelled", next_step: str = "") -> None:
        super().__init__(message, next_step)


class WorkerDied(TetraError):
    """The child process that did the work was killed or crashed; nothing was changed."""


class KernelMissing(TetraError):
    """The compiled module ``_tetra_kernel`` is absent or of another version."""

    def __init__(self, reason: str, next_step: str = "") -> None:
        super().__init__(
            reason,
            next_step or "build it with `make`, or `pip install --force-reinstall freecad-tetra`",
        )


class MissingDependency(TetraError):
    """An optional package is needed for this and is not installed."""

    def __init__(self, package: str, purpose: str, pip_name: str = "") -> None:
        self.package = package
        super().__init__(
            f"{purpose} needs the package {package}", f"pip install {pip_name or package}"
        )
