# SPDX-License-Identifier: LGPL-2.1-or-later
"""``python -m freecad_tetra`` is the command line."""

import sys

from freecad_tetra.cli import main

sys.exit(main())
