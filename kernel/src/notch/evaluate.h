// SPDX-License-Identifier: LGPL-2.1-or-later
// Exact points in the caller's coordinates.
#pragma once

#include "point_table.h"
#include "tetra/solid/grid_solid.h"

namespace tetra::notch {

// Planes of the caller: per plane id a unit normal and offset in grid units, fitted to the
// caller's own (unrounded) coordinates of the triangles that lie on it; has = 0 and the grid's
// plane for none.
struct CallerPlanes {
    std::vector<UnitPlane> unit;
    std::vector<char> has;
};

CallerPlanes fit_caller_planes(const GridSolid& solid, const std::vector<Vec3d>& vertices,
                               const std::vector<int>& keys, const PointTable& points);

// An input vertex comes back as given; another point is moved from its grid place by the least
// displacement that puts it on the caller's planes (and edge) it was made from. Planes that would
// carry it over `farthest` grid steps are left out.
Vec3d evaluate_point(const PointTable& points, int point, const GridSolid& solid,
                     const std::vector<Vec3d>& vertices, const CallerPlanes& planes,
                     double farthest);

}  // namespace tetra::notch
