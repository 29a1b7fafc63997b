// SPDX-License-Identifier: LGPL-2.1-or-later
// Flat input points that must survive: where they become inner points of a base region.
#pragma once

#include "walls.h"

namespace tetra::fence {

// A flat input point strictly inside the base region of a cell.
struct InnerPoint {
    int floor = -1, ceiling = -1, point = -1;
};

// Those of plan.flat_points that no wall passes. O(k) per point, k runs of its facet.
std::vector<InnerPoint> locate_flat_points(const Plan& plan, const Walls& walls);

}  // namespace tetra::fence
