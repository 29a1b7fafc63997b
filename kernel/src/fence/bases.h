// SPDX-License-Identifier: LGPL-2.1-or-later
// Base regions of the cells in the plan (rule R8).
#pragma once

#include "joints.h"

namespace tetra::fence {

// Part of a wall between two splits, directed so that its cell lies on the left.
struct BaseEdge {
    int from = -1, to = -1;
    int run = -1, chain = 0;
};

// All cells of one (floor, ceiling): base edges edge_first .. edge_last-1, inner points alike.
struct Base {
    int floor = -1, ceiling = -1;
    int edge_first = 0, edge_last = 0;
    int inner_first = 0, inner_last = 0;
};

struct Bases {
    std::vector<Base> bases;      // by floor, then ceiling
    std::vector<BaseEdge> edges;  // of base 0, of base 1, ... by their ends
    std::vector<PointId> inner;
};

Bases collect_bases(const Walls& walls, std::vector<InnerPoint> inner);

// Triangles of one base, counter-clockwise, near Delaunay.
// \throw InvalidSolid naming floor and ceiling when the base edges bound no region.
std::vector<PlanarTriangle> triangulate_base(const Plan& plan, const Bases& bases,
                                             const Base& base);

}  // namespace tetra::fence
