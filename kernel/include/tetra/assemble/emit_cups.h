// SPDX-License-Identifier: LGPL-2.1-or-later
// Puts the cups of a pull-off back on the fenced remainder, face to face (PULLOFF P8).
#pragma once

#include <vector>

#include "tetra/fence/fence_off.h"
#include "tetra/fence/pull_off.h"

namespace tetra {

// The surface that was pulled off: grid points, one id of a solid for all tetrahedra, and for each
// owner id below PullOff::first_cup a triangle of the GridSolid with its plane and face.
struct PulledSurface {
    const std::vector<Vec3i>& points;
    const std::vector<int>& owner_triangle;
    int solid = 0;
};

// `fenced` is the fence-off of (surface.points, pulled.triangles, pulled.owners) with all points
// of pulled.keep kept, or empty when nothing was left. The result covers the whole solid; its
// skin_source and carriers name triangles and points of the GridSolid. A point on two owners has
// the straight edge between input points as its carrier.
//
// Pure bookkeeping, no arithmetic: O(n log n).
// \throw InvalidSolid (edge_contact, vertices of the grid) when sharp edges meet without a common
//        vertex; VerificationFailed when the boundary of a dome doesn't run along its crown.
ExactMesh emit_cups(const FenceResult& fenced, const PullOff& pulled, const PulledSurface& surface);

}  // namespace tetra
