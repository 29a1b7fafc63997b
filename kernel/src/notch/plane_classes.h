// SPDX-License-Identifier: LGPL-2.1-or-later
// Plane classes: facets that are planar in the CAD model but not quite on the grid share a plane.
#pragma once

#include <vector>

#include "point_table.h"
#include "tetra/solid/grid_solid.h"

namespace tetra::notch {

struct PlaneClasses {
    std::vector<int> key;        // per triangle, see HalfEdge::key
    std::vector<int> exact_key;  // per triangle: the key of its own plane
    std::vector<char> is_class;  // per plane id: holds triangles that are not exactly on it
};

// Gives every triangle a plane. With delta > 0 (grid steps),
// exactly coplanar groups whose vertices all lie within delta of a larger group's plane take that
// plane (NOTCHES 4); groups whose exact plane is listed in `demoted` stay exact.
PlaneClasses assign_planes(const GridSolid& solid, double delta, const std::vector<char>& demoted,
                           PointTable& points);

}  // namespace tetra::notch
