# SPDX-License-Identifier: LGPL-2.1-or-later
"""The work runs in a child process, so that Ctrl-C answers at once and a crash is told.

OpenCascade neither polls for cancellation nor survives every broken file: the parent waits
for the child, stops it when asked to, removes what it left half written and turns a crash
into an exit code.
"""

from __future__ import annotations

import argparse
import contextlib
import ctypes
import os
import signal
import sys
from pathlib import Path
from types import FrameType

from freecad_tetra.export import temporary_name

CANCELLED = 130
_PATIENCE = 0.1  # seconds that the child has to stop by itself
_SET_PARENT_DEATH_SIGNAL = 1
_READING = ("start", "read", "tessellate")


class _Asked:
    """Whether this process, as the child, was asked to stop."""

    yet = False


def run(arguments: argparse.Namespace) -> int:
    """Run one command and return its exit code; without ``fork``, in this process."""
    from freecad_tetra.cli import commands

    if not hasattr(os, "fork"):
        return commands.run(arguments)
    reading, writing = os.pipe()
    sys.stdout.flush()
    sys.stderr.flush()
    child = os.fork()
    if child == 0:
        os.close(reading)
        os._exit(_work(arguments, writing))
    os.close(writing)
    return _watch(arguments, child, reading)


def _work(arguments: argparse.Namespace, writing: int) -> int:
    """Be the child; whatever happens, return a code and flush."""
    from freecad_tetra.cli import commands

    _die_with_parent()
    signal.signal(signal.SIGINT, _interrupt_once)
    signal.signal(signal.SIGTERM, _interrupt_once)
    code = CANCELLED
    try:
        code = commands.run(arguments, lambda stage: _tell(writing, stage), lambda: _Asked.yet)
        sys.stdout.flush()
    except KeyboardInterrupt:
        code = CANCELLED
    except BrokenPipeError:  # the reader of stdout has gone, which is not a failure
        code = 0
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
    finally:
        try:
            sys.stderr.flush()
        except (BrokenPipeError, ValueError):
            code = code or CANCELLED
    return code


def _die_with_parent() -> None:
    """Ask Linux to end this process when the parent is killed, and not to work on for nobody."""
    if sys.platform == "linux":
        with contextlib.suppress(OSError, AttributeError):
            ctypes.CDLL(None).prctl(_SET_PARENT_DEATH_SIGNAL, int(signal.SIGKILL))


def _interrupt_once(number: int, frame: FrameType | None) -> None:
    """Interrupt once; a terminal and the parent may both send the signal."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    signal.signal(signal.SIGTERM, signal.SIG_IGN)
    _Asked.yet = True
    raise KeyboardInterrupt


def _tell(writing: int, stage: str) -> None:
    os.write(writing, stage.encode() + b"\n")


class _Killed(Exception):
    """The child did not stop in time."""


class _Watch:
    """Signal handlers of the parent."""

    def __init__(self, child: int) -> None:
        self.child = child
        self.asked = False

    def stop(self, number: int, frame: FrameType | None) -> None:
        if not self.asked:
            self.asked = True
            self._send(signal.SIGINT)
            signal.setitimer(signal.ITIMER_REAL, _PATIENCE)

    def kill(self, number: int, frame: FrameType | None) -> None:
        """End the child; the system may need a while to clear its memory, nobody waits for that."""
        self._send(signal.SIGKILL)
        raise _Killed

    def _send(self, number: int) -> None:
        with contextlib.suppress(ProcessLookupError):
            os.kill(self.child, number)


def _watch(arguments: argparse.Namespace, child: int, reading: int) -> int:
    """Be the parent: wait, stop the child when asked to, tell how it ended."""
    watch = _Watch(child)
    old = {
        signal.SIGINT: signal.signal(signal.SIGINT, watch.stop),
        signal.SIGTERM: signal.signal(signal.SIGTERM, watch.stop),
        signal.SIGALRM: signal.signal(signal.SIGALRM, watch.kill),
    }
    status = None
    try:
        try:
            _, status = os.waitpid(child, 0)
        finally:
            signal.setitimer(signal.ITIMER_REAL, 0)
    except _Killed:
        pass
    for number, handler in old.items():
        signal.signal(number, handler)
    if status is not None and os.WIFEXITED(status):
        return os.WEXITSTATUS(status)
    _remove_parts(arguments, child)
    if status is None or watch.asked:
        print("cancelled", file=sys.stderr, flush=True)
        os._exit(CANCELLED)  # tidying up the interpreter may take longer than a user waits
    stages = _drain(reading)
    return _crashed(os.WTERMSIG(status), stages[-1] if stages else "start")


def _drain(reading: int) -> list[str]:
    with os.fdopen(reading, "rb") as stream:
        return stream.read().decode().split()


def _remove_parts(arguments: argparse.Namespace, child: int) -> None:
    for name in ("output", "surface", "report"):
        path = getattr(arguments, name, None)
        if path:
            temporary_name(Path(path), child).unlink(missing_ok=True)


def _crashed(number: int, stage: str) -> int:
    name = signal.Signals(number).name
    if number == signal.SIGKILL:
        print(f"error: killed by the system at {stage} (out of memory?)", file=sys.stderr)
        return 5
    if stage in _READING:
        print(f"error: OpenCascade crashed on this file ({name}, {stage})", file=sys.stderr)
        return 4
    print(f"error: the kernel crashed ({name}, {stage}); please report the part", file=sys.stderr)
    return 5
