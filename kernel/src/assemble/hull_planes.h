// SPDX-License-Identifier: LGPL-2.1-or-later
// A convex polytope is enclosed by one with fewer vertices, by leaving supporting planes out.
#pragma once

#include <span>
#include <vector>

#include "tetra/exact/grid.h"
#include "tetra/solid/grid_solid.h"

namespace tetra {

struct Polytope {
    std::vector<Vec3d> points;
    std::vector<Triangle> triangles;  // counter-clockwise seen from outside
};

// A polytope with at most `most` (>= 8) vertices that contains the hull of `points`, whose hull
// has the given triangles. Its planes support the hull: those that may go are left out one by
// one, each time the one whose new vertices reach least beyond the planes of the start. O(n^2
// log n) for n planes; above 128 planes those of like direction are joined first.
Polytope enclosed_by_fewer(std::span<const Vec3d> points, std::span<const Triangle> triangles,
                           int most);

}  // namespace tetra
