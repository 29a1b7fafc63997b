// SPDX-License-Identifier: LGPL-2.1-or-later
// Mean ratio, heights and dihedral angles in plain doubles.
#include "tetra/assemble/tet_quality.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "tetra/assemble/double_predicates.h"
#include "vec3.h"

namespace tetra {
namespace {

// Outward normals of the faces, of twice the faces' areas.
std::array<Vec3d, 4> normals(const Vec3d& a, const Vec3d& b, const Vec3d& c, const Vec3d& d) {
    return {cross(minus(c, b), minus(d, b)), cross(minus(d, a), minus(c, a)),
            cross(minus(b, a), minus(d, a)), cross(minus(c, a), minus(b, a))};
}

}  // namespace

double mean_ratio(const Vec3d& a, const Vec3d& b, const Vec3d& c, const Vec3d& d) {
    const double volume = det3_of_points(a, b, c, d) / 6;
    const Vec3d edges[6] = {minus(b, a), minus(c, a), minus(d, a),
                            minus(c, b), minus(d, b), minus(d, c)};
    double squares = 0;
    for (const Vec3d& e : edges) squares += dot(e, e);
    if (squares == 0) return 0;
    const double root = std::cbrt(3 * std::fabs(volume));
    return std::copysign(12 * root * root / squares, volume);
}

double least_height(const Vec3d& a, const Vec3d& b, const Vec3d& c, const Vec3d& d) {
    double largest = 0;
    for (const Vec3d& n : normals(a, b, c, d)) largest = std::max(largest, dot(n, n));
    return largest == 0 ? 0 : det3_of_points(a, b, c, d) / std::sqrt(largest);
}

TetQuality tet_quality(std::span<const Vec3d> points, std::span<const std::array<int, 4>> tets) {
    static constexpr double kLimits[9] = {1e-6, 1e-4, 1e-3, 1e-2, 0.05, 0.1, 0.2, 0.4, 0.7};
    TetQuality r;
    r.min_height = std::numeric_limits<double>::infinity();
    for (const auto& t : tets) {
        const auto at = [&](int k) -> const Vec3d& {
            return points[static_cast<std::size_t>(t[static_cast<std::size_t>(k)])];
        };
        const double q = mean_ratio(at(0), at(1), at(2), at(3));
        ++r.histogram[static_cast<std::size_t>(
            std::upper_bound(std::begin(kLimits), std::end(kLimits), q) - std::begin(kLimits))];
        r.min = std::min(r.min, q);
        r.mean += q;
        r.min_height = std::min(r.min_height, least_height(at(0), at(1), at(2), at(3)));
        const auto n = normals(at(0), at(1), at(2), at(3));
        for (std::size_t i = 0; i < 4; ++i)
            for (std::size_t j = i + 1; j < 4; ++j) {
                const Vec3d x = cross(n[i], n[j]);
                const double angle = std::atan2(std::sqrt(dot(x, x)), -dot(n[i], n[j]));
                r.min_dihedral = std::min(r.min_dihedral, angle);
                r.max_dihedral = std::max(r.max_dihedral, angle);
            }
    }
    if (tets.empty()) return {{}, 0, 0, 0, 0, 0};
    r.mean /= static_cast<double>(tets.size());
    return r;
}

}  // namespace tetra
