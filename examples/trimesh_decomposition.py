# SPDX-License-Identifier: LGPL-2.1-or-later
"""trimesh: exact cells in place of ``Trimesh.convex_decomposition``, whose parts are approximate.

Usage: ``python trimesh_decomposition.py [FOLDER]``
"""

import sys
from pathlib import Path

import trimesh

from freecad_tetra import convex_cells

folder = Path(sys.argv[1] if len(sys.argv) > 1 else ".")
outer = trimesh.creation.cylinder(radius=30, height=80, sections=24)
inner = trimesh.creation.cylinder(radius=26, height=80, sections=24)
cup = trimesh.boolean.difference([outer, inner.apply_translation([0, 0, 6])])

parts = convex_cells(cup).to_trimesh()
print(f"{len(parts)} exact parts, all convex: {all(part.is_convex for part in parts)}")
print(f"volume {cup.volume:.9g}, of the parts {sum(part.volume for part in parts):.9g}")

# For engines that take few hulls: the error is told, not guessed.
few = convex_cells(cup, max_cells=13)
limits = few.report.details["limits"]
print(f"{len(few)} hulls, at most {limits['hull_error']:.3g} too large")
few.to_scene().export(folder / "cup.glb")
