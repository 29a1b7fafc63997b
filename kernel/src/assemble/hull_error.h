// SPDX-License-Identifier: LGPL-2.1-or-later
// How far convex hulls reach beyond the part that they cover.
#pragma once

#include "part_distance.h"

namespace tetra {

struct HullError {
    double bound = 0;  // no point of a hull is farther from the part
    double found = 0;  // and one is as far as this
};

// Raises `error` to what the convex body of the triangles needs, by branch and bound over boxes:
// the distance from the part is 1-Lipschitz, so a box holds no point farther than its middle's
// distance and half its diagonal. Ends when bound and found differ by 5 % or less, or after
// 100,000 boxes, when `bound` is still true.
void raise_to(HullError& error, std::span<const Vec3d> points, std::span<const Triangle> triangles,
              const PartDistance& distance, Progress& progress);

}  // namespace tetra
