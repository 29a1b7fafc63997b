// SPDX-License-Identifier: LGPL-2.1-or-later
// Exact points in homogeneous integers: grid points, edge x plane, and three planes.
#pragma once

#include "tetra/exact/plane.h"

namespace tetra {

// The point (x, y, z) / w with w > 0; not reduced. At most 7b+9 bits (ALGORITHMS 3.2).
struct HPoint {
    Int256 x, y, z, w = 1;
};

HPoint hpoint(const Vec3i& point);

// The doubles cut off after 62 binary places; |coordinates| < 2^62.
HPoint hpoint_from(const Vec3d& point);

// Where the line u-v meets the plane; su, sv = plane_value at u and v, which must differ.
HPoint meet(const Vec3i& u, const Vec3i& v, Int128 su, Int128 sv);

// The common point of three planes with independent normals.
HPoint meet(const Plane& p, const Plane& q, const Plane& r);

// Determinant of the three normals (6b+9 bits).
Int256 det_normals(const Plane& p, const Plane& q, const Plane& r);

// Sign of plane at point (9b+13 bits: b <= 26 within 256).
int side_of_plane(const Plane& plane, const HPoint& point);

bool same_point(const HPoint& p, const HPoint& q);

Vec3d to_doubles(const HPoint& point);

// Residues x/w, y/w, z/w modulo the Mersenne prime 2^61 - 1: equal points have equal residues
// without any reduction, and sums of volumes can be compared exactly modulo the prime.
inline constexpr std::uint64_t kHashPrime = (std::uint64_t{1} << 61) - 1;
std::array<std::uint64_t, 3> residues(const HPoint& point);

std::uint64_t multiply_mod(std::uint64_t a, std::uint64_t b);
std::uint64_t inverse_mod(std::uint64_t a);

}  // namespace tetra
