# SPDX-License-Identifier: LGPL-2.1-or-later
"""The command line ``freecad-tetra``: arguments in, an exit code out.

Exit codes: 0 done and verified, 2 usage, 3 invalid solid, 4 unreadable or unsupported file,
5 verification failed (nothing written), 130 cancelled.
"""

from __future__ import annotations

import sys
from collections.abc import Sequence

__all__ = ["main"]


def main(argv: Sequence[str] | None = None) -> int:
    """Run the command line in a worker process and return its exit code."""
    try:
        from freecad_tetra.cli import arguments, supervise

        return supervise.run(arguments.parse(argv))
    except KeyboardInterrupt:  # before the supervisor listens
        print("cancelled", file=sys.stderr)
        return 130
