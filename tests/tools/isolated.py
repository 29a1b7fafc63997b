# SPDX-License-Identifier: LGPL-2.1-or-later
"""Runs many small jobs in worker processes, so that a crash or a hang costs one job only."""

from __future__ import annotations

import multiprocessing
import os
import time
from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass
from multiprocessing.connection import Connection, wait
from pathlib import Path
from typing import Any


@dataclass
class Outcome:
    """What became of one job: `kind` is "done", the name of an exception, "crash" or "timeout"."""

    job: Any
    kind: str
    message: str = ""
    value: Any = None


def _serve(pipe: Connection, work: Callable[[Any], Any]) -> None:
    while True:
        job = pipe.recv()
        try:
            pipe.send(Outcome(job, "done", value=work(job)))
        except Exception as error:
            pipe.send(Outcome(job, type(error).__name__, str(error)[:2000]))


class _Worker:
    def __init__(self, work: Callable[[Any], Any]) -> None:
        context = multiprocessing.get_context("fork")
        self.pipe, theirs = context.Pipe()
        self.process = context.Process(target=_serve, args=(theirs, work), daemon=True)
        self.process.start()
        theirs.close()
        self.job: Any = None
        self.since = self.before = 0.0

    def give(self, job: Any) -> None:
        self.job, self.since, self.before = job, time.monotonic(), self._processor_seconds()
        self.pipe.send(job)

    def _processor_seconds(self) -> float:
        """All that the process has used so far."""
        stat = Path(f"/proc/{self.process.pid}/stat").read_text(encoding="ascii")
        user, system = stat.rpartition(")")[2].split()[11:13]
        return (int(user) + int(system)) / os.sysconf("SC_CLK_TCK")

    def exceeds(self, seconds: float) -> bool:
        """Whether the job hangs; on a busy machine it may just have had no turn yet."""
        waited = time.monotonic() - self.since
        if waited <= seconds:
            return False
        return waited > 60 * seconds or self._processor_seconds() - self.before > seconds

    def stop(self) -> None:
        self.process.kill()
        self.process.join()
        self.pipe.close()


def run_isolated(
    work: Callable[[Any], Any], jobs: Iterable[Any], processes: int = 1, timeout: float = 60.0
) -> Iterator[Outcome]:
    """Yield the outcome of each job as it ends, in any order.

    Parameters
    ----------
    work : callable
        Runs in a forked process; may use anything loaded before.
    jobs : iterable
    processes : int
    timeout : float
        Processor seconds after which a job is killed.
    """
    waiting = iter(jobs)
    workers: list[_Worker] = []
    for job in (j for _, j in zip(range(processes), waiting)):
        workers.append(_Worker(work))
        workers[-1].give(job)
    while workers:
        ready = wait([w.pipe for w in workers], timeout=0.5)
        for worker in list(workers):
            outcome = None
            if worker.pipe in ready:
                try:
                    outcome = worker.pipe.recv()
                except EOFError:
                    worker.process.join()
                    text = f"exit code {worker.process.exitcode}"
                    outcome = Outcome(worker.job, "crash", text)
            elif worker.exceeds(timeout):
                outcome = Outcome(worker.job, "timeout", f"{timeout:g} s")
            if outcome is None:
                continue
            job = next(waiting, None)
            if job is None or outcome.kind in ("crash", "timeout"):
                worker.stop()
                workers.remove(worker)
                if job is not None:
                    workers.append(_Worker(work))
                    workers[-1].give(job)
            else:
                worker.give(job)
            yield outcome
