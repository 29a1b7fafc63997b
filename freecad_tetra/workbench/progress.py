# SPDX-License-Identifier: LGPL-2.1-or-later
"""A recompute waits for a job: in the window with FreeCAD's progress bar, whose Esc cancels."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import FreeCAD

from freecad_tetra.errors import Cancelled
from freecad_tetra.workbench.runner import Job

_STEPS = 100


def wait(job: Job, label: str) -> Any:
    """Return the result of a job.

    Raises
    ------
    TetraError
        That of the job; `Cancelled` when the user has pressed Esc.
    """
    if not FreeCAD.GuiUp:
        return job.wait()
    bar = _Bar(label)
    try:
        return job.wait(bar.show)
    except RuntimeError as error:  # FreeCAD's word for Esc
        raise Cancelled() from error
    finally:
        bar.close()


def watched(work: Callable[[Callable[[str, float], bool]], Any], label: str) -> Any:
    """Return what `work` does in this thread, telling its progress to the callable it is given.

    Raises
    ------
    TetraError
        That of the work; `Cancelled` when the user has pressed Esc.
    """
    if not FreeCAD.GuiUp:
        return work(lambda stage, fraction: True)
    bar = _Bar(label)
    try:
        return work(bar.show)
    except RuntimeError as error:  # FreeCAD's word for Esc
        raise Cancelled() from error
    finally:
        bar.close()


class _Bar:
    """FreeCAD's progress bar, started anew for every stage."""

    def __init__(self, label: str) -> None:
        self._label = label
        self._stage = ""
        self._done = 0
        self._bar: Any = None

    def show(self, stage: str, fraction: float) -> bool:
        if stage != self._stage:
            self.close()
            self._bar = FreeCAD.Base.ProgressIndicator()
            self._bar.start(f"{self._label}: {stage}...", _STEPS)
            self._stage, self._done = stage, 0
        for _ in range(self._done, min(_STEPS, int(fraction * _STEPS))):
            self._bar.next(True)
            self._done += 1
        return True

    def close(self) -> None:
        if self._bar is not None:
            self._bar.stop()
            self._bar = None
