# SPDX-License-Identifier: LGPL-2.1-or-later
"""Browsers and notebooks: results as a self-contained page with an interactive 3D view."""

from __future__ import annotations

from freecad_tetra.export import web
from freecad_tetra.export.scene import scene_of
from freecad_tetra.model import ConvexCells, TetMesh

# A notebook stores what it shows: above this many corners of facets it gets words instead.
MOST_CORNERS = 1_500_000


def page(result: ConvexCells | TetMesh) -> str:
    """Return a whole HTML page."""
    return web.page(scene_of(result))


def frame(result: ConvexCells | TetMesh) -> str:
    """Return an iframe with the page, or a line about a result that is too big for one."""
    scene = scene_of(result)
    if len(scene.corners) > MOST_CORNERS:
        return f"<p>{len(result)} {scene.kind}; to_html() shows them in a browser</p>"
    return web.frame(scene)
