// SPDX-License-Identifier: LGPL-2.1-or-later
// Chooses the grid of a run and maps points to and from it.
#include "tetra/exact/grid.h"

#include <algorithm>
#include <cmath>

namespace tetra {

Grid grid_for(const std::vector<Vec3d>& points, int bits) {
    Grid grid;
    grid.bits = bits;
    if (points.empty()) return grid;
    Vec3d lo = points.front(), hi = points.front();
    for (const Vec3d& p : points)
        for (int k = 0; k < 3; ++k) {
            lo[k] = std::min(lo[k], p[k]);
            hi[k] = std::max(hi[k], p[k]);
        }
    double half = 0;
    for (int k = 0; k < 3; ++k) half = std::max(half, hi[k] / 2 - lo[k] / 2);
    int exponent = 0;
    std::frexp(half, &exponent);  // half < 2^exponent
    if (half == 0) exponent = 0;
    // One step of slack: the origin is rounded to the grid itself, so that a caller's coordinate
    // that is a multiple of the step stays one.
    grid.step = std::ldexp(1.0, std::max(exponent - bits, -1000));
    for (int k = 0; k < 3; ++k)
        grid.origin[k] = std::round((hi[k] / 2 + lo[k] / 2) / grid.step) * grid.step;
    return grid;
}

Vec3i snap(const Grid& grid, const Vec3d& point) {
    Vec3i r;
    for (int k = 0; k < 3; ++k) r[k] = std::llround((point[k] - grid.origin[k]) / grid.step);
    return r;
}

Vec3d unsnap(const Grid& grid, const Vec3d& grid_point) {
    Vec3d r;
    for (int k = 0; k < 3; ++k) r[k] = grid_point[k] * grid.step + grid.origin[k];
    return r;
}

}  // namespace tetra
