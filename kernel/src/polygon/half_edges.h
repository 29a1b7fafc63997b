// SPDX-License-Identifier: LGPL-2.1-or-later
// The sides of the triangles of a planar mesh and which of them lie on each other.
#pragma once

#include <span>
#include <vector>

#include "tetra/polygon/region.h"

namespace tetra {

/// Side 3 t + k of triangle t goes from its corner k to the next one.
inline int next_side(int side) { return side % 3 == 2 ? side - 2 : side + 1; }
inline int previous_side(int side) { return side % 3 == 0 ? side + 2 : side - 1; }

/// Per side the opposite one, or -1 on the boundary and along the fixed edges.
///
/// \throw InvalidRegion when two triangles have a side in the same direction.
std::vector<int> opposite_sides(std::span<const PlanarTriangle> triangles,
                                std::span<const DirectedEdge> fixed);

}  // namespace tetra
