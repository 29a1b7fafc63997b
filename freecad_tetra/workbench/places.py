# SPDX-License-Identifier: LGPL-2.1-or-later
"""Where the icons, translations and forms of the workbench lie."""

from __future__ import annotations

from pathlib import Path

RESOURCES = Path(__file__).resolve().parents[2] / "resources"
ICONS = str(RESOURCES / "icons")
TRANSLATIONS = str(RESOURCES / "translations")
PREFERENCES = str(RESOURCES / "ui" / "preferences.ui")


def icon(name: str) -> str:
    """Return the path of an icon by its name without suffix."""
    return str(RESOURCES / "icons" / f"{name}.svg")
