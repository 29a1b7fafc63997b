// SPDX-License-Identifier: LGPL-2.1-or-later
// Cuts a base region into convex polygons by chords along the lines of its own reflex corners.
#pragma once

#include "walls.h"

namespace tetra::fence {

// Part of a line; the region lies on the left of from -> to.
struct LineEdge {
    int from = -1, to = -1;
    int line = -1;
    bool forward = true;  // along the line's direction
};

// A counter-clockwise convex polygon; edge k leaves corner k. No two edges in a row on one line.
using ConvexPolygon = std::vector<LineEdge>;

// Chords only, never diagonals: all corners are crossings of lines of the plan. Adds plan points.
// With e edges and r reflex corners O(r e); at most r + 1 polygons per component.
// \param chords is increased by the number of chords.
std::vector<ConvexPolygon> convex_polygons(Plan& plan, std::vector<LineEdge> region, int& chords);

}  // namespace tetra::fence
