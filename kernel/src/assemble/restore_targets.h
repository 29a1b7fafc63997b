// SPDX-License-Identifier: LGPL-2.1-or-later
// Where each point of a mesh belongs in the caller's coordinates (COMPACT.md B1).
#pragma once

#include "tet_complex.h"

namespace tetra {

struct RestoreTargets {
    std::vector<Vec3d> place;  // per point; of inner points their grid place
    std::vector<char> bound;   // 0 for inner points: nowhere better to go
};

// Grid point k at vertices[solid.point_source[k]]; edge points at the same parameter of the surface
// edge that holds them on the grid, facet points at the same barycentric place of the triangle.
RestoreTargets restore_targets(TetComplex& mesh, const GridSolid& solid,
                               const FacetClasses& classes, const std::vector<Vec3d>& vertices);

}  // namespace tetra
