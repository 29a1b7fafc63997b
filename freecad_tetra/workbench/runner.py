# SPDX-License-Identifier: LGPL-2.1-or-later
"""The kernel works in a child process: FreeCAD's window stays alive, and so does FreeCAD."""

from __future__ import annotations

import dataclasses
import queue
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any

from freecad_tetra import brep
from freecad_tetra.errors import Cancelled, KernelMissing, TetraError
from freecad_tetra.model import ConvexCells, TetMesh
from freecad_tetra.workbench import kernel_path, workers
from freecad_tetra.workbench.child import Message
from freecad_tetra.workbench.piece_text import PieceText

TASKS = ("tetrahedralize", "convex_cells", "validate")
_INTERVAL = 0.1  # seconds between two calls of a caller's progress


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
    """One task at work; all methods belong to the thread that started it.

    Attributes
    ----------
    worker : workers.Worker
    finish : callable
        Turns what the task returns into the result.
    text : PieceText or None
        Of the pieces' shape, when one was wanted.
    """

    def __init__(self, worker: workers.Worker, shape: Any) -> None:
        self.worker = worker
        self.text: PieceText | None = None
        self.finish: Callable[[Any], Any] = lambda found: found
        self._shape = shape
        self._state = State()

    def poll(self) -> State:
        """Return how far it is; at once, save when the child asks for a finer tessellation."""
        while not self._state.done:
            try:
                message = self.worker.inbox.get_nowait()
            except queue.Empty:
                break
            self._take(message)
        return self._state

    def cancel(self) -> None:
        """End the work at once; `poll` tells `Cancelled` from now on."""
        if not self._state.done:
            self.worker.stop()
            self._end(error=Cancelled())

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
        try:
            while not self._state.done:
                now = (self._state.stage, self._state.fraction)
                if progress is not None and progress(*now) is False:
                    self.cancel()
                    break
                try:
                    self._take(self.worker.inbox.get(timeout=_INTERVAL))
                except queue.Empty:
                    continue
                self.poll()
        finally:
            self.cancel()  # nothing works on when the caller's progress raises
        if self._state.error is not None:
            raise self._state.error
        return self._state.result

    def _take(self, message: Message) -> None:
        kind = message[0]
        if kind == "progress":
            self._state = State(message[1], message[2])
        elif kind == "tessellate":
            self._answer(*message[1:])
        elif kind == "result":
            self.text = message[2]
            self._end(result=self.finish(_frozen(message[1])))
        elif kind == "error":
            self._end(error=message[1])
        else:
            self._end(error=self.worker.obituary())

    def _answer(self, deflection: brep.Deflection, name: str, only: int | None) -> None:
        try:
            self.worker.send(
                ("solid", brep.tessellate(self._shape, deflection, name=name, only=only))
            )
        except TetraError as error:
            self.worker.send(("error", error))

    def _end(self, result: Any = None, error: TetraError | None = None) -> None:
        self._state = State(self._state.stage, 1.0, True, result, error)


def start(
    task: str, source: Any, options: Mapping[str, Any] | None = None, shape_limit: int = 0
) -> Job:
    """Start a task of `freecad_tetra.api` in a child process and return at once.

    Parameters
    ----------
    task : {"tetrahedralize", "convex_cells", "validate"}
    source : Part.Shape, Solid or (vertices, triangles)
        A shape is tessellated here, in this process and thread, whenever the child asks.
    options : mapping, optional
        Keywords of the function of that name in `freecad_tetra.api`.
    shape_limit : int
        Up to how many pieces the child also makes the text of their shape.

    Raises
    ------
    KernelMissing
        With what to run.
    """
    if task not in TASKS:
        raise ValueError(f"no task {task}, only {', '.join(TASKS)}")
    problem = kernel_path.problem()
    if problem:
        raise KernelMissing(*problem.split(". ", 1))
    shape = brep.as_shape(source)
    worker = workers.hire(kernel_path.file())
    given = None if shape is not None else source
    worker.send(("task", task, given, dict(options or {}), shape_limit))
    return Job(worker, shape)


def _frozen(result: Any) -> Any:
    """Make arrays read-only again, which the way through a pipe has forgotten."""
    return dataclasses.replace(result) if isinstance(result, ConvexCells | TetMesh) else result
