// SPDX-License-Identifier: LGPL-2.1-or-later
// Solids that touch in planes get the same triangles on both sides of the contact.
#pragma once

#include <vector>

#include "tetra/assemble/tetrahedralize.h"

namespace tetra {

// The surface to mesh instead of the caller's. Vertices after the caller's were made where edges
// of two solids cross on a common plane; triangle t lies on the caller's triangle source[t].
// contact[t] >= 0: the triangle of another solid with the same corners in opposite order.
struct Imprint {
    TetInput surface;
    std::vector<int> source;
    std::vector<int> contact;
    int merged_points = 0;  // vertices of two solids at one place
    bool any() const;
};

// Facets of different solids that face each other in one plane of the finest grid (2^26 steps) are
// overlaid, whatever their triangulations and sizes; edges of all solids are divided at the points
// of the overlay. Facets that meet in no common plane, as on curved faces tessellated twice, are
// left alone. With one solid, or nothing to do, the surface is the caller's.
//
// \throw VerificationFailed when the overlay bounds no region; Cancelled. O(n log n).
Imprint imprint_contacts(const TetInput& input, Progress& progress);

}  // namespace tetra
