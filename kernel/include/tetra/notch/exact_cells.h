// SPDX-License-Identifier: LGPL-2.1-or-later
// Notch cutting on exact planes only: its cells as polyhedra on the grid.
#pragma once

#include "tetra/notch/merge_polyhedra.h"

namespace tetra {

// Convex cells of one solid by notch cutting without plane classes: every point is an input point
// or the meeting of three facet planes, and lies exactly on the planes of its facets. `flatness`
// and `tries` of the options are not used. Verified as convex_cells is, exactly. `stats` gets the
// counts. grid.bits must be at most 26.
//
// \throw VerificationFailed, Cancelled.
Polyhedra exact_cells(const GridSolid& solid, const CellsOptions& options, CellsStats& stats,
                      Progress& progress);

}  // namespace tetra
