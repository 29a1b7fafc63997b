# SPDX-License-Identifier: LGPL-2.1-or-later
"""Finds the Python that runs child processes: FreeCAD's own, as a program of its own."""

from __future__ import annotations

import functools
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np

_PATIENCE = 20.0  # seconds for a Python to start on a loaded machine
_PROBE = "import sys; sys.path.append(sys.argv[1]); import numpy; print(sys.version_info[:2], "
_PROBE += "numpy.__version__)"


def no_window() -> dict[str, Any]:
    """Return the keywords that keep Windows from opening a console for a child."""
    flag = getattr(subprocess, "CREATE_NO_WINDOW", 0)
    return {"creationflags": flag} if flag else {}


def numpy_folder() -> str:
    """Return the folder that holds FreeCAD's numpy, for the end of the child's path."""
    return str(Path(np.__file__).resolve().parents[1])


@functools.lru_cache(maxsize=1)
def find() -> str:
    """Return a Python of FreeCAD's version with FreeCAD's numpy, or "" when there is none.

    sys.executable is FreeCAD itself there; its Python lies beside it in bundles and in the
    system's folder in distributions. Each candidate is started once.
    """
    return next((str(path) for path in candidates() if _fits(path)), "")


def candidates() -> Iterator[Path]:
    """Yield the programs that may be FreeCAD's Python, each once."""
    version = f"{sys.version_info.major}.{sys.version_info.minor}"
    own = Path(sys.executable or "")
    folders = [own.parent, *(Path(p) / "bin" for p in (sys.prefix, sys.base_prefix))]
    folders += [Path(sys.prefix), Path(sys.base_prefix)]
    names = (f"python{version}", "python3", "python", "python.exe")
    paths = [own] if own.name.lower().startswith("python") else []
    paths += [folder / name for folder in folders for name in names]
    yield from dict.fromkeys(path for path in paths if path.is_file())


def _fits(path: Path) -> bool:
    wanted = f"{tuple(sys.version_info[:2])} {np.__version__}"
    command = [str(path), "-c", _PROBE, numpy_folder()]
    try:
        done = subprocess.run(
            command, capture_output=True, text=True, timeout=_PATIENCE, stdin=subprocess.DEVNULL,
            **no_window(),
        )  # fmt: skip
    except (OSError, subprocess.SubprocessError):
        return False
    return done.returncode == 0 and done.stdout.strip() == wanted
