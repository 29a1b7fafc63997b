// SPDX-License-Identifier: LGPL-2.1-or-later
// Hulls of merged cells exchange cells while the one that strays most can do better.
#pragma once

#include "hull_stray.h"
#include "tetra/progress.h"

namespace tetra {

// Greedy merging joins twos to fours where threes would do. Here the hull that strays most gives a
// cell to a neighbour, which may have to pass one on, or it is divided and two others are joined;
// each step takes it away from the top, until no step does or enough hulls were judged. As many
// hulls as given, each of cells of one solid.
std::vector<MergedHull> shift_cells(const CellArrays& part,
                                    const std::vector<std::vector<int>>& cells,
                                    const PartDistance& distance, std::vector<MergedHull> hulls,
                                    Progress& progress);

}  // namespace tetra
