// SPDX-License-Identifier: LGPL-2.1-or-later
// Tetrahedra of the columns over base triangles, by staircases or a cone (rules R9 to R11).
#pragma once

#include <functional>

#include "bases.h"
#include "cone_point.h"

namespace tetra::fence {

// A triangle on a wall of the plan, outward from the column; points are marks, or from
// marks.size() on cone points.
struct WallTriangle {
    std::array<int, 3> corners{};
    int edge = -1;  // the base edge
};

struct Columns {
    std::vector<std::array<int, 4>> tets;
    std::vector<HPoint> cone_points;
    std::vector<Triangle> skin;  // floors and ceilings, outward
    std::vector<int> skin_facet;
    std::vector<WallTriangle> walls;
    int base_triangles = 0;
    int cyclic = 0;
};

// As point_in_column; tests put in one that finds less.
using ConePointFinder = std::function<std::optional<HPoint>(
    const Plan& plan, const std::array<int, 3>& base, int floor, int ceiling)>;

// \throw InvalidSolid, Cancelled; VerificationFailed when a cyclic column has no cone point, and
//        no flip of an inner edge of its base helps.
Columns build_columns(const Plan& plan, const Walls& walls, const Joints& joints,
                      const Bases& bases, Progress& progress,
                      const ConePointFinder& find_cone_point = point_in_column);

}  // namespace tetra::fence
