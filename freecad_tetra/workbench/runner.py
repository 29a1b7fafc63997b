# SPDX-License-Identifier: LGPL-2.1-or-later
"""The kernel works in a child process: FreeCAD's window stays alive, and so does FreeCAD."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any

from freecad_tetra.errors import TetraError


@dataclass(frozen=True)
class State:
    """How far a job is.

    Attributes
    ----------
    stage : str
        Of the kernel, such as ``validate`` or ``cut``.
    fraction : float
        Of the stage, 0 to 1.
    done : bool
    result : object or None
        What the task returns, once done without an error.
    error : TetraError or None
        `Cancelled` after `Job.cancel`, `WorkerDied` when the child was killed or crashed.
    """

    stage: str = "start"
    fraction: float = 0.0
    done: bool = False
    result: Any = None
    error: TetraError | None = None


class Job:
    """One task at work; all methods belong to the thread that started it."""

    def poll(self) -> State:
        """Return how far it is; at once, save when the child asks for a finer tessellation."""
        raise NotImplementedError

    def cancel(self) -> None:
        """End the work within half a second; `poll` tells `Cancelled` from now on."""
        raise NotImplementedError

    def wait(self, progress: Callable[[str, float], bool | None] | None = None) -> Any:
        """Block until done and return the result.

        Parameters
        ----------
        progress : callable, optional
            ``progress(stage, fraction)``, called ten times a second; False cancels.

        Raises
        ------
        TetraError
            That of the task, `Cancelled` or `WorkerDied`.
        """
        raise NotImplementedError


def start(task: str, source: Any, options: Mapping[str, Any] | None = None) -> Job:
    """Start a task of `freecad_tetra.api` in a child process and return at once.

    Parameters
    ----------
    task : {"tetrahedralize", "convex_cells", "validate"}
    source : Part.Shape, Solid or (vertices, triangles)
        A shape is tessellated here, in this process and thread, whenever the child asks.
    options : mapping, optional
        Keywords of the function of that name in `freecad_tetra.api`.
    """
    raise NotImplementedError
