// SPDX-License-Identifier: LGPL-2.1-or-later
// Heights by a floating filter and then 256-bit integers.
#include "surface.h"

#include <cmath>
#include <cstdlib>

namespace tetra::fence {
namespace {

Surface with_doubles(const Plane& plane, const Vec3i& on) {
    const auto c = static_cast<double>(plane.c);
    return {plane,
            -static_cast<double>(plane.a) / c,
            -static_cast<double>(plane.b) / c,
            static_cast<double>(on[0]),
            static_cast<double>(on[1]),
            static_cast<double>(on[2])};
}

}  // namespace

Surface facet_surface(const Plane& plane, const Vec3i& on) {
    return with_doubles(plane.c > 0 ? plane : opposite(plane), on);
}

Surface edge_surface(const Vec3i& u, const Vec3i& v) {
    const int axis = std::abs(v[0] - u[0]) >= std::abs(v[1] - u[1]) ? 0 : 1;
    const bool forward = v[axis] > u[axis];
    const Vec3i& s = forward ? u : v;
    const Vec3i& t = forward ? v : u;
    Plane plane;
    plane.c = t[axis] - s[axis];
    (axis == 0 ? plane.a : plane.b) = s[2] - t[2];
    plane.d = -plane_value(plane, s);
    return with_doubles(plane, s);
}

Surface vertex_surface(const Vec3i& v) { return with_doubles({0, 0, 1, -v[2]}, v); }

Height height(const Surface& s, const PlanPoint& p) {
    const double sx = s.gx * (p.x - s.x0), sy = s.gy * (p.y - s.y0);
    const double bound =
        0x1p-49 * (std::fabs(s.gx) * (std::fabs(p.x) + std::fabs(s.x0)) +
                   std::fabs(s.gy) * (std::fabs(p.y) + std::fabs(s.y0)) + std::fabs(s.z0));
    return {s.z0 + sx + sy, bound};
}

Int256 height_numerator(const Surface& s, const PlanPoint& p) {
    const Plane& f = s.plane;
    return -(multiply<4>(WideInt<2>(p.X), WideInt<1>(f.a)) +
             multiply<4>(WideInt<2>(p.Y), WideInt<1>(f.b)) +
             multiply<4>(WideInt<2>(f.d), WideInt<1>(p.w)));
}

int compare_heights(const Surface& s, const Height& hs, const Surface& t, const Height& ht,
                    const PlanPoint& p) {
    const double difference = hs.z - ht.z, bound = hs.bound + ht.bound;
    if (difference > bound) return 1;
    if (difference < -bound) return -1;
    return (multiply<4>(height_numerator(s, p), WideInt<1>(t.plane.c)) -
            multiply<4>(height_numerator(t, p), WideInt<1>(s.plane.c)))
        .sign();
}

int compare_heights(const Surface& s, const Surface& t, const PlanPoint& p) {
    return compare_heights(s, height(s, p), t, height(t, p), p);
}

int compare_slopes(const Surface& s, const Surface& t, std::int64_t ex, std::int64_t ey) {
    const auto fall = [&](const Surface& f) {
        return static_cast<Int128>(f.plane.a) * ex + static_cast<Int128>(f.plane.b) * ey;
    };
    return (multiply<4>(WideInt<2>(fall(t)), WideInt<1>(s.plane.c)) -
            multiply<4>(WideInt<2>(fall(s)), WideInt<1>(t.plane.c)))
        .sign();
}

}  // namespace tetra::fence
