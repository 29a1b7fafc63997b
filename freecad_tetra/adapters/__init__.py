# SPDX-License-Identifier: LGPL-2.1-or-later
"""Hand results to other libraries, and take theirs; one library per file, imported on use."""

from __future__ import annotations

import importlib
from typing import Any

from freecad_tetra.errors import MissingDependency


def require(package: str, purpose: str, pip_name: str = "") -> Any:
    """Import an optional package.

    Raises
    ------
    MissingDependency
        With the pip command that installs it.
    """
    try:
        return importlib.import_module(package)
    except ImportError as error:
        raise MissingDependency(package, purpose, pip_name) from error
