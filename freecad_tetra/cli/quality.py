# SPDX-License-Identifier: LGPL-2.1-or-later
"""What ``freecad-tetra quality FILE`` prints: extremes, and histograms as bars."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from freecad_tetra.fem.quality import quality_of
from freecad_tetra.io.results import read_tets

_WIDTH = 40


def measure(path: str) -> dict[str, Any]:
    """Return the figures of a mesh file; see `freecad_tetra.fem.quality.Quality.to_dict`."""
    stored = read_tets(path)
    tets = stored.tets
    if stored.middles is not None:
        tets = np.hstack([tets, stored.middles])
    return quality_of(stored.points, tets).to_dict()


def lines(found: Mapping[str, Any]) -> list[str]:
    """Return the text for people."""
    if not found["elements"]:
        return ["elements         0"]
    kind = "tet10" if found["order"] == 2 else "tet4"
    rows = [
        ("elements", f"{found['elements']} {kind}"),
        ("dihedral angles", f"{found['min_dihedral_degrees']:.4g} to "
         f"{np.degrees(found['max_dihedral']):.4g} degrees"),
        ("mean ratio", f"{found['min_mean_ratio']:.4g} least, {found['mean_ratio']:.4g} mean"),
        ("scaled Jacobian", f"{found['min_scaled_jacobian']:.4g} least"),
        ("not positive", f"{found['nonpositive_jacobians']}"),
        ("worst elements", ", ".join(str(i) for i in found["worst_elements"][:5])),
    ]  # fmt: skip
    out = [f"{label:<16} {value}" for label, value in rows]
    out += ["", "least dihedral angle, degrees"]
    out += _bars(found["dihedral_histogram"], found["dihedral_histogram_bounds"])
    out += ["", "mean ratio"]
    return out + _bars(found["histogram"], found["histogram_bounds"])


def _bars(counts: Sequence[int], bounds: Sequence[float]) -> list[str]:
    """Return a line per class; any element at all shows as one mark."""
    names = [f"below {bounds[0]:g}", *(f"from {b:g}" for b in bounds)]
    most = max(max(counts), 1)
    return [
        f"  {name:<12} {count:>9} {'#' * -(-count * _WIDTH // most)}".rstrip()
        for name, count in zip(names, counts)
    ]
