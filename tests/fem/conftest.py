# SPDX-License-Identifier: LGPL-2.1-or-later
"""Benchmarks need OpenCascade for their parts and CalculiX to solve them."""

from __future__ import annotations

import shutil
import sys
from pathlib import Path

import pytest

sys.path.insert(0, str(Path(__file__).parent))
pytest.importorskip("OCP", reason="cadquery-ocp is not installed")
if shutil.which("ccx") is None:
    pytest.skip("CalculiX (ccx) is not installed", allow_module_level=True)
