// SPDX-License-Identifier: LGPL-2.1-or-later
// Convex cells by fences: fence columns over convex bases, joined by the merging of notch cutting.
#pragma once

#include <string>
#include <vector>

#include "tetra/notch/convex_cells.h"

namespace tetra {

struct FencedCells {
    ConvexCells cells;
    std::vector<std::string> directions;  // of the fences, per solid
};

// Decomposes every solid in each of its fence directions that fit the grid, at most three, and
// keeps the one with fewest cells. Exact planes only; verified as convex_cells is. grid.bits must
// be at most 26.
//
// \throw VerificationFailed, InvalidSolid when no direction gives cells; Cancelled.
FencedCells cells_of_fences(const GridSolid& solid, const std::vector<Vec3d>& vertices, bool merge,
                            Progress& progress);

}  // namespace tetra
