# SPDX-License-Identifier: LGPL-2.1-or-later
"""One line of progress on stderr, when that is a terminal."""

from __future__ import annotations

import sys
import time
from collections.abc import Callable


class Meter:
    """A progress callback for the kernel; silent in pipes and files.

    Parameters
    ----------
    told : callable, optional
        ``told(stage)`` is called whenever the stage changes.
    """

    def __init__(self, told: Callable[[str], None] | None = None) -> None:
        self._told = told
        self._stage = ""
        self._last = 0.0
        self._shown = 0
        self._live = sys.stderr.isatty()

    def __call__(self, stage: str, fraction: float) -> bool:
        if stage != self._stage:
            self._stage, self._last = stage, 0.0
            if self._told is not None:
                self._told(stage)
        now = time.monotonic()
        if self._live and now - self._last >= 0.1:
            self._last = now
            self._show(f"{stage.replace('_', ' ')} {100 * fraction:3.0f} %")
        return True

    def clear(self) -> None:
        """Wipe the line, before anything else is printed."""
        if self._shown:
            self._show("")
            self._shown = 0

    def _show(self, text: str) -> None:
        print("\r" + text.ljust(self._shown), end="" if text else "\r", file=sys.stderr, flush=True)
        self._shown = max(self._shown, len(text))
