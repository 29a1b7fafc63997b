# SPDX-License-Identifier: LGPL-2.1-or-later
"""Random solids through pull-off, fence-off, compaction and restoring, each mesh verified.

    .venv/bin/python tools/fuzz_tets.py [--count 100000] [--processes 2]

The three axes come in turn, the other options are drawn. A mesh that only a second attempt of the
kernel gave counts as a failure here. Failing solids are shrunk and saved in tests/cases.
"""

from __future__ import annotations

import random
import sys
from typing import Any

from fuzz_solids import parse_arguments, run

from check_solids import check_tets_at_once  # isort: skip
from random_solids import random_solid  # isort: skip


def options_of(seed: int) -> dict[str, Any]:
    rng = random.Random(seed)
    return {
        "direction": "xyz"[seed % 3] if rng.random() < 0.9 else "auto",
        "pull_off": rng.choice(["auto", "on", "off"]),
        "compact": rng.choice(["default", "default", "off", "max"]),
        "seed": rng.randrange(2**31),
    }


if __name__ == "__main__":
    arguments = parse_arguments(__doc__.splitlines()[0], 100_000)
    sys.exit(1 if run("tets", arguments, random_solid, options_of, check_tets_at_once) else 0)
