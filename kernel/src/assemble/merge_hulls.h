// SPDX-License-Identifier: LGPL-2.1-or-later
// Convex cells are merged into fewer hulls, those first whose common hull strays least.
#pragma once

#include <vector>

#include "hull_stray.h"
#include "tetra/progress.h"

namespace tetra {

// Merges the cells of a part, given as the increasing ids of their points, until at most `most`
// are left. Greedy, by a heap over pairs: the two hulls of one solid whose common hull strays
// least from the part, and among equals those that grow least. How far a hull strays is sampled on
// the facets that bridge from one to the other. Pairs share a point, or, when none of those is
// left, are any two of a solid. O(p log p) for p pairs, with a hull and some distances for each.
// There must be no more solids than `most`.
std::vector<MergedHull> merge_hulls(const CellArrays& part,
                                    const std::vector<std::vector<int>>& cells,
                                    const PartDistance& distance, int most, Progress& progress);

}  // namespace tetra
