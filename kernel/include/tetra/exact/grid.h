// SPDX-License-Identifier: LGPL-2.1-or-later
// The integer grid of a run: the affine map between the caller's doubles and grid coordinates.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

namespace tetra {

using Vec3d = std::array<double, 3>;
using Vec3i = std::array<std::int64_t, 3>;

// grid = round((caller - origin) / step); step is a power of two, |grid| <= 2^bits.
struct Grid {
    int bits = 26;
    double step = 1;
    Vec3d origin{0, 0, 0};
};

// The finest grid of so many bits that holds all points. Points must be finite.
Grid grid_for(const std::vector<Vec3d>& points, int bits);

Vec3i snap(const Grid& grid, const Vec3d& point);

Vec3d unsnap(const Grid& grid, const Vec3d& grid_point);

}  // namespace tetra
