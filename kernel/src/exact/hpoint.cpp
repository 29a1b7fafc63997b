// SPDX-License-Identifier: LGPL-2.1-or-later
// Construction, comparison and evaluation of homogeneous points.
#include "tetra/exact/hpoint.h"

#include <cmath>

namespace tetra {
namespace {

struct Normal {
    Int128 x, y, z;
};

// At most 4b+7 bits: fits 128 for b <= 30.
Normal cross(const Plane& p, const Plane& q) {
    return {static_cast<Int128>(p.b) * q.c - static_cast<Int128>(p.c) * q.b,
            static_cast<Int128>(p.c) * q.a - static_cast<Int128>(p.a) * q.c,
            static_cast<Int128>(p.a) * q.b - static_cast<Int128>(p.b) * q.a};
}

Int256 wide_product(Int128 a, Int128 b) { return multiply<4>(WideInt<2>(a), WideInt<2>(b)); }

std::uint64_t reduce(UInt128 v) {
    std::uint64_t r = static_cast<std::uint64_t>(v & kHashPrime) +
                      static_cast<std::uint64_t>((v >> 61) & kHashPrime) +
                      static_cast<std::uint64_t>(v >> 122);
    while (r >= kHashPrime) r -= kHashPrime;
    return r;
}

constexpr int kFraction = 62;  // binary places of points from doubles

// value * 2^kFraction, cut off.
Int256 scaled(double value) {
    const double whole = std::floor(value);
    const auto part = static_cast<std::int64_t>(std::ldexp(value - whole, kFraction));
    return Int256(static_cast<Int128>(static_cast<std::int64_t>(whole)) << kFraction) +
           Int256(part);
}

}  // namespace

HPoint hpoint(const Vec3i& point) { return {point[0], point[1], point[2], 1}; }

HPoint hpoint_from(const Vec3d& point) {
    return {scaled(point[0]), scaled(point[1]), scaled(point[2]),
            Int256(static_cast<Int128>(1) << kFraction)};
}

HPoint meet(const Vec3i& u, const Vec3i& v, Int128 su, Int128 sv) {
    if (sv < su) {
        su = -su;
        sv = -sv;
    }
    HPoint r;
    Int256* out[3] = {&r.x, &r.y, &r.z};
    for (int k = 0; k < 3; ++k) *out[k] = wide_product(sv, u[k]) - wide_product(su, v[k]);
    r.w = Int256(sv) - Int256(su);
    return r;
}

Int256 det_normals(const Plane& p, const Plane& q, const Plane& r) {
    const Normal n = cross(q, r);
    return wide_product(n.x, p.a) + wide_product(n.y, p.b) + wide_product(n.z, p.c);
}

HPoint meet(const Plane& p, const Plane& q, const Plane& r) {
    const Normal qr = cross(q, r), rp = cross(r, p), pq = cross(p, q);
    HPoint h;
    h.w = wide_product(qr.x, p.a) + wide_product(qr.y, p.b) + wide_product(qr.z, p.c);
    h.x = wide_product(qr.x, p.d) + wide_product(rp.x, q.d) + wide_product(pq.x, r.d);
    h.y = wide_product(qr.y, p.d) + wide_product(rp.y, q.d) + wide_product(pq.y, r.d);
    h.z = wide_product(qr.z, p.d) + wide_product(rp.z, q.d) + wide_product(pq.z, r.d);
    if (h.w.negative()) {
        h.w = -h.w;
    } else {
        h.x = -h.x;
        h.y = -h.y;
        h.z = -h.z;
    }
    return h;
}

int side_of_plane(const Plane& plane, const HPoint& point) {
    const Int256 v =
        multiply<4>(WideInt<1>(plane.a), point.x) + multiply<4>(WideInt<1>(plane.b), point.y) +
        multiply<4>(WideInt<1>(plane.c), point.z) + multiply<4>(WideInt<2>(plane.d), point.w);
    return v.sign();
}

bool same_point(const HPoint& p, const HPoint& q) {
    return multiply<8>(p.x, q.w) == multiply<8>(q.x, p.w) &&
           multiply<8>(p.y, q.w) == multiply<8>(q.y, p.w) &&
           multiply<8>(p.z, q.w) == multiply<8>(q.z, p.w);
}

Vec3d to_doubles(const HPoint& point) {
    const double w = point.w.to_double();
    return {point.x.to_double() / w, point.y.to_double() / w, point.z.to_double() / w};
}

std::uint64_t multiply_mod(std::uint64_t a, std::uint64_t b) {
    return reduce(static_cast<UInt128>(a) * b);
}

std::uint64_t inverse_mod(std::uint64_t a) {
    std::uint64_t r = 1, base = a;
    for (std::uint64_t e = kHashPrime - 2; e; e >>= 1) {
        if (e & 1) r = multiply_mod(r, base);
        base = multiply_mod(base, base);
    }
    return r;
}

std::array<std::uint64_t, 3> residues(const HPoint& point) {
    const std::uint64_t inverse = inverse_mod(point.w.mod(kHashPrime));
    return {multiply_mod(point.x.mod(kHashPrime), inverse),
            multiply_mod(point.y.mod(kHashPrime), inverse),
            multiply_mod(point.z.mod(kHashPrime), inverse)};
}

}  // namespace tetra
