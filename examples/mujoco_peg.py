# SPDX-License-Identifier: LGPL-2.1-or-later
"""MuJoCo: a peg falls through the hole of a plate, which the hull of the plate would not allow.

Usage: ``python mujoco_peg.py [FOLDER]``
"""

import sys
from pathlib import Path

import cadquery as cq
import mujoco

from freecad_tetra import convex_cells

folder = Path(sys.argv[1] if len(sys.argv) > 1 else ".")
plate = cq.Workplane().box(60, 60, 20).faces(">Z").workplane().hole(20)
model = convex_cells(plate).write_mjcf(folder / "plate.xml", density=2700, fixed=True)


def drop(x: float) -> float:
    """Drop a peg of 17 mm from above the plate at `x` metres; return its height later."""
    spec = mujoco.MjSpec.from_file(str(model))
    peg = spec.worldbody.add_body(name="peg", pos=[x, 0, 0.05])
    peg.add_freejoint()
    peg.add_geom(type=mujoco.mjtGeom.mjGEOM_CYLINDER, size=[0.0085, 0.015, 0])
    world = spec.compile()
    data = mujoco.MjData(world)
    while data.time < 0.5:
        mujoco.mj_step(world, data)
    return float(data.body("peg").xpos[2])


print(f"over the hole the peg ends at {drop(0.0):.3f} m, over the wall at {drop(0.02):.3f} m")
