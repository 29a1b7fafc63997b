// SPDX-License-Identifier: LGPL-2.1-or-later
// Heights over plan points: facets, edges and vertices as non-vertical planes, compared exactly.
#pragma once

#include "plan_points.h"
#include "tetra/exact/plane.h"

namespace tetra::fence {

// a x + b y + c z + d = 0 with c > 0. An edge is the plane through it that is level across its
// projection's main axis; a vertex is a level plane. Both have heights only over themselves.
struct Surface {
    Plane plane;
    double gx = 0, gy = 0;          // gradient of the height
    double x0 = 0, y0 = 0, z0 = 0;  // a grid point of the plane
};

Surface facet_surface(const Plane& plane, const Vec3i& on);
Surface edge_surface(const Vec3i& u, const Vec3i& v);
Surface vertex_surface(const Vec3i& v);

// A height in doubles with its error bound.
struct Height {
    double z = 0, bound = 0;
};
Height height(const Surface& s, const PlanPoint& p);

// The exact height is numerator / (s.plane.c * p.w).
Int256 height_numerator(const Surface& s, const PlanPoint& p);

// Sign of the height of s minus that of t over p.
int compare_heights(const Surface& s, const Surface& t, const PlanPoint& p);
int compare_heights(const Surface& s, const Height& hs, const Surface& t, const Height& ht,
                    const PlanPoint& p);

// Sign of the difference of slopes along (ex, ey).
int compare_slopes(const Surface& s, const Surface& t, std::int64_t ex, std::int64_t ey);

}  // namespace tetra::fence
