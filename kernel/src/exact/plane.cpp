// SPDX-License-Identifier: LGPL-2.1-or-later
// Primitive planes and the table that gives each one id.
#include "tetra/exact/plane.h"

#include <utility>

namespace tetra {
namespace {

UInt128 magnitude(Int128 v) { return v < 0 ? -static_cast<UInt128>(v) : static_cast<UInt128>(v); }

int trailing_zeros(UInt128 v) {
    const auto low = static_cast<std::uint64_t>(v);
    return low ? __builtin_ctzll(low) : 64 + __builtin_ctzll(static_cast<std::uint64_t>(v >> 64));
}

}  // namespace

UInt128 gcd(UInt128 a, UInt128 b) {
    if (a == 0) return b;
    if (b == 0) return a;
    const int shift = trailing_zeros(a | b);
    a >>= trailing_zeros(a);
    while (b != 0) {
        b >>= trailing_zeros(b);
        if (a > b) std::swap(a, b);
        b -= a;
    }
    return a << shift;
}

Plane plane_through(const Vec3i& p, const Vec3i& q, const Vec3i& r) {
    const std::int64_t ux = q[0] - p[0], uy = q[1] - p[1], uz = q[2] - p[2];
    const std::int64_t vx = r[0] - p[0], vy = r[1] - p[1], vz = r[2] - p[2];
    Int128 a = static_cast<Int128>(uy) * vz - static_cast<Int128>(uz) * vy;
    Int128 b = static_cast<Int128>(uz) * vx - static_cast<Int128>(ux) * vz;
    Int128 c = static_cast<Int128>(ux) * vy - static_cast<Int128>(uy) * vx;
    const auto g = static_cast<Int128>(gcd(gcd(magnitude(a), magnitude(b)), magnitude(c)));
    if (g > 1) {
        a /= g;
        b /= g;
        c /= g;
    }
    // With a primitive normal d is an integer combination of it: the plane is primitive too.
    const Int128 d = -(a * p[0] + b * p[1] + c * p[2]);
    return {static_cast<std::int64_t>(a), static_cast<std::int64_t>(b),
            static_cast<std::int64_t>(c), d};
}

Plane opposite(const Plane& plane) { return {-plane.a, -plane.b, -plane.c, -plane.d}; }

Int128 plane_value(const Plane& plane, const Vec3i& point) {
    return static_cast<Int128>(plane.a) * point[0] + static_cast<Int128>(plane.b) * point[1] +
           static_cast<Int128>(plane.c) * point[2] + plane.d;
}

std::size_t PlaneTable::Hash::operator()(const Plane& p) const {
    std::uint64_t h = 0x9e3779b97f4a7c15u;
    for (const std::uint64_t v : {static_cast<std::uint64_t>(p.a), static_cast<std::uint64_t>(p.b),
                                  static_cast<std::uint64_t>(p.c), static_cast<std::uint64_t>(p.d),
                                  static_cast<std::uint64_t>(p.d >> 64)}) {
        h ^= v + 0x9e3779b97f4a7c15u + (h << 6) + (h >> 2);
        h *= 0xff51afd7ed558ccdu;
        h ^= h >> 32;
    }
    return h;
}

PlaneKey PlaneTable::intern(const Plane& plane) {
    const std::int64_t lead = plane.a ? plane.a : (plane.b ? plane.b : plane.c);
    const int side = lead < 0 ? -1 : 1;
    const Plane stored = side > 0 ? plane : opposite(plane);
    const auto [place, fresh] = ids_.try_emplace(stored, size());
    if (fresh) planes_.push_back(stored);
    return {place->second, side};
}

}  // namespace tetra
