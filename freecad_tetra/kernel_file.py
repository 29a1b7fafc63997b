# SPDX-License-Identifier: LGPL-2.1-or-later
"""Finds the compiled module of a checkout that is used where it lies, as FreeCAD uses a Mod.

Places, in this order: the checkout's own builds, its `.venv`, folders that the caller names,
and wherever Python looks. A folder of `.venv` never gets on sys.path: its numpy would shadow
that of the program.
"""

from __future__ import annotations

import importlib
import importlib.machinery
import importlib.util
import sys
from collections.abc import Sequence
from pathlib import Path
from types import ModuleType

from freecad_tetra._version import __version__

MODULE = "_tetra_kernel"
ROOT = Path(__file__).resolve().parents[1]


def bring_in(folders: Sequence[Path] = ()) -> ModuleType | None:
    """Import the kernel, the first of the right version, else the first that loads, or None."""
    if MODULE in sys.modules and sys.modules[MODULE] is None:
        return None  # Python's word for a module that must not be imported
    known = sys.modules.get(MODULE)
    if known is not None and version_of(known) == __version__:
        return known
    others = []
    for path in candidates(folders):
        module = load(path)
        if module is not None and version_of(module) == __version__:
            return _keep(module)
        if module is not None:
            others.append(module)
    module = _import()
    if module is not None and (version_of(module) == __version__ or not others):
        return _keep(module)
    return _keep(others[0]) if others else None


def candidates(folders: Sequence[Path] = ()) -> list[Path]:
    """Return the files that may be the kernel for this Python, in the order of trial."""
    places = sorted(ROOT.glob("build/*/kernel/bindings"))
    places += [*checkout_packages(), *folders]
    names = [MODULE + suffix for suffix in importlib.machinery.EXTENSION_SUFFIXES]
    found = dict.fromkeys(place / name for place in places for name in names)
    return [path for path in found if path.is_file()]


def checkout_packages() -> list[Path]:
    """Return the folders of packages of the checkout's `.venv`."""
    found = sorted(ROOT.glob(".venv/lib*/python*/site-packages"))
    return [*found, ROOT / ".venv/Lib/site-packages"]


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


def version_of(module: ModuleType) -> str:
    """Return the version that a kernel tells."""
    tell = getattr(module, "version", None)
    return str(tell()) if callable(tell) else "unknown"


def _import() -> ModuleType | None:
    try:
        return importlib.import_module(MODULE)
    except ImportError:
        return None


def _keep(module: ModuleType) -> ModuleType:
    sys.modules[MODULE] = module
    return module
