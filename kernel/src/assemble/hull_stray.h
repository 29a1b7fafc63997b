// SPDX-License-Identifier: LGPL-2.1-or-later
// The hull of some points of a part, and how far it is seen to be away from the part.
#pragma once

#include <vector>

#include "part_distance.h"

namespace tetra {

// The hull of some cells.
struct MergedHull {
    std::vector<int> cells;           // increasing
    std::vector<int> points;          // ids of the hull's vertices, increasing
    std::vector<Triangle> triangles;  // of the same ids; flat cells have none
    double volume6 = 0;               // six times the hull's volume
    double stray = 0;                 // how far its surface was seen to be from the part
};

// The hull of points given by increasing ids; flat ones keep all points. No cells, no stray.
MergedHull hull_of_points(std::span<const Vec3d> points, const std::vector<int>& ids);

// The largest distance from the part found on triangles whose corners are on it, to five per cent,
// or `known` when that is larger; what is closer than distance.coarse() is not searched closely.
// The place that may be farthest comes first, so that small holes under large facets are found. The
// search ends when `enough` is reached, or after some hundred places.
double farthest_of(const PartDistance& distance, std::span<const Corners> triangles, double known,
                   double enough);

}  // namespace tetra
