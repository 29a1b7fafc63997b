// SPDX-License-Identifier: LGPL-2.1-or-later
// What every way to convex cells shares: the order of its input and the evaluation of its output.
#pragma once

#include "decompose.h"

namespace tetra::notch {

// One solid with points and triangles in an order that does not depend on the caller's.
GridSolid canonical_solid(const GridSolid& all, int solid);

// Appends the cells of a run over one solid whose points are placed.
void collect_cells(const GridSolid& solid, const Decomposition& result, ConvexCells& out);

// Fills the volumes of cells.stats. Throws VerificationFailed when they differ by more than 1e-6.
void measure_volumes(const GridSolid& solid, const std::vector<Vec3d>& vertices,
                     ConvexCells& cells);

}  // namespace tetra::notch
