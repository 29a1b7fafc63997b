#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Check what every source file opens with, and that the version is the same wherever it stands.

A source file's first line (second after ``#!``) is its SPDX licence identifier.

Usage: ``check_headers.py ROOT``; prints one line per breach, exit status 1 when there is one.
"""

from __future__ import annotations

import re
import sys
from pathlib import Path

FOLDERS = ("kernel", "freecad_tetra", "tests", "tools", "benchmarks", "examples")
SUFFIXES = {".py", ".cpp", ".h", ".sh"}
LICENCE = "SPDX-License-Identifier: LGPL-2.1-or-later"


def licence_breaches(root: Path) -> list[str]:
    """Source files without the licence line."""
    files = [path for folder in FOLDERS for path in (root / folder).rglob("*")]
    files += [*root.glob("*.py"), *root.rglob("kernel/**/CMakeLists.txt")]
    breaches = []
    for path in sorted(set(files)):
        if path.suffix not in SUFFIXES and path.name != "CMakeLists.txt":
            continue
        text = path.read_text(encoding="utf-8")
        head = text.splitlines()[:2]
        if text and not any(LICENCE in line for line in head):
            breaches.append(f"{path.relative_to(root)}: no line {LICENCE!r} on top")
    return breaches


def version_breaches(root: Path) -> list[str]:
    """Files that name another version than ``freecad_tetra/_version.py``."""
    pattern = re.compile(r'__version__ = "([^"]+)"')
    found = pattern.search((root / "freecad_tetra/_version.py").read_text(encoding="utf-8"))
    if not found:
        return ["freecad_tetra/_version.py: no __version__"]
    version = found.group(1)
    expected = {"package.xml": f"<version>{version}</version>", "CHANGELOG.md": f"[{version}]"}
    return [
        f"{name}: does not say {text}"
        for name, text in expected.items()
        if text not in (root / name).read_text(encoding="utf-8")
    ]


def main(arguments: list[str]) -> int:
    """Print the breaches below ``arguments[0]``; 1 when there are some."""
    root = Path(arguments[0] if arguments else ".")
    breaches = licence_breaches(root) + version_breaches(root)
    for breach in breaches:
        print(f"headers: {breach}", file=sys.stderr)
    return 1 if breaches else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
