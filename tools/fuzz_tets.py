# SPDX-License-Identifier: LGPL-2.1-or-later
"""Random solids through pull-off, fence-off, compaction and restoring, each mesh verified.

    .venv/bin/python tools/fuzz_tets.py [--count 100000] [--processes 2]

Each solid is fenced along all three axes; the other options are drawn. A mesh that only a second
attempt of the kernel gave counts as a failure here. Failing solids are shrunk and saved in
tests/cases. About ten milliseconds a mesh, most of them in the kernel.
"""

from __future__ import annotations

import random
import sys
from collections import Counter
from typing import Any

from fuzz_solids import parse_arguments, run

from check_solids import check_tets_at_once  # isort: skip
from random_solids import Surface, random_solid  # isort: skip


def options_of(seed: int) -> dict[str, Any]:
    rng = random.Random(seed)
    return {
        "pull_off": rng.choice(["auto", "on", "off"]),
        "compact": rng.choice(["default", "default", "off", "max"]),
        "seed": rng.randrange(2**31),
    }


def check_on_axes(surface: Surface, options: dict[str, Any]) -> dict[str, float]:
    sums: Counter[str] = Counter()
    for axis in options.get("direction", "xyz"):
        try:
            sums.update(check_tets_at_once(surface, {**options, "direction": axis}))
        except Exception as error:
            error.args = (f"along {axis}: {error}", *error.args[1:])
            raise
    return dict(sums)


if __name__ == "__main__":
    arguments = parse_arguments(__doc__.splitlines()[0], 100_000)
    sys.exit(1 if run("tets", arguments, random_solid, options_of, check_on_axes) else 0)
