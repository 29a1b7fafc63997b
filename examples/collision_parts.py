# SPDX-License-Identifier: LGPL-2.1-or-later
"""Write every convex cell of a part as an OBJ file of its own, as physics engines want them.

Usage: ``python collision_parts.py PART.step FOLDER``
"""

import sys
from pathlib import Path

from freecad_tetra import convex_cells


def main(part: str, folder: str) -> None:
    """Decompose `part` and write ``cell_0.obj``, ``cell_1.obj`` ... below `folder`."""
    target = Path(folder)
    target.mkdir(parents=True, exist_ok=True)
    cells = convex_cells(part)
    for number, cell in enumerate(cells):
        lines = [f"v {x:.17g} {y:.17g} {z:.17g}" for x, y, z in cell.points]
        lines += ["f " + " ".join(str(i + 1) for i in facet) for facet in cell.facets]
        (target / f"cell_{number}.obj").write_text("\n".join(lines) + "\n")
    print(f"{len(cells)} cells in {target}")


if __name__ == "__main__":
    main(*sys.argv[1:])
