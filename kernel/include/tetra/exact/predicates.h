// SPDX-License-Identifier: LGPL-2.1-or-later
// Exact orientation signs of grid points, behind a floating-point filter.
#pragma once

#include "tetra/exact/grid.h"
#include "tetra/exact/wide_int.h"

namespace tetra {

// Sign of det(b-a, c-a, d-a): +1 when d lies on the side of the normal (b-a)x(c-a).
// Exact for |coordinates| <= 2^40 (3b+5 bits).
int orient3d(const Vec3i& a, const Vec3i& b, const Vec3i& c, const Vec3i& d);

// The determinant itself; wraps unless 3b+5 <= 127.
Int128 det3_of_points(const Vec3i& a, const Vec3i& b, const Vec3i& c, const Vec3i& d);

// Sign of the cross product (b-a)x(c-a) in coordinates u, v (0 = x, 1 = y, 2 = z).
// Exact for |coordinates| <= 2^61.
int orient2d(const Vec3i& a, const Vec3i& b, const Vec3i& c, int u = 0, int v = 1);

// True when the three points lie on one line (coincident points included).
bool collinear(const Vec3i& a, const Vec3i& b, const Vec3i& c);

}  // namespace tetra
