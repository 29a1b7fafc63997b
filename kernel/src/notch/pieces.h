// SPDX-License-Identifier: LGPL-2.1-or-later
// Parts of a cut piece: surfaces joined by adjacency, by holes in facets and by cavities.
#pragma once

#include "section.h"

namespace tetra::notch {

// Surfaces that share no edge belong together when one may be a hole or a cavity in the other.
// That is decided on bounding boxes, generously: a piece may hold several solids, but a solid is
// never torn apart. A surface without notches that encloses volume is a piece of its own.
// `simple` tells that a simple piece was cut along a simple section: neither holes nor cavities
// come of that, and nothing is measured.
std::vector<Piece> split_pieces(const PointTable& points, const HalfEdges& edges,
                                const std::vector<int>& all, bool simple, Workspace& work);

}  // namespace tetra::notch
