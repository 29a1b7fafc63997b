// SPDX-License-Identifier: LGPL-2.1-or-later
// Where a closed surface meets itself: penetrations, told exactly from mere touching.
#pragma once

#include <compare>
#include <vector>

#include "tetra/progress.h"
#include "tetra/solid/box_tree.h"
#include "tetra/solid/sheets.h"

namespace tetra {

// Two triangles that penetrate, or (`flat`) whose surfaces cross along a common plane, cover one
// another facing the same way, or leave a wall of no thickness. first < second.
struct CrossingPair {
    int first, second;
    bool flat;
    friend auto operator<=>(const CrossingPair&, const CrossingPair&) = default;
};

struct Crossings {
    std::vector<CrossingPair> pairs;  // ascending
    // Points that lie on a triangle of their solid without being its corner (Bajaj-Dey type 1, a
    // vertex in the interior of an edge included), ascending.
    std::vector<int> touching_points;
    // Coplanar triangles of opposite orientation that overlap: facets in contact.
    int facet_contacts = 0;
};

// Exact for |coordinates| <= 2^40. Two triangles meet in nothing, a point, a segment or a polygon.
// A point is never a penetration: the links around it stay disjoint. A segment is one when it runs
// inside both triangles, or when the pair of triangles at an edge (a sheet) has its two
// half-planes strictly on different sides of the other sheet. A coplanar overlap is one when both
// triangles face the same way; opposite ones touch with nothing between, from outside: a wall of
// no thickness, solid on neither side, counts as penetration.
// O(n log n) for surfaces with few overlapping boxes. `limit` bounds the pairs listed;
// with far more of them the search stops and the other fields are incomplete.
Crossings find_crossings(const GridSolid& surface, const Sheets& sheets, const BoxTree& tree,
                         std::size_t limit, Progress& progress);

}  // namespace tetra
