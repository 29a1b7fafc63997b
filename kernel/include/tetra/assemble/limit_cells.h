// SPDX-License-Identifier: LGPL-2.1-or-later
// Convex cells within the limits of physics engines, at a stated error.
#pragma once

#include <cstdint>
#include <vector>

#include "tetra/exact/grid.h"
#include "tetra/progress.h"
#include "tetra/solid/grid_solid.h"

namespace tetra {

// Cells that cover a part once, facets as in ConvexCells.
struct CellArrays {
    std::vector<Vec3d> points;
    std::vector<std::int64_t> facet_offsets;
    std::vector<int> facet_vertices;
    std::vector<int> facet_source;  // negative inside the part
    std::vector<std::int64_t> cell_offsets;
    std::vector<int> cell_solid;
};

struct Limits {
    int max_cells = 0;     // 0: no limit
    int max_vertices = 0;  // 0: no limit; 8 at least
};

// A convex piece: a cell as it was given, or a hull of some.
struct LimitedPiece {
    std::vector<int> cells;           // increasing
    std::vector<Triangle> triangles;  // empty: the one cell, unchanged
};

struct LimitedCells {
    std::vector<Vec3d> points;  // the given ones, then those of simplified hulls
    std::vector<LimitedPiece> pieces;
    double error = 0;         // no point of a piece is farther from the part
    double error_found = 0;   // and one is as far as this
    double volume_added = 0;  // sum of the pieces' volumes above the part's; overlaps count twice
    int merged = 0;           // pieces of more than one cell
    int simplified = 0;       // pieces that lost vertices
};

// Merges cells whose common hull adds least until there are at most max_cells, then encloses
// pieces of too many vertices by polytopes with fewer. Every piece contains its cells (to
// rounding), so the pieces cover the part. Throws Cancelled. There must be no more solids than
// max_cells.
LimitedCells limit_cells(const CellArrays& part, const Limits& limits, Progress& progress);

}  // namespace tetra
