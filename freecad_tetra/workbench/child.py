# SPDX-License-Identifier: LGPL-2.1-or-later
"""The worker's side of a job: it receives one task, tells its progress, sends the result.

It runs in a Python without FreeCAD. Shapes stay with the parent, which tessellates them when
asked, so that the rules of `freecad_tetra.api` for finer tessellations hold here unchanged.
"""

from __future__ import annotations

import os
import pickle
import queue
import struct
import sys
import threading
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from time import monotonic
from typing import IO, Any

from freecad_tetra import kernel_file
from freecad_tetra.brep import Deflection
from freecad_tetra.errors import Cancelled, TetraError
from freecad_tetra.model import Solid
from freecad_tetra.workbench.piece_text import piece_text

Message = tuple[Any, ...]
Send = Callable[[Message], None]
Receive = Callable[[], Message]

_QUIET = 0.02  # seconds between two messages about one stage
_SIZE = struct.Struct("<q")


def write_message(stream: IO[bytes], message: Message) -> None:
    """Write one message, its length first, to a stream without a buffer."""
    data = pickle.dumps(message, protocol=4)
    left = memoryview(_SIZE.pack(len(data)) + data)
    while left:
        left = left[stream.write(left) :]


def read_message(stream: IO[bytes]) -> Message | None:
    """Read one message; None at the end of the stream."""
    head = stream.read(_SIZE.size)
    if len(head) < _SIZE.size:
        return None
    (size,) = _SIZE.unpack(head)
    data = stream.read(size)
    found: Message | None = pickle.loads(data) if len(data) == size else None
    return found


def work(receive: Receive, send: Send, stopped: Callable[[], bool] = lambda: False) -> None:
    """Do one task; whatever happens, send ("result", ...) or ("error", TetraError).

    The result comes with the text of its shape, None when it has more pieces than asked for.

    Parameters
    ----------
    receive : callable
        Returns ("task", name, source or None for a shape of the parent's, options, pieces up to
        which a shape is wanted), later ("solid", Solid) or ("error", TetraError) in answer to
        ("tessellate", ...).
    send : callable
        Takes ("progress", stage, fraction) and ("tessellate", deflection, name, only).
    stopped : callable
        Asked whenever there is progress.
    """
    try:
        _, task, source, options, limit = receive()
        shape = _ParentShape(receive, send) if source is None else source
        progress = _Progress(send, stopped)
        found = _tasks()[task](shape, progress=progress, **options)
        shaped = None
        if limit and len(found) <= limit:
            progress("shape", 0.0)
            shaped = piece_text(found)
        send(("result", found, shaped))
    except TetraError as error:
        send(("error", error))
    except MemoryError:
        send(("error", TetraError("out of memory", "a larger linear deflection needs less")))
    except Exception as error:
        text = f"{type(error).__name__}: {error}"
        send(("error", TetraError(text, "please report the part; nothing was changed")))


def _tasks() -> dict[str, Callable[..., Any]]:
    from freecad_tetra import api

    return {
        "tetrahedralize": api.tetrahedralize,
        "convex_cells": api.convex_cells,
        "validate": api.validate,
    }


@dataclass(frozen=True)
class _ParentShape:
    """A shape that the parent holds; see `freecad_tetra.brep.as_shape`."""

    receive: Receive
    send: Send

    def tessellated(self, deflection: Deflection, name: str = "", only: int | None = None) -> Solid:
        self.send(("tessellate", deflection, name, only))
        kind, answer = self.receive()
        if kind == "error":
            raise answer
        found: Solid = answer
        return found


class _Progress:
    """Tells every new stage, and how far it is not too often."""

    def __init__(self, send: Send, stopped: Callable[[], bool]) -> None:
        self._send = send
        self._stopped = stopped
        self._stage = ""
        self._next = 0.0

    def __call__(self, stage: str, fraction: float) -> bool:
        if self._stopped():
            raise Cancelled()
        now = monotonic()
        if stage != self._stage or now >= self._next:
            self._stage, self._next = stage, now + _QUIET
            self._send(("progress", stage, float(fraction)))
        return True


def main(kernel: str) -> None:
    """Be the child process: messages come on stdin and go to stdout."""
    reading = os.fdopen(os.dup(0), "rb")
    writing = os.fdopen(os.dup(1), "wb", buffering=0)
    os.dup2(2, 1)  # what anything prints must not get between the messages
    module = kernel_file.load(Path(kernel)) if kernel else None
    if module is not None:
        sys.modules[kernel_file.MODULE] = module
    inbox: queue.Queue[Message] = queue.Queue()
    threading.Thread(target=_listen, args=(reading, inbox), daemon=True).start()
    work(inbox.get, lambda message: write_message(writing, message))
    os._exit(0)  # tidying up large arrays is nobody's business


def _listen(reading: IO[bytes], inbox: queue.Queue[Message]) -> None:
    """Pass messages on; without a parent there is no work to do."""
    while (message := read_message(reading)) is not None:
        inbox.put(message)
    os._exit(1)
