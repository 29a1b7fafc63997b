# SPDX-License-Identifier: LGPL-2.1-or-later
"""Whitespace-separated numbers in bulk, with errors instead of guesses."""

from __future__ import annotations

import warnings
from typing import Any

import numpy as np
import numpy.typing as npt

from freecad_tetra.io.polygons import BadFile


def numbers(text: bytes) -> npt.NDArray[np.float64]:
    """Parse all of `text` as float64, O(n).

    Raises
    ------
    BadFile
        A word is not a number.
    """
    if not text.strip():
        return np.zeros(0)
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("error", DeprecationWarning)
            plain = text.decode("ascii")
            return np.fromstring(plain, dtype=np.float64, sep=" ")
    except (DeprecationWarning, ValueError) as error:
        raise BadFile("a number is expected where there is none") from error


def integers(values: npt.NDArray[np.float64], what: str) -> npt.NDArray[np.int64]:
    """Return `values` as integers.

    Raises
    ------
    BadFile
        A value is not whole or is out of range.
    """
    ok = np.isfinite(values) & (np.abs(values) < 2**31)
    if not ok.all() or not np.array_equal(values, np.rint(values)):
        raise BadFile(f"{what} must be whole numbers")
    return values.astype(np.int64)


def whole(word: Any, what: str) -> int:
    """Return one word as a non-negative integer."""
    try:
        value = int(word)
    except ValueError as error:
        raise BadFile(f"{what} is not a number") from error
    if not 0 <= value < 2**31:
        raise BadFile(f"{what} is out of range")
    return value
