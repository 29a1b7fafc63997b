# SPDX-License-Identifier: LGPL-2.1-or-later
"""Who does the work of a job: a child process, or where there can be none, a thread."""

from __future__ import annotations

import contextlib
import io
import queue
import signal
import subprocess
import tempfile
import threading
from pathlib import Path
from typing import Any, Protocol, cast

from freecad_tetra.errors import WorkerDied
from freecad_tetra.workbench import child, child_python
from freecad_tetra.workbench.child import Message

ROOT = Path(__file__).resolve().parents[2]
_START = """import sys
sys.path.insert(0, sys.argv[1])
sys.path.append(sys.argv[2])
from freecad_tetra.workbench import child
child.main(sys.argv[3])"""


class Worker(Protocol):
    """What a job needs of its worker.

    Attributes
    ----------
    inbox : queue of Message
        What the worker sends; ("ended",) is the last.
    """

    inbox: queue.Queue[Message]

    def send(self, message: Message) -> None:
        """Pass a message to the worker without waiting for it."""

    def stop(self) -> None:
        """End the work; returns at once."""

    def obituary(self) -> WorkerDied:
        """Return the error for a worker that has ended without a result."""


class Process:
    """A child process; it can be killed, and when it crashes FreeCAD does not."""

    def __init__(self, python: str, kernel: str) -> None:
        self.inbox: queue.Queue[Message] = queue.Queue()
        self._outbox: queue.Queue[Message | None] = queue.Queue()
        self._stderr = tempfile.TemporaryFile()  # noqa: SIM115 (closed with the last word)
        self._process = subprocess.Popen(
            [python, "-c", _START, str(ROOT), child_python.numpy_folder(), kernel],
            stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=self._stderr, bufsize=0,
            **child_python.no_window(),
        )  # fmt: skip
        for task in (self._write, self._read):
            threading.Thread(target=task, daemon=True).start()

    @property
    def pid(self) -> int:
        """Id of the child process."""
        return self._process.pid

    def send(self, message: Message) -> None:
        self._outbox.put(message)

    def stop(self) -> None:
        with contextlib.suppress(OSError):
            self._process.kill()
        self._outbox.put(None)

    def obituary(self) -> WorkerDied:
        code = self._process.wait()
        return WorkerDied(
            f"the child process that does the work {_fate(code)}{self._last_words()}",
            "nothing was changed; try again, and if it happens again report the part",
        )

    def _write(self) -> None:
        assert self._process.stdin is not None
        if hasattr(signal, "pthread_sigmask"):
            # FreeCAD leaves it to the system what a broken pipe means: the end of FreeCAD. Nothing
            # is buffered either, which another thread would write when it lets go of the pipe.
            signal.pthread_sigmask(signal.SIG_BLOCK, [signal.SIGPIPE])
        with contextlib.suppress(OSError, ValueError):
            while (message := self._outbox.get()) is not None:
                child.write_message(self._process.stdin, message)

    def _read(self) -> None:
        reading = io.BufferedReader(cast(io.RawIOBase, self._process.stdout))
        with contextlib.suppress(Exception):  # a child that dies may leave half a message
            while (message := child.read_message(reading)) is not None:
                self.inbox.put(message)
        self._process.wait()
        self._outbox.put(None)
        self.inbox.put(("ended",))

    def _last_words(self) -> str:
        self._stderr.seek(0)
        lines = self._stderr.read().decode(errors="replace").split("\n")
        told = [line.strip() for line in lines if line.strip()]
        return f' ("{told[-1][:200]}")' if told else ""


def _fate(code: int) -> str:
    if code >= 0:
        return f"has ended with code {code}"
    name = signal.Signals(-code).name
    return "was killed (out of memory?)" if name == "SIGKILL" else f"has crashed ({name})"


class Thread:
    """A thread of this process, for platforms without a Python to start; it stops at the next
    report of progress."""

    def __init__(self) -> None:
        self.inbox: queue.Queue[Message] = queue.Queue()
        self._outbox: queue.Queue[Message] = queue.Queue()
        self._stopped = threading.Event()
        threading.Thread(target=self._work, daemon=True).start()

    def send(self, message: Message) -> None:
        self._outbox.put(message)

    def stop(self) -> None:
        self._stopped.set()
        self._outbox.put(("error", WorkerDied("stopped")))

    def obituary(self) -> WorkerDied:
        return WorkerDied("the thread that does the work has ended", "please report the part")

    def _work(self) -> None:
        child.work(self._outbox.get, self.inbox.put, self._stopped.is_set)
        self.inbox.put(("ended",))


def hire(kernel: str) -> Any:
    """Return a child process with the kernel of that file, or a thread when none can start."""
    python = child_python.find()
    if python:
        with contextlib.suppress(OSError):
            return Process(python, kernel)
    return Thread()
