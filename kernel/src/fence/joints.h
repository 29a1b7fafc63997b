// SPDX-License-Identifier: LGPL-2.1-or-later
// Where walls are split, and the marks on the vertical line of each plan point (rules R7 to R9).
#pragma once

#include "flat_points.h"

namespace tetra::fence {

// A point of the result: the place over `point` where `surface` (an id of Plan) has its height.
struct Mark {
    int point = -1;
    int surface = -1;  // -1: an input point
    Carrier carrier;   // a facet is named by its id here
    double z = 0;      // rounded once, not decreasing along the vertical line
};

struct Joints {
    std::vector<Mark> marks;         // of point 0 bottom up, of point 1, ...
    std::vector<int> mark_offset;    // per plan point, one more at the end
    Lists surfaces;                  // per plan point: surfaces with a mark, ascending
    std::vector<int> surface_marks;  // parallel to surfaces.items: the mark
    int propagated = 0;

    int mark_of(int point, int surface) const;
};

// Sets `active` of wall points that must split their wall, and collects the marks.
Joints join_walls(const Plan& plan, Walls& walls, const std::vector<InnerPoint>& inner,
                  Progress& progress);

// The exact place of a mark.
HPoint place_of(const Plan& plan, const Mark& mark);

}  // namespace tetra::fence
