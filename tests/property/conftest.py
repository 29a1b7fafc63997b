# SPDX-License-Identifier: LGPL-2.1-or-later
"""Makes the generators and exact verifiers of tests/tools importable by the property tests."""

import sys
from pathlib import Path

TESTS = Path(__file__).resolve().parents[1]
sys.path[:0] = [str(TESTS / "tools"), str(TESTS)]
