# SPDX-License-Identifier: LGPL-2.1-or-later
"""The names that a caller gave to solids and to groups of faces."""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field


@dataclass(frozen=True)
class Labels:
    """Names kept from a CAD model to its results.

    Attributes
    ----------
    solids : tuple of str
        Name of solid 0, 1, ...; empty where it has none. No two are equal.
    faces : mapping of str to tuple of int
        Groups of faces (indices into ``face_names``); a face may belong to several.
    """

    solids: tuple[str, ...] = ()
    faces: Mapping[str, tuple[int, ...]] = field(default_factory=dict)

    def solid(self, number: int) -> str:
        """Return the name of a solid, ``Solid1`` for an unnamed solid 0."""
        known = self.solids[number] if 0 <= number < len(self.solids) else ""
        return known or f"Solid{number + 1}"


def group_name(text: str) -> str:
    """Return a name that every file format takes: letters, digits, ``_``, ``-`` and ``.``."""
    return re.sub(r"[^\w.\-]+", "_", text.strip())


def distinct(names: Iterable[str]) -> tuple[str, ...]:
    """Return the names with ``_2``, ``_3`` ... behind repeated ones; empty ones stay empty."""
    found: list[str] = []
    for name in names:
        wanted, count = name, 1
        while wanted and wanted in found:
            count += 1
            wanted = f"{name}_{count}"
        found.append(wanted)
    return tuple(found)
