# SPDX-License-Identifier: LGPL-2.1-or-later
"""Tables of numbers as text, many rows at a time."""

from __future__ import annotations

from typing import Any

import numpy as np

_ROWS = 4096


def lines(pattern: str, table: Any) -> bytes:
    """Format each row of `table` (n, k) by a % pattern with k places, one line each."""
    rows = np.asarray(table)
    if not len(rows):
        return b""
    parts = []
    for start in range(0, len(rows), _ROWS):
        block = rows[start : start + _ROWS]
        parts.append((pattern + "\n") * len(block) % tuple(block.reshape(-1).tolist()))
    return "".join(parts).encode("ascii")
