# SPDX-License-Identifier: LGPL-2.1-or-later
"""Ten parts of the corpus, a planar face fixed and 1000 N on a round one, solved by CalculiX."""

from __future__ import annotations

import os
import unittest
from functools import partialmethod
from typing import Any

import numpy as np
import Part
from parts import CORPUS
from test_fem_analysis import InAnalysis

from freecad_tetra.fem import jacobian, triangles
from freecad_tetra.fem.quality import GOOD_DIHEDRAL, quality_of
from freecad_tetra.workbench import feature, fem_mesh, solve

PARTS = (
    "Page_096_Exercise3D-37_byHannu", "Page_053_Exercise2D-45_byHannu",
    "Page_070_Exercise3D-11_byHannu", "Page_079_Exercise3D-20_byHannu",
    "Page_080_Exercise3D-21_byHannu", "Page_108_Exercise3D-49_v2_byHannu",
    "WhiffleBall_Tutorial_FCWiki", "page67_bynormandc", "example_3", "page68_bybejant",
)  # fmt: skip
# With quality all are meshed and loaded, but CalculiX, which takes up to a minute, solves these
# only, or all with TETRA_ALL_PARTS=1.
SOLVED = PARTS if os.environ.get("TETRA_ALL_PARTS") else (PARTS[1], PARTS[4], PARTS[8])


def chosen_faces(shape: Any) -> tuple[str, str]:
    """Return the largest planar face and the largest round one that does not touch it.

    Where they touch, nodes on their common edge are loaded and held at once, and what goes into
    them shows in no reaction.
    """
    by_area = sorted(enumerate(shape.Faces, 1), key=lambda f: -f[1].Area)
    plane = [f for f in by_area if f[1].Surface.TypeId == "Part::GeomPlane"]
    bent = [f for f in by_area if f[1].Surface.TypeId != "Part::GeomPlane"]
    pairs = ((p, b) for p in plane for b in bent if p[1].distToShape(b[1])[0] > 1e-6)
    fixed, loaded = next(pairs)
    return f"Face{fixed[0]}", f"Face{loaded[0]}"


def straight_edge(shape: Any) -> str:
    """Return the name of the longest straight edge, which a force can go along."""
    edges = [
        (edge.Length, f"Edge{i}")
        for i, edge in enumerate(shape.Edges, 1)
        if not edge.Degenerated and edge.Curve.TypeId == "Part::GeomLine"
    ]
    return max(edges)[1]


@unittest.skipUnless(CORPUS.is_dir(), "the corpus is not beside the checkout")
class TenParts(InAnalysis):
    def loaded(self, name: str, **properties: Any) -> tuple[Any, Any]:
        """Return the part and its mesh, loaded as the module says."""
        shape = Part.Shape()
        shape.read(str(CORPUS / f"{name}.brep"))
        part = self.feature_of(shape)
        self.material()
        fixed, loaded = chosen_faces(shape)
        self.fixed(part, fixed)
        self.force(part, loaded, 1000, straight_edge(shape))
        mesh = feature.make_fem_mesh(self.doc, part, self.analysis, **properties)
        self.doc.recompute()
        self.assertEqual(mesh.State, ["Up-to-date"], mesh.getStatusString())
        return part, mesh

    def elements(self, mesh: Any) -> tuple[Any, Any]:
        """Return nodes, and tetrahedra of positive orientation with ids into them."""
        tets = np.array([mesh.FemMesh.getElementNodes(e) for e in mesh.FemMesh.Volumes])
        turn = [0, 2, 1, 3, 6, 5, 4, 7, 9, 8]
        return fem_mesh.nodes_table(mesh.FemMesh), tets[:, turn]

    def by_default(self, name: str) -> None:
        _, mesh = self.loaded(name)
        self.assertEqual(len(quality_of(*self.elements(mesh)).nonpositive()), 0)
        self.arrived(name, self.solution())

    def with_quality(self, name: str) -> None:
        self.want_programs()
        part, mesh = self.loaded(name, Quality=True)
        points, tets = self.elements(mesh)
        found = quality_of(points, tets)
        self.assertEqual(len(found.nonpositive()), 0)
        self.assertGreater(np.degrees(found.min_dihedral.min()), GOOD_DIHEDRAL)
        volume = jacobian.volumes(points[tets]).sum()
        self.assertAlmostEqual(volume / part.Shape.Volume, 1, delta=1e-3)
        self.faces_are_kept(part, mesh, points)
        if name in SOLVED:
            self.arrived(name, self.solution())
        else:
            self.near(solve.write_deck(self.analysis)[1])
        least, off = np.degrees(found.min_dihedral.min()), volume / part.Shape.Volume - 1
        print(f"{name}: {len(tets)} elements, least angle {least:.2f}, volume {off:.1e}")

    def arrived(self, name: str, solution: solve.Solution) -> None:
        """Every load is within a hundredth and the support carries it."""
        self.near(solution.rows)
        (force,) = [row for row in solution.rows if "force" in row.what]
        carried = float(np.linalg.norm(solution.reactions["FIXED"]))
        self.assertAlmostEqual(carried / force.found, 1, delta=1e-3)
        print(name, *solution.rows, sep="\n   ")

    def near(self, rows: Any) -> None:
        """The areas of both constraints and the force are there, and right."""
        self.assertEqual(len(rows), 3)
        for row in rows:
            self.assertLess(row.error, 0.01, str(row))

    def faces_are_kept(self, part: Any, mesh: Any, points: Any) -> None:
        """Groups are complete, and those of planes plane."""
        for number, face in enumerate(part.Shape.Faces, 1):
            ids = fem_mesh.group_ids(mesh.FemMesh, f"Face{number}_Faces")
            rows = np.array([mesh.FemMesh.getElementNodes(int(i)) for i in ids])
            area = triangles.areas(points, rows).sum()
            self.assertAlmostEqual(area / face.Area, 1, delta=0.01, msg=f"Face{number}")
            if face.Surface.TypeId == "Part::GeomPlane":
                nodes = points[np.unique(rows)] - np.array(tuple(face.Surface.Position))
                off = np.abs(nodes @ np.array(tuple(face.Surface.Axis))).max()
                self.assertLess(off, 1e-7, f"Face{number}")


for _part in PARTS:
    setattr(TenParts, f"test_default_{_part}", partialmethod(TenParts.by_default, _part))
    setattr(TenParts, f"test_quality_{_part}", partialmethod(TenParts.with_quality, _part))
