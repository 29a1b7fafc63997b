// SPDX-License-Identifier: LGPL-2.1-or-later
// Convex cells by fences: fence columns over convex bases, joined by the merging of notch cutting.
#pragma once

#include <cstddef>
#include <optional>
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
// be at most 26. With `beat`, directions of much more walls than the best are left out, and nothing
// is made when the walls promise more cells than that, even if merging does all it can.
//
// \throw VerificationFailed, InvalidSolid when no direction gives cells; Cancelled.
std::optional<FencedCells> cells_of_fences(const GridSolid& solid,
                                           const std::vector<Vec3d>& vertices, bool merge,
                                           std::optional<std::size_t> beat, Progress& progress);

}  // namespace tetra
