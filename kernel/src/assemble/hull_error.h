// SPDX-License-Identifier: LGPL-2.1-or-later
// How far the surfaces of convex hulls are from the part that they cover.
#pragma once

#include "part_distance.h"
#include "tetra/progress.h"

namespace tetra {

struct HullError {
    double bound = 0;  // no point of a surface is farther from the part
    double found = 0;  // and one is as far as this
};

// Raises `error` to what the triangles of a hull need, by branch and bound: the distance from the
// part is 1-Lipschitz, so a triangle holds no point farther than its middle's distance and the
// distance of its corners from there. Ends when bound and found differ by 5 % or less, or after
// 20,000 triangles, when `bound` is still true.
void raise_to(HullError& error, std::span<const Vec3d> points, std::span<const Triangle> triangles,
              const PartDistance& distance, Progress& progress);

}  // namespace tetra
