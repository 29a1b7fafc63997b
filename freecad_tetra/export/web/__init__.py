# SPDX-License-Identifier: LGPL-2.1-or-later
"""One self-contained HTML page that turns pieces about and draws them apart, by WebGL."""

from __future__ import annotations

import base64
import html
import json
from pathlib import Path
from typing import Any

import numpy as np

from freecad_tetra.export.scene import Scene

_HERE = Path(__file__).parent


def page(scene: Scene, title: str = "freecad_tetra") -> str:
    """Return the page as text; it holds script, style and data, and loads nothing.

    Points are in single precision there.
    """
    sizes = np.diff(scene.offsets)
    data = {
        "title": title,
        "kind": scene.kind,
        "points": _packed(scene.points - _middle(scene), "<f4"),
        "sizes": _packed(sizes, "<u2"),
        "corners": _packed(scene.corners, "<u4"),
        "piece": _packed(scene.piece, "<u4"),
        "face": _packed(scene.face, "<i4"),
        "quality": _packed(np.clip(scene.quality, 0, 1), "<f4"),
    }
    text = (_HERE / "page.html").read_text(encoding="utf-8")
    parts = {
        "TITLE": html.escape(title),
        "STYLE": (_HERE / "page.css").read_text(encoding="utf-8"),
        "SCRIPT": (_HERE / "view.js").read_text(encoding="utf-8"),
        # "<" could end the script it stands in.
        "DATA": json.dumps(data).replace("<", "\\u003c"),
    }
    for name, part in parts.items():
        text = text.replace(f"@{name}@", part)
    return text


def frame(scene: Scene, height: int = 480) -> str:
    """Return an iframe with the page, for notebooks."""
    return (
        f'<iframe srcdoc="{html.escape(page(scene))}" sandbox="allow-scripts" '
        f'style="width: 100%; height: {height}px; border: 0"></iframe>'
    )


def _middle(scene: Scene) -> Any:
    used = scene.points[scene.corners]
    return (used.min(axis=0) + used.max(axis=0)) / 2


def _packed(values: Any, kind: str) -> str:
    return base64.b64encode(np.asarray(values).astype(kind).tobytes()).decode("ascii")
