# SPDX-License-Identifier: LGPL-2.1-or-later
"""Errors keep all they say on the way to another process."""

from __future__ import annotations

import pickle

import pytest

from freecad_tetra import errors
from freecad_tetra.errors import Defect, TetraError

MADE = (
    errors.TetraError("a", "b"),
    errors.InvalidSolid([Defect("open_edge", "m", (1,), (2,), ("Face3",))]),
    errors.InvalidPolygon("crossed", [(0, 1)], [7]),
    errors.UnreadableFile("part.step", "cut off"),
    errors.VerificationFailed("no", cells=[3, 4]),
    errors.Cancelled(),
    errors.WorkerDied("killed", "try again"),
    errors.KernelMissing("none"),
    errors.MissingDependency("OCP", "reading", "cadquery-ocp"),
)


@pytest.mark.parametrize("error", MADE, ids=lambda error: type(error).__name__)
def test_pickled(error: TetraError) -> None:
    copy = pickle.loads(pickle.dumps(error))
    assert type(copy) is type(error)
    assert (str(copy), vars(copy), copy.args) == (str(error), vars(error), error.args)
