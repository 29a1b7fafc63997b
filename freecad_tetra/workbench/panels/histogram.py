# SPDX-License-Identifier: LGPL-2.1-or-later
"""A histogram as a picture: one bar for each class, its count above, its bounds below."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from freecad_tetra.workbench import compat

WIDTH, HEIGHT = 320, 150
ABOVE, BELOW = 16, 18
BAR = "#4d9aa3"


def labels(bounds: Sequence[float]) -> list[str]:
    """Return what stands below the edges between the bars, short: 1e-4 for 0.0001."""
    return [f"{b:.0e}".replace("e-0", "e-") if 0 < b < 1e-2 else f"{b:g}" for b in bounds]


def picture(counts: Sequence[int], bounds: Sequence[float], palette: Any) -> Any:
    """Return a QPixmap.

    Parameters
    ----------
    counts : (n,) int
    bounds : (n - 1,) float
        Between neighbouring classes.
    palette : QPalette
        Of the widget that shows it, for the colours of text and ground.
    """
    core, gui, _ = compat.qt()
    pixmap = gui.QPixmap(WIDTH, HEIGHT)
    pixmap.fill(palette.color(gui.QPalette.Base))
    painter = gui.QPainter(pixmap)
    try:
        font = painter.font()
        font.setPointSizeF(7.0)
        painter.setFont(font)
        painter.setPen(palette.color(gui.QPalette.Text))
        _draw(painter, gui.QColor(BAR), core.Qt.AlignCenter, counts, labels(bounds))
    finally:
        painter.end()
    return pixmap


def _draw(
    painter: Any, colour: Any, centred: Any, counts: Sequence[int], texts: Sequence[str]
) -> None:
    step = WIDTH / max(1, len(counts))
    room = HEIGHT - ABOVE - BELOW
    most = max([*counts, 1])
    for i, count in enumerate(counts):
        tall = round(room * count / most)
        if count:
            left = int(i * step) + 2
            painter.fillRect(left, HEIGHT - BELOW - tall, int(step) - 3, max(tall, 1), colour)
            top = HEIGHT - BELOW - tall - ABOVE
            painter.drawText(int(i * step), top, int(step), ABOVE, centred, str(count))
    painter.drawLine(0, HEIGHT - BELOW, WIDTH, HEIGHT - BELOW)
    for i, text in enumerate(texts):
        middle = int((i + 1) * step)
        painter.drawText(middle - 30, HEIGHT - BELOW, 60, BELOW, centred, text)
