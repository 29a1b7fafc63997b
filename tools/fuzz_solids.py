# SPDX-License-Identifier: LGPL-2.1-or-later
"""What the two long fuzz runs share: seeds, isolation, shrinking, saved cases and figures."""

from __future__ import annotations

import argparse
import re
import sys
import time
from collections import Counter
from collections.abc import Callable
from pathlib import Path
from typing import Any

ROOT = Path(__file__).resolve().parents[1]
sys.path.insert(0, str(ROOT / "tests" / "tools"))

from isolated import Outcome, run_isolated  # noqa: E402
from random_solids import Surface, to_off  # noqa: E402
from shrink import shrink, shrink_recipe  # noqa: E402

Check = Callable[[Surface, dict[str, Any]], dict[str, float]]
Job = tuple[int, dict[str, Any]]


def parse_arguments(description: str, count: int) -> argparse.Namespace:
    parser = argparse.ArgumentParser(description=description)
    parser.add_argument("--count", type=int, default=count, help="number of solids")
    parser.add_argument("--first", type=int, default=0, help="seed of the first")
    parser.add_argument("--processes", type=int, default=2)
    parser.add_argument("--timeout", type=float, default=60.0, help="seconds for one solid")
    parser.add_argument("--seconds", type=float, default=None, help="start no more after this")
    parser.add_argument("--shrink", type=float, default=60.0, help="seconds for each failure")
    parser.add_argument("--keep", type=int, default=2, help="cases saved of each failure")
    parser.add_argument("--cases", type=Path, default=ROOT / "tests" / "cases")
    return parser.parse_args()


def stem(message: str) -> str:
    """The message without its numbers, to tell one failure from another."""
    return re.sub(r"[-\d.,\[\]()e ]+", " ", message)[:80]


def save_case(
    name: str, outcome: Outcome, make: Callable[..., Surface], check: Check, seconds: float
) -> Callable[[Path], Path]:
    """Shrink a failing solid; returns a function that writes it into a folder as .off."""
    seed, options = outcome.job
    surface = make(seed)

    def fails(candidate: Surface) -> bool:
        # In a process of its own: the failure may be a crash.
        found = next(iter(run_isolated(lambda s: check(s, options), [candidate], 1, 20.0)))
        return (found.kind, stem(found.message)) == (outcome.kind, stem(outcome.message))

    small = surface
    if seconds > 0 and fails(surface):
        small = shrink(shrink_recipe(make, seed, fails, seconds), fails, seconds)

    def write(folder: Path) -> Path:
        folder.mkdir(parents=True, exist_ok=True)
        path = folder / f"{name}-{seed}.off"
        text = outcome.message.splitlines()[0][:200] if outcome.message else ""
        remark = f"# seed {seed}, options {options}: {outcome.kind} {text}\n"
        path.write_text(to_off(small) + remark, encoding="utf-8")
        return path

    return write


def run(
    name: str,
    arguments: argparse.Namespace,
    make: Callable[..., Surface],
    options_of: Callable[[int], dict[str, Any]],
    check: Check,
) -> int:
    """Run all seeds, save and list what fails; returns the number of failures."""
    start = time.monotonic()
    kinds: Counter[str] = Counter()
    totals: Counter[str] = Counter()
    failures: list[Outcome] = []

    def jobs():
        for seed in range(arguments.first, arguments.first + arguments.count):
            if arguments.seconds is not None and time.monotonic() - start > arguments.seconds:
                return
            yield seed, options_of(seed)

    def work(job: Job) -> dict[str, float]:
        return check(make(job[0]), job[1])

    for outcome in run_isolated(work, jobs(), arguments.processes, arguments.timeout):
        kinds[outcome.kind] += 1
        if outcome.kind == "done":
            totals.update(outcome.value)
        elif outcome.kind != "Unfit":
            failures.append(outcome)
            print(f"{outcome.job}: {outcome.kind} {outcome.message[:300]}", flush=True)
            same = (outcome.kind, stem(outcome.message))
            if sum(same == (f.kind, stem(f.message)) for f in failures) <= arguments.keep:
                write = save_case(name, outcome, make, check, arguments.shrink)
                print(f"  saved as {write(arguments.cases)}", flush=True)
        done = sum(kinds.values())
        if done % 1000 == 0:
            print(f"{done} solids, {time.monotonic() - start:.0f} s: {dict(kinds)}", flush=True)
    spent = time.monotonic() - start
    print(f"{name}: {sum(kinds.values())} solids in {spent:.0f} s: {dict(kinds)}")
    print("sums over all that passed:", {k: round(v, 12) for k, v in sorted(totals.items())})
    print(f"{len(failures)} failures")
    return len(failures)
