#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Check that layers include and import only what docs/decisions and DESIGN 6 allow them to.

C++: exact <- solid <- polygon <- {notch | fence} <- assemble <- bindings.
Python: errors <- model <- {kernel | brep | io | export | fem} <- adapters <- api <- {cli |
workbench}.
FreeCAD and OCP are never imported in one module, as one process cannot hold both.

Usage: ``check_layers.py ROOT``; prints one line per breach, exit status 1 when there is one.
"""

from __future__ import annotations

import ast
import re
import sys
from pathlib import Path

CXX_ALLOWED: dict[str, set[str]] = {
    "exact": set(),
    "solid": {"exact"},
    "polygon": {"exact", "solid"},
    "notch": {"exact", "solid", "polygon"},
    "fence": {"exact", "solid", "polygon"},
    "assemble": {"exact", "solid", "polygon", "notch", "fence"},
    "bindings": {"exact", "solid", "polygon", "notch", "fence", "assemble"},
}

PYTHON_RANK = {
    "_version": 0,
    "kernel_file": 1,
    "errors": 0,
    "labels": 0,
    "conversions": 0,
    "model": 1,
    "mass": 2,
    "kernel": 3,
    "brep": 3,
    "io": 3,
    "export": 3,
    "verify": 3,
    "directions": 3,
    "fem": 3,
    "check": 3,
    "limits": 4,
    "adapters": 4,
    "api": 5,
    "__init__": 6,
    "cli": 7,
    "cq": 7,
    "__main__": 8,
    "workbench": 7,
}
# Modules of equal rank see nothing of each other, save for these, which serve all of their rank.
PYTHON_SHARED = {"_version", "errors"}

KERNEL_ONLY = {"_tetra_kernel": "kernel"}
INCLUDE = re.compile(r'^\s*#\s*include\s*[<"]([^>"]+)[>"]', re.MULTILINE)


def cxx_layer(path: Path) -> str | None:
    """Layer of a file below ``kernel/``, or None for what is common to all or a test."""
    parts = path.parts
    if parts[0] == "bindings":
        return "bindings"
    if parts[0] == "src" and len(parts) > 2:
        return parts[1]
    if parts[:2] == ("include", "tetra") and len(parts) > 3:
        return parts[2]
    return None


def cxx_breaches(root: Path) -> list[str]:
    """Breaches of the rule for includes, one line each."""
    breaches = []
    kernel = root / "kernel"
    for path in sorted([*kernel.rglob("*.h"), *kernel.rglob("*.cpp")]):
        relative = path.relative_to(kernel)
        layer = cxx_layer(relative)
        if layer is None and relative.parts[0] == "tests":
            continue
        if layer is not None and layer not in CXX_ALLOWED:
            breaches.append(f"{path.relative_to(root)}: unknown layer {layer}")
            continue
        allowed = CXX_ALLOWED[layer] | {layer} if layer else set()
        for included in INCLUDE.findall(path.read_text(encoding="utf-8")):
            target = included_layer(included, path, kernel)
            if target is not None and target not in allowed:
                name = layer or "common header"
                breaches.append(f"{path.relative_to(root)}: {name} includes {included}")
            if layer != "bindings" and re.match(r"(nanobind/|Python\.h)", included):
                breaches.append(f"{path.relative_to(root)}: only bindings may include {included}")
    return breaches


def included_layer(included: str, path: Path, kernel: Path) -> str | None:
    """Layer of an included header, None when it belongs to none (system, common)."""
    parts = Path(included).parts
    if parts[0] == "tetra":
        return parts[1] if len(parts) > 2 else None
    beside = (path.parent / included).resolve()
    if beside.is_file() and beside.is_relative_to(kernel.resolve()):
        return cxx_layer(beside.relative_to(kernel.resolve()))
    return None


def python_breaches(root: Path) -> list[str]:
    """Breaches of the rule for imports, one line each."""
    breaches = []
    package = root / "freecad_tetra"
    for path in sorted(package.rglob("*.py")):
        name = path.relative_to(root)
        layer = path.relative_to(package).parts[0].removesuffix(".py")
        if layer not in PYTHON_RANK:
            breaches.append(f"{name}: unknown layer {layer}")
            continue
        imported = imported_modules(path, package)
        tops = {module.split(".")[0] for module in imported}
        if {"FreeCAD", "FreeCADGui", "Part"} & tops and "OCP" in tops:
            breaches.append(f"{name}: imports FreeCAD and OCP")
        for module, owner in KERNEL_ONLY.items():
            if module in tops and layer != owner:
                breaches.append(f"{name}: only {owner} may import {module}")
        for module in sorted(imported):
            parts = module.split(".")
            if parts[0] != "freecad_tetra":
                continue
            target = parts[1] if len(parts) > 1 else "__init__"
            if not python_allowed(layer, target):
                breaches.append(f"{name}: {layer} imports {target}")
    return breaches


def python_allowed(layer: str, target: str) -> bool:
    """Whether a module of ``layer`` may import one of ``target``."""
    if layer == target or target in PYTHON_SHARED:
        return True
    return target in PYTHON_RANK and PYTHON_RANK[target] < PYTHON_RANK[layer]


def imported_modules(path: Path, package: Path) -> set[str]:
    """Absolute names of all modules that a file imports, wherever in it, types only included.

    ``from freecad_tetra import kernel`` counts as the module ``freecad_tetra.kernel`` when there
    is one.
    """
    inside = ("freecad_tetra", *path.relative_to(package).with_suffix("").parts)
    found: set[str] = set()
    for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
        if isinstance(node, ast.Import):
            found |= {alias.name for alias in node.names}
        elif isinstance(node, ast.ImportFrom):
            base = ".".join(inside[: len(inside) - node.level]) if node.level else ""
            module = ".".join(part for part in (base, node.module or "") if part)
            if module == "freecad_tetra":
                found |= {submodule(alias.name, package) for alias in node.names}
            else:
                found.add(module)
    return found


def submodule(name: str, package: Path) -> str:
    """``freecad_tetra.name`` when that is a module, the package itself otherwise."""
    is_module = (package / f"{name}.py").is_file() or (package / name).is_dir()
    return f"freecad_tetra.{name}" if is_module else "freecad_tetra"


def main(arguments: list[str]) -> int:
    """Print the breaches below ``arguments[0]``; 1 when there are some."""
    root = Path(arguments[0] if arguments else ".")
    breaches = cxx_breaches(root) + python_breaches(root)
    for breach in breaches:
        print(f"layers: {breach}", file=sys.stderr)
    return 1 if breaches else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
