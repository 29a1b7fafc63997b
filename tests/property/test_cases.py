# SPDX-License-Identifier: LGPL-2.1-or-later
"""Solids that once failed, as the fuzz runs shrank them; each file tells in its last line how."""

from __future__ import annotations

from pathlib import Path

import pytest
from check_solids import Unfit, check_cells, check_tets, check_tets_at_once
from random_solids import read_off

from freecad_tetra.kernel import load

CASES = sorted((Path(__file__).resolve().parents[1] / "cases").glob("*.off"))
# Contacts beyond types 1 to 3 may be refused, but never done wrong: two edges that cross in their
# middles, faces that touch.
BEYOND = {"edges-cross", "faces-in-contact"}


def test_there_are_cases():
    assert CASES


@pytest.mark.parametrize("path", CASES, ids=lambda path: path.stem)
def test_cells(path):
    if path.stem in {"edges-cross"}:
        with pytest.raises(Unfit, match="cross"):
            check_cells(read_off(path), {})
        return
    for rule in ("cover", "plain", "random"):
        for extent in ("notch", "whole", "random"):
            for merge in (False, True):
                check_cells(read_off(path), {"rule": rule, "extent": extent, "merge": merge})


@pytest.mark.parametrize("path", CASES, ids=lambda path: path.stem)
def test_tetrahedra(path):
    for direction in "xyz":
        for pull_off in ("on", "off"):
            for compact in ("off", "default"):
                options = {"direction": direction, "pull_off": pull_off, "compact": compact}
                try:
                    check_tets_at_once(read_off(path), options)
                except Unfit:
                    assert path.stem in BEYOND
    for compact in ("off", "default", "max"):
        try:
            check_tets(read_off(path), {"method": "bajaj-dey", "compact": compact})
        except (Unfit, load().VerificationFailed):
            assert path.stem in BEYOND
