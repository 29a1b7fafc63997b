// SPDX-License-Identifier: LGPL-2.1-or-later
// One run of notch cutting over one solid: cut until no piece has a notch, then merge.
#pragma once

#include <algorithm>

#include "choose_plane.h"
#include "tetra/notch/convex_cells.h"

namespace tetra::notch {

// What a run leaves behind: half-edges whose surfaces are the convex cells.
struct Decomposition {
    explicit Decomposition(int grid_bits) : points(grid_bits) {}
    bool uses_classes() const {
        return std::find(classes.is_class.begin(), classes.is_class.end(), 1) !=
               classes.is_class.end();
    }

    PointTable points;
    HalfEdges edges;
    PlaneClasses classes;
    std::vector<int> cells;  // one half-edge each
    // By place_points(): the caller's coordinates of the cells' points, and in grid steps the
    // planes they were brought to.
    std::vector<Vec3d> placed;
    std::vector<std::array<double, 4>> placed_planes;
    // Pieces that no plane could cut because classes contradict themselves there: the planes of
    // each. Empty for a usable result.
    std::vector<std::vector<int>> contradictions;
    bool exact = true;         // every input vertex is on its planes by arithmetic too
    std::uint64_t volume = 0;  // six times the input's, modulo 2^61 - 1
    int notches = 0, planes = 0, cuts = 0, splices = 0, raw_cells = 0;
};

// With delta = 0 a contradiction would be a defect of the kernel or an invalid solid.
Decomposition decompose(const GridSolid& solid, const CellsOptions& options, double delta,
                        const std::vector<char>& demoted, std::uint64_t seed, Progress& progress);

}  // namespace tetra::notch
