# SPDX-License-Identifier: LGPL-2.1-or-later
"""Interpreters that have a peer of ours, apart from the product's environment."""

from __future__ import annotations

import subprocess
import venv
from pathlib import Path


def python_with(requirement: str, folder: Path) -> Path:
    """Return the interpreter of the environment in `folder`, with ``name==version`` in it."""
    python = folder / "bin/python"
    if not python.exists():
        venv.create(folder, with_pip=True)
    name = requirement.partition("==")[0]
    look = [python, "-c", f"import {name}"]
    if subprocess.run(look, check=False, capture_output=True).returncode:
        subprocess.run([python, "-m", "pip", "install", "--quiet", requirement], check=True)
    return python
