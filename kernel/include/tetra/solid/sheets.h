// SPDX-License-Identifier: LGPL-2.1-or-later
// Twins of half-edges: at edges with four or more triangles the pairs that enclose solid.
#pragma once

#include <span>
#include <vector>

#include "tetra/solid/grid_solid.h"

namespace tetra {

// Order of apexes around the axis u -> v, counter-clockwise seen against it, starting at `start`.
// -1: a is met before b; 0: the same half-plane; +1. No point may lie on the axis.
int compare_around(const Vec3i& u, const Vec3i& v, const Vec3i& start, const Vec3i& a,
                   const Vec3i& b);

struct Sheets {
    // Half-edge 3 t + i (edges.h) -> the opposite half-edge of the triangle that continues the
    // surface of the same solid material.
    std::vector<int> twin;
    // Edges with more than two triangles (Bajaj-Dey type 2), per solid.
    int type2_edges = 0;
};

// Pairs every half-edge. At an edge with 2k > 2 triangles these are sorted radially by exact
// predicates and paired like brackets, so that each pair encloses solid and no two pairs cross
// (NOTCHES 3.13). The surface must be closed and without flat triangles. O(n log n).
Sheets pair_half_edges(std::span<const Vec3i> points, std::span<const Triangle> triangles,
                       std::span<const int> solid);

}  // namespace tetra
