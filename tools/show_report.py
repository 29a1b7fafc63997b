#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Print the main figures of a JSON report in a few lines.

Usage: ``show_report.py REPORT.json``
"""

from __future__ import annotations

import json
import sys
from pathlib import Path


def main(arguments: list[str]) -> int:
    """Print the report named by the one argument."""
    report = json.loads(Path(arguments[0]).read_text(encoding="utf-8"))
    counts = ", ".join(f"{key} {value}" for key, value in report["counts"].items())
    seconds = ", ".join(f"{key} {value:.3f}" for key, value in report["seconds"].items())
    print(f"method   {report['method']}")
    print(f"counts   {counts}")
    print(f"bounds   {', '.join(f'{key} {value}' for key, value in report['bounds'].items())}")
    print(f"volume   {report['volume']:.6f}  relative error {report['volume_error']:.1e}")
    print(f"seconds  {seconds}")
    print(f"verdict  {report['verdict']}")
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
