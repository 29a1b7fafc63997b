# SPDX-License-Identifier: LGPL-2.1-or-later
"""The decomposed surface as OFF, with 17 digits, so that others can judge the result."""

from __future__ import annotations

from typing import BinaryIO

import numpy as np

from freecad_tetra.export.text import lines
from freecad_tetra.model import Solid


def write_surface(solid: Solid, stream: BinaryIO) -> None:
    """Write the triangles of `solid`; vertices that none uses are left out."""
    used, triangles = np.unique(solid.triangles, return_inverse=True)
    rows = triangles.reshape(-1, 3)
    stream.write(f"OFF\n{len(used)} {len(rows)} 0\n".encode())
    stream.write(lines("%.17g %.17g %.17g", solid.vertices[used]))
    stream.write(lines("3 %d %d %d", rows))
