# SPDX-License-Identifier: LGPL-2.1-or-later
"""Finds the compiled kernel for FreeCAD's own Python and brings in that one module.

Places, in this order: the checkout's own builds, its `.venv`, the packages of the Addon
Manager, and wherever Python looks. A folder of `.venv` never gets on sys.path: its numpy
would shadow FreeCAD's.
"""

from __future__ import annotations

import importlib
import importlib.machinery
import importlib.util
import sys
from pathlib import Path
from types import ModuleType

from freecad_tetra._version import __version__

MODULE = "_tetra_kernel"
ROOT = Path(__file__).resolve().parents[2]


def problem() -> str:
    """Return "" when the kernel is at hand, or what is wrong and what to run; never raises."""
    module = bring_in()
    if module is None:
        return f"The compiled kernel is missing. {_advice()}"
    found = _version_of(module)
    if found != __version__:
        return f"The compiled kernel is version {found}, the workbench {__version__}. {_advice()}"
    return ""


def file() -> str:
    """Return the file of the kernel that `bring_in` takes, "" without one."""
    module = bring_in()
    return str(getattr(module, "__file__", "") or "") if module is not None else ""


def bring_in() -> ModuleType | None:
    """Import the kernel, the first of the right version, else the first that loads, or None."""
    known = sys.modules.get(MODULE)
    if known is not None and _version_of(known) == __version__:
        return known
    others = []
    for path in candidates():
        module = load(path)
        if module is not None and _version_of(module) == __version__:
            return _keep(module)
        if module is not None:
            others.append(module)
    module = _import()
    if module is not None and (_version_of(module) == __version__ or not others):
        return _keep(module)
    return _keep(others[0]) if others else None


def candidates() -> list[Path]:
    """Return the files that may be the kernel for this Python, in the order of trial."""
    from freecad_tetra.workbench import compat  # not at hand in the child process

    suffixes = importlib.machinery.EXTENSION_SUFFIXES
    builds = sorted(ROOT.glob("build/*/kernel/bindings"))
    folders = [*builds, *sorted(ROOT.glob(".venv/lib*/python*/site-packages"))]
    folders += [ROOT / ".venv/Lib/site-packages", *compat.package_folders()]
    found = [folder / (MODULE + suffix) for suffix in suffixes for folder in folders]
    return [path for path in found if path.is_file()]


def load(path: Path) -> ModuleType | None:
    """Load the kernel from one file without keeping it; None when it is for another Python."""
    before = sys.modules.pop(MODULE, None)
    spec = importlib.util.spec_from_file_location(MODULE, path)
    if spec is None or spec.loader is None:
        return None
    try:
        module = importlib.util.module_from_spec(spec)
        spec.loader.exec_module(module)
        return module
    except ImportError:
        return None
    finally:
        if before is not None:
            sys.modules[MODULE] = before


def _import() -> ModuleType | None:
    try:
        return importlib.import_module(MODULE)
    except ImportError:
        return None


def _keep(module: ModuleType) -> ModuleType:
    sys.modules[MODULE] = module
    return module


def _version_of(module: ModuleType) -> str:
    tell = getattr(module, "version", None)
    return str(tell()) if callable(tell) else "unknown"


def _advice() -> str:
    if (ROOT / "Makefile").is_file() and (ROOT / "kernel").is_dir():
        return f"Run `make install-freecad` in {ROOT} and start FreeCAD again."
    from freecad_tetra.workbench import compat

    target = compat.package_folders()[0]
    return (
        f"Run `pip install --target {target} --no-deps freecad-tetra=={__version__}` "
        f"with Python {sys.version_info.major}.{sys.version_info.minor} and start FreeCAD again."
    )
