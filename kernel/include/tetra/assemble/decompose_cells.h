// SPDX-License-Identifier: LGPL-2.1-or-later
// The driver of convex cells: by notch cutting, by fences, or by the one that gives fewer.
#pragma once

#include <string>
#include <vector>

#include "tetra/notch/convex_cells.h"

namespace tetra {

enum class CellsMethod { bajaj_dey, fences, automatic };

// The cells, the method that made them, and how many pieces each method gave (-1: not tried).
struct CellsOutcome {
    ConvexCells cells;
    CellsMethod method = CellsMethod::bajaj_dey;
    std::vector<std::string> directions;  // of fences, per solid
    int by_bajaj_dey = -1, by_fences = -1;
    std::string note;  // `automatic`: why this method
};

// Decomposes a valid solid, of at most 26 grid bits, by `method`. `automatic` cuts notches, tries
// fences too where they are cheap and notches cross each other, and keeps what has fewer cells;
// fences alone serve where notch cutting fails. `options` are those of notch cutting; fences heed
// `merge`. The result is verified.
//
// \throw VerificationFailed, InvalidSolid (fences only), Cancelled.
CellsOutcome decompose_cells(const GridSolid& solid, const std::vector<Vec3d>& vertices,
                             CellsMethod method, const CellsOptions& options, Progress& progress);

}  // namespace tetra
