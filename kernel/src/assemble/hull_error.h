// SPDX-License-Identifier: LGPL-2.1-or-later
// How far the surfaces of convex hulls are from the part that they cover.
#pragma once

#include "part_distance.h"
#include "tetra/progress.h"

namespace tetra {

// An upper bound for the distance of a hull's surface from the part, by branch and bound: the
// distance is 1-Lipschitz, so a triangle holds no point farther than its middle's distance and
// that of its corners from there. `found` is raised to what some point has. Ends when nothing can
// be 5 % farther than that, or after 20,000 triangles, when the bound is still true.
double hull_error(std::span<const Vec3d> points, std::span<const Triangle> triangles,
                  const PartDistance& distance, double& found, Progress& progress);

}  // namespace tetra
