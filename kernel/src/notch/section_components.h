// SPDX-License-Identifier: LGPL-2.1-or-later
// Components of a section: cycles, their exact nesting, and which of them carry a notch.
#pragma once

#include "section.h"

namespace tetra::notch {

// Projection of a plane along its dominant axis; sign makes it seen against the normal.
struct Frame {
    int axis = 2;
    int sign = 1;
};

// Angles 0..pi: 0, pi..2pi: 1, in the frame.
int half_plane(const Frame& frame, const Direction& d);

// Sign of the turn from p to q, seen against the plane's normal (8b+15 bits).
int turn_on_plane(const Frame& frame, const Direction& p, const Direction& q);

// Fills `cycle` of the segments and `used`. Throws Inconsistent when no notch is met.
void select_components(PointTable& points, const HalfEdges& edges, const Frame& frame,
                       Extent extent, const std::vector<char>& own, Section& section);

}  // namespace tetra::notch
