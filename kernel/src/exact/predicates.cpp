// SPDX-License-Identifier: LGPL-2.1-or-later
// Orientation signs: a semi-static filter, then 128-bit integers.
#include "tetra/exact/predicates.h"

#include <cmath>

namespace tetra {
namespace {

UInt128 product(std::int64_t a, std::int64_t b) {
    return static_cast<UInt128>(static_cast<Int128>(a) * b);
}

}  // namespace

Int128 det3_of_points(const Vec3i& a, const Vec3i& b, const Vec3i& c, const Vec3i& d) {
    const std::int64_t ux = b[0] - a[0], uy = b[1] - a[1], uz = b[2] - a[2];
    const std::int64_t vx = c[0] - a[0], vy = c[1] - a[1], vz = c[2] - a[2];
    const std::int64_t wx = d[0] - a[0], wy = d[1] - a[1], wz = d[2] - a[2];
    // Unsigned arithmetic: partial sums may wrap, the determinant does not.
    const UInt128 nx = product(uy, vz) - product(uz, vy);
    const UInt128 ny = product(uz, vx) - product(ux, vz);
    const UInt128 nz = product(ux, vy) - product(uy, vx);
    return static_cast<Int128>(nx * static_cast<UInt128>(static_cast<Int128>(wx)) +
                               ny * static_cast<UInt128>(static_cast<Int128>(wy)) +
                               nz * static_cast<UInt128>(static_cast<Int128>(wz)));
}

int orient3d(const Vec3i& a, const Vec3i& b, const Vec3i& c, const Vec3i& d) {
    // Differences below 2^53 are exact in doubles; the rest loses at most 8 half-ulps of the
    // permanent.
    const double ux = static_cast<double>(b[0] - a[0]), uy = static_cast<double>(b[1] - a[1]),
                 uz = static_cast<double>(b[2] - a[2]);
    const double vx = static_cast<double>(c[0] - a[0]), vy = static_cast<double>(c[1] - a[1]),
                 vz = static_cast<double>(c[2] - a[2]);
    const double wx = static_cast<double>(d[0] - a[0]), wy = static_cast<double>(d[1] - a[1]),
                 wz = static_cast<double>(d[2] - a[2]);
    const double yz = uy * vz, zy = uz * vy, zx = uz * vx, xz = ux * vz, xy = ux * vy, yx = uy * vx;
    const double det = (yz - zy) * wx + (zx - xz) * wy + (xy - yx) * wz;
    const double permanent = (std::fabs(yz) + std::fabs(zy)) * std::fabs(wx) +
                             (std::fabs(zx) + std::fabs(xz)) * std::fabs(wy) +
                             (std::fabs(xy) + std::fabs(yx)) * std::fabs(wz);
    const double bound = 0x1p-49 * permanent;
    if (det > bound) return 1;
    if (det < -bound) return -1;
    return sign_of(det3_of_points(a, b, c, d));
}

int orient2d(const Vec3i& a, const Vec3i& b, const Vec3i& c, int u, int v) {
    return sign_of(static_cast<Int128>(b[u] - a[u]) * (c[v] - a[v]) -
                   static_cast<Int128>(b[v] - a[v]) * (c[u] - a[u]));
}

bool collinear(const Vec3i& a, const Vec3i& b, const Vec3i& c) {
    return orient2d(a, b, c, 0, 1) == 0 && orient2d(a, b, c, 1, 2) == 0 &&
           orient2d(a, b, c, 2, 0) == 0;
}

}  // namespace tetra
