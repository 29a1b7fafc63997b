// SPDX-License-Identifier: LGPL-2.1-or-later
// Convex cells are merged into fewer hulls, those first whose common hull adds least.
#pragma once

#include <vector>

#include "tetra/exact/grid.h"
#include "tetra/progress.h"
#include "tetra/solid/grid_solid.h"

namespace tetra {

// The hull of some cells.
struct MergedHull {
    std::vector<int> cells;           // increasing
    std::vector<int> points;          // ids of the hull's vertices, increasing
    std::vector<Triangle> triangles;  // of the same ids; empty for a single cell
    double volume6 = 0;               // six times the hull's volume
};

// Merges cells, given as the ids of their points and their solid, until at most `most` are left.
// Greedy, by a heap over pairs: the pair of one solid whose common hull has the least volume above
// that of the two. Pairs share a point, or, when none of those is left, are any two of a solid.
// O(p log p) for p pairs, and a hull for each. There must be no more solids than `most`.
std::vector<MergedHull> merge_hulls(const std::vector<Vec3d>& points,
                                    const std::vector<std::vector<int>>& cells,
                                    const std::vector<int>& cell_solid, int most,
                                    Progress& progress);

}  // namespace tetra
