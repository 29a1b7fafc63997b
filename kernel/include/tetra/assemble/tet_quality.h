// SPDX-License-Identifier: LGPL-2.1-or-later
// Shape of tetrahedra for the report: mean ratios, dihedral angles, heights.
#pragma once

#include <span>

#include "tetra/exact/grid.h"

namespace tetra {

struct TetQuality {
    // Tetrahedra by mean ratio: below 1e-6, 1e-4, 1e-3, 1e-2, 0.05, 0.1, 0.2, 0.4, 0.7, and above.
    std::array<int, 10> histogram{};
    double min = 1, mean = 0;         // of the mean ratio; 1 = regular
    double min_dihedral = 3.1415927;  // radians
    double max_dihedral = 0;
    double min_height = 0;  // smallest height over a face, in the points' unit
};

// 12 (3 V)^(2/3) / sum of squared edge lengths: 1 for the regular tetrahedron, 0 for a flat one,
// negative for an inverted one.
double mean_ratio(const Vec3d& a, const Vec3d& b, const Vec3d& c, const Vec3d& d);

// The smallest distance of a corner from the opposite face; negative when inverted.
double least_height(const Vec3d& a, const Vec3d& b, const Vec3d& c, const Vec3d& d);

// Linear time. Zeros for an empty mesh.
TetQuality tet_quality(std::span<const Vec3d> points, std::span<const std::array<int, 4>> tets);

}  // namespace tetra
