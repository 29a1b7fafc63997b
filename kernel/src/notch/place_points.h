// SPDX-License-Identifier: LGPL-2.1-or-later
// Where the cells' points lie in the caller's coordinates, so that the cells stay convex there.
#pragma once

#include "decompose.h"

namespace tetra::notch {

// Fills result.placed and placed_planes. Points go to the caller's planes they were made from. The
// caller's plane of a small facet turns against the grid's by its rounded corners, which is much
// far away; where that spoils the convexity of a cell, the planes concerned stay the grid's, and at
// last no point moves by more than a few grid steps. Linear in the cells' size per round.
void place_points(const GridSolid& solid, const std::vector<Vec3d>& vertices,
                  Decomposition& result);

}  // namespace tetra::notch
