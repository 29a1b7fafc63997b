// SPDX-License-Identifier: LGPL-2.1-or-later
// The kernel's own check of a decomposition before it is handed out (DESIGN P6).
#pragma once

#include <string>
#include <vector>

#include "decompose.h"

namespace tetra::notch {

struct Fault {
    std::string reason;
    std::vector<int> planes;
};

// None when every cell is closed, has one facet per plane, no reflex edge, every vertex inside
// all its planes, and 6 x volume adds up to the solid's modulo 2^61 - 1; else what is wrong, once
// for each cell. Unless result.exact, vertices may lie outside by the classes' reach and
// volumes are compared by the caller on the evaluated points instead. Points that are placed must
// keep their cells convex within 2^-22 of the grid's diagonal, whatever the run. Linear in the
// output, but for the vertex test, which is vertices x facets of each cell.
std::vector<Fault> find_faults(const Grid& grid, Decomposition& result);

// Only that points as they are placed keep their cells convex.
std::vector<Fault> find_misplaced(const Grid& grid, Decomposition& result);

}  // namespace tetra::notch
