// SPDX-License-Identifier: LGPL-2.1-or-later
// Joining neighbouring convex cells whose union is convex.
#pragma once

#include "section.h"

namespace tetra::notch {

// Cells are surfaces of half-edges, one half-edge each (any). Joins along full common facets when
// no edge of the facet becomes reflex (ALGORITHMS 5, NOTCHES 6.1); returns what is left.
std::vector<int> merge_cells(PointTable& points, HalfEdges& edges, const std::vector<int>& cells);

}  // namespace tetra::notch
