# SPDX-License-Identifier: LGPL-2.1-or-later
"""What FreeCAD's window draws of pieces is closed, turned outwards and covers each of them."""

from __future__ import annotations

from collections import Counter

import numpy as np
import pytest

from freecad_tetra import ConvexCells, TetMesh, convex_cells, tetrahedralize
from freecad_tetra.workbench.piece_centres import centres
from freecad_tetra.workbench.piece_drawing import drawing

BRACKET = "resources/parts/bracket.step"


@pytest.fixture(scope="module", params=[convex_cells, tetrahedralize])
def pieces(request: pytest.FixtureRequest) -> ConvexCells | TetMesh:
    return request.param(BRACKET)


def test_every_piece_is_closed(pieces: ConvexCells | TetMesh) -> None:
    triangles = drawing(pieces).triangles
    directed = [edge for a, b, c in triangles.tolist() for edge in ((a, b), (b, c), (c, a))]
    counted = Counter(directed)
    assert max(counted.values()) == 1
    assert all((b, a) in counted for a, b in counted)


def test_triangles_of_a_piece_enclose_its_volume(pieces: ConvexCells | TetMesh) -> None:
    found = drawing(pieces)
    corners = found.points[found.triangles]
    cones = np.einsum("ij,ij->i", corners[:, 0], np.cross(corners[:, 1], corners[:, 2])) / 6
    piece = np.repeat(np.arange(len(pieces)), found.parts)
    assert np.array_equal(piece, found.piece[found.triangles[:, 0]])
    volumes = np.bincount(piece, cones, len(pieces))
    assert volumes == pytest.approx(pieces.volumes(), rel=1e-6, abs=1e-9 * volumes.sum())


def test_no_vertex_and_no_edge_is_shared(pieces: ConvexCells | TetMesh) -> None:
    found = drawing(pieces)
    assert (np.diff(found.piece) >= 0).all()
    for ids in (found.triangles, found.edges):
        assert (found.piece[ids] == found.piece[ids[:, :1]]).all()
    assert len(np.unique(found.edges, axis=0)) == len(found.edges)


def test_edges_and_facets_satisfy_euler(pieces: ConvexCells | TetMesh) -> None:
    found = drawing(pieces)
    facets = 4 * len(pieces) if isinstance(pieces, TetMesh) else len(pieces.facet_face)
    assert len(found.points) - len(found.edges) + facets == 2 * len(pieces)


def test_pieces_move_whole_and_away_from_the_middle(pieces: ConvexCells | TetMesh) -> None:
    found = drawing(pieces)
    middle = centres(pieces)
    outward = middle - middle.mean(axis=0)
    assert found.shifts == pytest.approx(outward[found.piece])
    for k in (0, len(pieces) - 1):
        mean = found.points[found.piece == k].mean(axis=0)
        assert mean == pytest.approx(middle[k])
