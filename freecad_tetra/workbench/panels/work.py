# SPDX-License-Identifier: LGPL-2.1-or-later
"""Follows a job in the background from the thread of the window, ten times a second."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from freecad_tetra.workbench import compat
from freecad_tetra.workbench.runner import Job, State

INTERVAL = 100  # milliseconds


class Work:
    """One job at a time; tells how far it is and, once, how it ended."""

    def __init__(self, tell: Callable[[State], None], end: Callable[[State], None]) -> None:
        core, _, _ = compat.qt()
        self._tell = tell
        self._end = end
        self._job: Job | None = None
        self._timer = core.QTimer()
        self._timer.setInterval(INTERVAL)
        self._timer.timeout.connect(self._look)

    def end_with(self, form: Any) -> None:
        """Stop the job when a widget is gone: FreeCAD may close a panel without asking it."""
        form.destroyed.connect(lambda *gone: self.drop())

    def follow(self, job: Job) -> None:
        """Follow a job from now on; the one before is cancelled and forgotten."""
        self.drop()
        self._job = job
        self._timer.start()

    def cancel(self) -> None:
        """Stop the job; its end is told at once."""
        if self._job is not None:
            self._job.cancel()
            self._look()

    def drop(self) -> None:
        """Stop the job without a word, when the panel is closed."""
        self._timer.stop()
        job, self._job = self._job, None
        if job is not None:
            job.cancel()

    def _look(self) -> None:
        if self._job is None:
            return
        state = self._job.poll()
        self._tell(state)
        if state.done:
            self._timer.stop()
            self._job = None
            self._end(state)
