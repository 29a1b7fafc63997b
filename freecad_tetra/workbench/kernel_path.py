# SPDX-License-Identifier: LGPL-2.1-or-later
"""The compiled kernel for FreeCAD's own Python: where it is, or what to run to get it."""

from __future__ import annotations

import sys
from types import ModuleType

from freecad_tetra import kernel_file
from freecad_tetra._version import __version__
from freecad_tetra.workbench import compat


def problem() -> str:
    """Return "" when the kernel is at hand, or what is wrong and what to run; never raises."""
    module = bring_in()
    if module is None:
        return f"The compiled kernel is missing. {_advice()}"
    found = kernel_file.version_of(module)
    if found != __version__:
        return f"The compiled kernel is version {found}, the workbench {__version__}. {_advice()}"
    return ""


def file() -> str:
    """Return the file of the kernel that `bring_in` takes, "" without one."""
    module = bring_in()
    return str(getattr(module, "__file__", "") or "") if module is not None else ""


def bring_in() -> ModuleType | None:
    """Import the kernel from the checkout, its .venv or the packages of the Addon Manager."""
    return kernel_file.bring_in(compat.package_folders())


def _advice() -> str:
    root = kernel_file.ROOT
    if (root / "Makefile").is_file() and (root / "kernel").is_dir():
        return f"Run `make install-freecad` in {root} and start FreeCAD again."
    target = compat.package_folders()[0]
    return (
        f"Run `pip install --target {target} --no-deps freecad-tetra=={__version__}` "
        f"with Python {sys.version_info.major}.{sys.version_info.minor} and start FreeCAD again."
    )
