// SPDX-License-Identifier: LGPL-2.1-or-later
// Do two neighbouring triangles lie in one plane, facing the same way?
#pragma once

#include <utility>
#include <vector>

#include "tetra/exact/predicates.h"
#include "tetra/solid/grid_solid.h"

namespace tetra::fence {

// \pre the triangles share a side and neither is flat.
inline bool coplanar(const std::vector<Vec3i>& points, const Triangle& a, const Triangle& b) {
    const auto at = [&](int id) -> const Vec3i& { return points[static_cast<std::size_t>(id)]; };
    for (const int corner : b) {
        if (corner == a[0] || corner == a[1] || corner == a[2]) continue;
        if (orient3d(at(a[0]), at(a[1]), at(a[2]), at(corner)) != 0) return false;
    }
    for (const auto& [u, v] : {std::pair{0, 1}, {1, 2}, {2, 0}})
        if (const int side = orient2d(at(a[0]), at(a[1]), at(a[2]), u, v))
            return side == orient2d(at(b[0]), at(b[1]), at(b[2]), u, v);
    return false;
}

}  // namespace tetra::fence
