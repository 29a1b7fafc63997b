// SPDX-License-Identifier: LGPL-2.1-or-later
// Exact orientation signs of points given in doubles and of exact homogeneous points.
#pragma once

#include "tetra/exact/grid.h"
#include "tetra/exact/hpoint.h"

namespace tetra {

// Sign of det(b-a, c-a, d-a) of the doubles as they are: a filter, then error-free expansions.
// Exact while no product of three coordinates over- or underflows (magnitudes 1e-90 to 1e100).
int orient3d(const Vec3d& a, const Vec3d& b, const Vec3d& c, const Vec3d& d);

// The same determinant rounded, without any filter.
double det3_of_points(const Vec3d& a, const Vec3d& b, const Vec3d& c, const Vec3d& d);

// Sign of det(b-a, c-a, d-a) of homogeneous points with w > 0, exact for up to 1024 bits.
int orient3d(const HPoint& a, const HPoint& b, const HPoint& c, const HPoint& d);

}  // namespace tetra
