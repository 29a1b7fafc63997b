# SPDX-License-Identifier: LGPL-2.1-or-later
"""Runs the exact layer of the kernel on batches of operands, through a small C++ program."""

from __future__ import annotations

import os
import subprocess
from collections.abc import Iterable, Sequence
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
SOURCES = [
    ROOT / "kernel/tests/exact_probe.cpp",
    *(
        ROOT / "kernel/src/exact" / f"{name}.cpp"
        for name in ("grid", "predicates", "plane", "hpoint")
    ),
]

Operand = int | float


def build_probe() -> Path:
    """Compile the probe, with the undefined-behaviour sanitizer, unless it is up to date.

    Returns
    -------
    Path
        The executable, below build/.
    """
    program = ROOT / "build" / "exact_probe"
    headers = (ROOT / "kernel/include/tetra/exact").glob("*.h")
    newest = max(path.stat().st_mtime for path in (*SOURCES, *headers))
    if program.exists() and program.stat().st_mtime > newest:
        return program
    program.parent.mkdir(exist_ok=True)
    fresh = program.with_suffix(f".{os.getpid()}")
    command = ["c++", "-std=c++20", "-O1", "-fsanitize=undefined", "-fno-sanitize-recover=all"]
    command += ["-ffp-contract=off", f"-I{ROOT / 'kernel/include'}", "-o", str(fresh)]
    subprocess.run([*command, *map(str, SOURCES)], check=True, timeout=300)
    fresh.replace(program)
    return program


def encode(value: Operand) -> str:
    return value.hex() if isinstance(value, float) else format(value, "x")


def decode(word: str) -> Operand:
    return float.fromhex(word) if "0x" in word or word in ("inf", "-inf", "nan") else int(word, 16)


def evaluate(name: str, cases: Iterable[Sequence[Operand]]) -> list[list[Operand]]:
    """Evaluate one operation of kernel/tests/exact_probe.cpp on many operand lists.

    Parameters
    ----------
    name : str
        The operation.
    cases : iterable of sequences of int or float
        Its operands, one sequence for each evaluation.

    Returns
    -------
    list of lists of int or float
        What it gave, in the same order.
    """
    lines = [" ".join((name, *map(encode, case))) for case in cases]
    done = subprocess.run(
        [str(build_probe())],
        input="\n".join(lines) + "\n",
        capture_output=True,
        text=True,
        timeout=300,
    )
    if done.returncode:
        raise AssertionError(f"exact_probe failed on {name}: {done.stderr.strip()}")
    results = [[decode(word) for word in line.split()] for line in done.stdout.splitlines()]
    assert len(results) == len(lines)
    return results
