// SPDX-License-Identifier: LGPL-2.1-or-later
// Counts of a valid solid: facets, notches, genus, contacts.
#pragma once

#include <vector>

#include "tetra/solid/crossing.h"
#include "tetra/solid/shells.h"

namespace tetra {

struct Counts {
    int vertices = 0;  // distinct points in use
    int triangles = 0;
    int facets = 0;   // connected coplanar regions
    int notches = 0;  // reflex edges; collinear ones in a row between the same facets are one
    int shells = 0;
    int solids = 0;          // outer shells
    int genus = 0;           // sum over shells
    int euler = 0;           // vertices - edges + triangles, contacts taken apart
    int type1_contacts = 0;  // points on a triangle of which they are no corner
    int type2_edges = 0;     // edges with more than two triangles
    int type3_vertices = 0;  // points where several fans meet that share no edge
    int facet_contacts = 0;  // overlapping pairs of coplanar triangles facing one another
    int merged_points = 0, dropped_triangles = 0, flipped_edges = 0;  // repairs of the input
};

// Facet of every triangle, numbered by first triangle: connected across sheets, exactly coplanar
// and not folded. O(n).
std::vector<int> find_facets(const GridSolid& surface, const Sheets& sheets);

// The counts but for solids and repairs. O(n log n).
Counts measure(const GridSolid& surface, const Sheets& sheets, const Shells& shells,
               const Crossings& crossings);

}  // namespace tetra
