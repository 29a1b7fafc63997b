// SPDX-License-Identifier: LGPL-2.1-or-later
// The convex hull of points in doubles, by exact decisions.
#pragma once

#include <span>
#include <vector>

#include "tetra/exact/grid.h"
#include "tetra/solid/grid_solid.h"

namespace tetra {

// Triangles of the hull as ids into `points`, counter-clockwise seen from outside; coplanar
// facets come as several triangles. Empty when all points lie in one plane. Quickhull (Barber,
// Dobkin, Huhdanpaa 1996) with orient3d of the doubles as they are, so that no input fails;
// O(n log n) expected. Equal points may occur.
std::vector<Triangle> convex_hull(std::span<const Vec3d> points);

// Six times the volume enclosed by oriented triangles.
double volume6(std::span<const Vec3d> points, std::span<const Triangle> triangles);

}  // namespace tetra
