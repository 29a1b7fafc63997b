# SPDX-License-Identifier: LGPL-2.1-or-later
"""The tests that FreeCAD's Test workbench lists: all of tests/in_freecad that need no window."""

from __future__ import annotations

import unittest
from pathlib import Path
from typing import Any

FOLDER = Path(__file__).resolve().parents[2] / "tests" / "in_freecad"


def load_tests(loader: unittest.TestLoader, tests: Any, pattern: Any) -> unittest.TestSuite:
    """Return the tests of the checkout, by unittest's protocol."""
    return loader.discover(str(FOLDER), "test_*.py", str(FOLDER))
