# SPDX-License-Identifier: LGPL-2.1-or-later
"""Random solids through notch cutting, each partition proven in exact integers.

    .venv/bin/python tools/fuzz_cells.py [--count 20000] [--processes 2]

The rule of choosing planes and the extent of each cut (Q_g or the whole plane) are drawn.
Failing solids are shrunk and saved in tests/cases; the exit status is 1 when there are any.
"""

from __future__ import annotations

import random
import sys
from typing import Any

from fuzz_solids import parse_arguments, run

from check_solids import check_cells  # isort: skip
from random_solids import random_solid  # isort: skip


def options_of(seed: int) -> dict[str, Any]:
    rng = random.Random(seed)
    return {
        "rule": rng.choice(["cover", "plain", "random", "random"]),
        "extent": rng.choice(["notch", "whole", "random"]),
        "merge": rng.random() < 0.6,
        "seed": rng.randrange(2**31),
        "flatness": 0,
    }


if __name__ == "__main__":
    arguments = parse_arguments(__doc__.splitlines()[0], 20_000)
    sys.exit(1 if run("cells", arguments, random_solid, options_of, check_cells) else 0)
