// SPDX-License-Identifier: LGPL-2.1-or-later
// From a grid solid to half-edges without coplanar edges, its notches numbered.
#pragma once

#include "plane_classes.h"
#include "section.h"

namespace tetra::notch {

// An input notch: the two facet planes that meet in it.
struct Notch {
    int plane_a = -1, plane_b = -1;
    int assigned = -1;  // the plane it is cut with
};

// Pairs type 2 edges radially so that each pair encloses solid (NOTCHES 3.13), dissolves edges
// inside facets, joins collinear edges (3.11) and numbers what is reflex.
Piece build_piece(const GridSolid& solid, const PlaneClasses& classes, PointTable& points,
                  HalfEdges& edges, std::vector<Notch>& notches);

}  // namespace tetra::notch
