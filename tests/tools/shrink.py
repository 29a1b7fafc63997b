# SPDX-License-Identifier: LGPL-2.1-or-later
"""Makes a failing solid smaller while it keeps failing: fewer shells, fewer vertices, less far."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator

import numpy as np
from random_solids import Surface, weld


def components(surface: Surface) -> list[Surface]:
    """Parts connected by shared vertices."""
    vertices, triangles = surface
    parent = np.arange(len(vertices))
    changed = True
    while changed:
        least = parent[triangles].min(axis=1)
        before = parent.copy()
        for k in range(3):
            np.minimum.at(parent, triangles[:, k], least)
        parent = parent[parent]
        changed = bool((before != parent).any())
    label = parent[triangles[:, 0]]
    return [weld(vertices, triangles[label == k]) for k in np.unique(label)]


def collapsed(surface: Surface, keep: int, drop: int) -> Surface:
    """One vertex moved onto another; vanished triangles and opposite pairs leave."""
    vertices, triangles = surface
    corners = np.where(triangles == drop, keep, triangles)
    rows = [t for t in corners.tolist() if len(set(t)) == 3]
    left: dict[tuple[int, ...], list[list[int]]] = {}
    for t in rows:
        left.setdefault(tuple(sorted(t)), []).append(t)
    kept = []
    for group in left.values():
        even = [t for t in group if _parity(t)]
        odd = [t for t in group if not _parity(t)]
        pairs = min(len(even), len(odd))
        kept += even[pairs:] + odd[pairs:]
    return weld(vertices, np.array(kept, dtype=np.int32).reshape(-1, 3))


def _parity(t: list[int]) -> bool:
    return ((t[0] > t[1]) + (t[1] > t[2]) + (t[0] > t[2])) % 2 == 0


def _nearer(surface: Surface) -> Iterator[Surface]:
    vertices, triangles = surface
    centred = vertices - vertices.min(axis=0)
    if (centred != vertices).any():
        yield centred, triangles
    for divisor in (16, 4, 2):
        if np.abs(vertices).max() > 8 * divisor:
            yield np.rint(vertices / divisor).astype(np.int64), triangles
    for axis in range(3):
        places, rank = np.unique(vertices[:, axis], return_inverse=True)
        if len(places) - 1 < places[-1] - places[0]:
            moved = vertices.copy()
            moved[:, axis] = rank.reshape(-1)
            yield moved, triangles


def shrink_recipe(
    make: Callable[..., Surface], seed: int, fails: Callable[[Surface], bool], seconds: float
) -> Surface:
    """Leave cells out of ``make(seed, without)`` while it fails; all of them may go but one."""
    surface = make(seed)
    end = time.monotonic() + seconds
    without: list[int] = []
    if len(make(seed, (0,))[1]) == len(surface[1]):
        return surface  # no voxel solid
    for cell in range(1000):
        if time.monotonic() > end:
            break
        try:
            candidate = make(seed, (*without, cell))
        except (IndexError, ValueError):
            break  # no such cell, or none left
        if len(candidate[1]) and fails(candidate):
            without.append(cell)
            surface = candidate
    return surface


def shrink(surface: Surface, fails: Callable[[Surface], bool], seconds: float = 60.0) -> Surface:
    """The smallest failing solid that greedy steps reach.

    Parameters
    ----------
    surface : Surface
        It fails.
    fails : callable
        Has to be false for surfaces that are invalid.
    seconds : float
        Stop after so long.
    """
    end = time.monotonic() + seconds
    for part in components(surface):
        if len(part[1]) < len(surface[1]) and fails(part):
            surface = part
            break
    progress = True
    while progress and time.monotonic() < end:
        progress = False
        for keep, drop in _edges(surface):
            if time.monotonic() > end:
                break
            candidate = _collapse_places(surface, keep, drop)
            if candidate is not None and fails(candidate):
                surface, progress = candidate, True
    progress = True
    while progress and time.monotonic() < end:
        progress = False
        for candidate in _nearer(surface):
            if fails(candidate):
                surface, progress = candidate, True
                break
    return surface


def _edges(surface: Surface) -> list[tuple[tuple[int, ...], tuple[int, ...]]]:
    """Both directions of every edge, as places: these outlive renumbering."""
    places = [tuple(row) for row in surface[0].tolist()]
    pairs = {(t[i], t[i - 1]) for t in surface[1].tolist() for i in range(3)}
    return [(places[a], places[b]) for a, b in sorted(pairs)]


def _collapse_places(
    surface: Surface, keep: tuple[int, ...], drop: tuple[int, ...]
) -> Surface | None:
    rows = {tuple(row): i for i, row in enumerate(surface[0].tolist())}
    if keep not in rows or drop not in rows:
        return None
    small = collapsed(surface, rows[keep], rows[drop])
    return small if len(small[1]) >= 4 else None
