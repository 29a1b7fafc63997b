// SPDX-License-Identifier: LGPL-2.1-or-later
// Convex cells by notch cutting (Bajaj-Dey 1990, Chazelle 1984).
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "tetra/exact/hpoint.h"
#include "tetra/progress.h"
#include "tetra/solid/grid_solid.h"

namespace tetra {

enum class NotchRule { cover, plain, random };
enum class CutExtent { notch_components, whole_plane, random };

// `plain` with `merge` off is the papers' method: one plane per notch, its first facet plane, at
// most r^2/2 + r/2 + 1 pieces. `flatness` is the reach of plane classes in grid steps (0: only
// exactly coplanar facets share a plane). `seed` drives ties and the random rules.
struct CellsOptions {
    NotchRule rule = NotchRule::cover;
    CutExtent extent = CutExtent::notch_components;
    bool merge = true;
    double flatness = 4;
    int tries = 1;
    std::uint64_t seed = 0;
};

struct CellsStats {
    int notches = 0;  // reflex edges after coplanar facets and collinear edges are joined
    int planes = 0;   // planes that cover the notches
    int cuts = 0;
    int splices = 0;      // cuts that did not separate
    int raw_cells = 0;    // before merging
    int restarts = 0;     // runs repeated because a plane class contradicted itself
    int demoted = 0;      // plane classes taken back to exact triangles
    double flatness = 0;  // what was used in the end
    bool exact = true;    // no plane class was needed: volumes agree exactly
    double volume = 0;    // of the cells, caller's units
    double solid_volume = 0;
};

// Cells as polyhedra: facet f has the points facet_vertices[facet_offsets[f] .. f+1), counter-
// clockwise seen from outside; cell c the facets cell_offsets[c] .. c+1.
struct ConvexCells {
    std::vector<Vec3d> points;      // caller's coordinates
    std::vector<int> point_source;  // caller's vertex or -1
    std::vector<HPoint> exact;      // the same points on the grid
    std::vector<std::int64_t> facet_offsets{0};
    std::vector<int> facet_vertices;
    std::vector<int> facet_source;  // a caller's triangle in the facet's oriented plane, or -1
    std::vector<std::int64_t> cell_offsets{0};
    std::vector<int> cell_solid;
    CellsStats stats;
};

// Decomposes a valid solid into convex cells that cover it once. `vertices` are the caller's
// coordinates that solid.point_source refers to; grid.bits must be at most 26. The result is
// verified: every cell closed, one facet per plane, every vertex inside all planes of its cell
// (exactly, when no plane class was needed), volumes add up. Throws VerificationFailed, Cancelled.
// O(n r + r^2) cells' edges in theory; section 2 of Bajaj and Dey 1990.
ConvexCells convex_cells(const GridSolid& solid, const std::vector<Vec3d>& vertices,
                         const CellsOptions& options, Progress& progress);

}  // namespace tetra
