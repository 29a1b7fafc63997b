// SPDX-License-Identifier: LGPL-2.1-or-later
// A valid solid on the integer grid: what every decomposition starts from.
#pragma once

#include <array>
#include <vector>

#include "tetra/exact/grid.h"

namespace tetra {

using Triangle = std::array<int, 3>;

// Invariants: no flat triangle; every directed edge as often as its reverse (type 2 edges more
// than once); triangles outward; two points never equal. Points may be fewer than the caller's
// vertices when several of them share a grid place.
struct GridSolid {
    Grid grid;
    std::vector<Vec3i> points;
    std::vector<int> point_source;     // the caller's vertex that a point stands for
    std::vector<Triangle> triangles;   // of point ids
    std::vector<int> triangle_source;  // the caller's triangle it came from
    std::vector<int> solid;            // per triangle: an outer shell with its cavities
};

}  // namespace tetra
