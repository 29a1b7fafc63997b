# SPDX-License-Identifier: LGPL-2.1-or-later
"""The only door to mmg3d, an optional program that rebuilds tetrahedra of good shape.

It is run as a process of its own on Medit files: its Python package wants a newer numpy than
FreeCAD brings, and a crash of it must not take the caller along.
"""

from __future__ import annotations

import ctypes
import os
import shutil
import signal
import subprocess
import sys
import tempfile
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from time import monotonic
from typing import Any

import numpy as np

from freecad_tetra.errors import Cancelled, TetraError

PROGRAMS = ("mmg3d_O3", "mmg3d")
VARIABLE = "TETRA_MMG3D"  # path of the program, where it is in no usual place
Table = dict[str, Any]

# Columns of the sections that are read and written; the last one is the reference, if any.
_INTEGER = {"Triangles": 4, "Tetrahedra": 5, "Edges": 3, "Corners": 1, "Ridges": 1}
_POLL = 0.1  # seconds


class RemeshingFailed(TetraError):
    """mmg3d gave no mesh; the message is its own."""


def find(folders: Sequence[str | Path] = ()) -> Path | None:
    """Return the program: TETRA_MMG3D, inside a package mmgpy, beside Python, or on the PATH.

    Parameters
    ----------
    folders : sequence of path
        Where packages are, besides those of this Python.
    """
    named = os.environ.get(VARIABLE)
    if named:
        return Path(named) if Path(named).is_file() else None
    # The scripts that pip installs start Python for nothing; the program is in the package.
    packages = [Path(entry) / "mmgpy" / "bin" for entry in (*folders, *sys.path) if entry]
    for place in (*packages, Path(sys.executable).parent):
        for program in PROGRAMS:
            if (place / program).is_file():
                return place / program
    found = [shutil.which(program) for program in PROGRAMS]
    return next((Path(path) for path in found if path), None)


def run(
    program: Path,
    tables: Mapping[str, Any],
    options: Sequence[str],
    local: str = "",
    told: Callable[[float], bool | None] | None = None,
    limit: float = 1800.0,
) -> Table:
    """Remesh and return the tables of the result.

    Parameters
    ----------
    program : Path
        From `find`.
    tables : mapping of str to array
        Sections of a Medit file, ids from 1: Vertices (n, 3), Triangles (s, 4), Tetrahedra (t, 5),
        Edges (e, 3) with references last, Ridges and Corners (k,).
    options : sequence of str
        Words of the command line.
    local : str
        Text of a parameter file with sizes by reference.
    told : callable, optional
        ``told(seconds)``, ten times a second; returning False cancels.
    limit : float
        Seconds after which the program is stopped.

    Raises
    ------
    RemeshingFailed, Cancelled
    """
    with tempfile.TemporaryDirectory(prefix="tetra_mmg_") as folder:
        source, target = Path(folder, "in.mesh"), Path(folder, "out.mesh")
        source.write_bytes(medit(tables))
        if local:
            Path(folder, "in.mmg3d").write_text(local)
        command = [str(program), "-v", "1", *options, "-in", str(source), "-out", str(target)]
        text, code = _watched(command, folder, _environment(program), told, limit)
        if code or not target.is_file():
            raise RemeshingFailed(
                f"mmg3d ended with status {code}: {_reason(text)}",
                "try another size, or leave the mesh as it is",
            )
        return parse(target.read_bytes())


def _environment(program: Path) -> dict[str, str]:
    """Return the environment, with the libraries that the package keeps beside the program."""
    environment = dict(os.environ)
    # FreeCAD's own libraries and Python must not leak into the program.
    for name in ("LD_LIBRARY_PATH", "PYTHONHOME", "PYTHONPATH"):
        environment.pop(name, None)
    library = program.resolve().parent.parent / "lib"
    if library.is_dir() and any(library.glob("libmmg3d*")):
        environment["LD_LIBRARY_PATH"] = str(library)
    return environment


def _watched(
    command: Sequence[str], folder: str, environment: Mapping[str, str], told: Any, limit: float
) -> tuple[str, int]:
    """Run a command until it ends, the caller cancels or the limit passes."""
    log = Path(folder, "log.txt")
    start = monotonic()
    with log.open("wb") as stream:
        process = subprocess.Popen(
            command, cwd=folder, env=dict(environment), stdin=subprocess.DEVNULL,
            stdout=stream, stderr=subprocess.STDOUT,
            preexec_fn=_die_with_parent if sys.platform == "linux" else None,
        )  # fmt: skip
        try:
            while True:
                try:
                    code = process.wait(_POLL)
                    break
                except subprocess.TimeoutExpired:
                    pass
                spent = monotonic() - start
                if told is not None and told(spent) is False:
                    raise Cancelled()
                if spent > limit:
                    raise RemeshingFailed(
                        f"mmg3d was stopped after {limit:.0f} s", "choose a larger size"
                    )
        finally:
            if process.poll() is None:
                process.kill()
                process.wait()
    return log.read_text(errors="replace"), code


def _die_with_parent() -> None:
    """Ask Linux to end the program when its caller is killed, and not to work on for nobody."""
    ctypes.CDLL(None).prctl(1, int(signal.SIGKILL))


def _reason(text: str) -> str:
    rows = [row.strip(" #") for row in text.splitlines()]
    told = [row for row in rows if "rror" in row or "nable" in row or "xit" in row]
    return "; ".join(told[:3]) or (rows[-1] if rows else "no message")


def medit(tables: Mapping[str, Any]) -> bytes:
    """Return tables as a Medit file in ascii; all digits of the coordinates are kept."""
    parts = ["MeshVersionFormatted 2\n\nDimension 3\n"]
    for name, table in tables.items():
        rows = np.asarray(table)
        rows = rows[:, None] if rows.ndim == 1 else rows
        parts.append(f"\n{name}\n{len(rows)}\n")
        pattern = "%.17g %.17g %.17g 0\n" if name == "Vertices" else "%d " * rows.shape[1] + "\n"
        if len(rows):
            parts.append(pattern * len(rows) % tuple(rows.reshape(-1).tolist()))
    parts.append("\nEnd\n")
    return "".join(parts).encode("ascii")


def parse(data: bytes) -> Table:
    """Return the tables of an ascii Medit file; references come last, ids from 1.

    Raises
    ------
    RemeshingFailed
        The file is truncated.
    """
    words = data.split()
    out: Table = {name: np.zeros((0, width), np.int64) for name, width in _INTEGER.items()}
    at = 0
    while at < len(words):
        name = words[at].decode("ascii", "replace")
        width = 4 if name == "Vertices" else _INTEGER.get(name)
        at += 1
        if width is None:
            continue
        count = int(words[at])
        flat = words[at + 1 : at + 1 + count * width]
        if len(flat) != count * width:
            raise RemeshingFailed(f"mmg3d wrote a truncated section {name}")
        kind = np.float64 if name == "Vertices" else np.int64
        out[name] = np.array(flat, dtype=kind).reshape(count, width)
        at += 1 + count * width
    if "Vertices" not in out or not len(out["Tetrahedra"]):
        raise RemeshingFailed("mmg3d wrote no tetrahedra")
    return out
