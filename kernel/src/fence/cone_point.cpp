// SPDX-License-Identifier: LGPL-2.1-or-later
// Tries doubles at a few barycentric weights and accepts by exact signs.
#include "cone_point.h"

namespace tetra::fence {
namespace {

int turn(const PlanPoint& p, const PlanPoint& q, const HPoint& r) {
    const auto minor = [](const Int256& a, const Int256& b, const Int256& c, const Int256& d) {
        return multiply<8>(a, d) - multiply<8>(b, c);
    };
    const Int256 px(p.X), py(p.Y), pw(p.w), qx(q.X), qy(q.Y), qw(q.w);
    const Int512 x = minor(py, pw, qy, qw), y = minor(pw, px, qw, qx), w = minor(px, py, qx, qy);
    return (multiply<8>(x, r.x) + multiply<8>(y, r.y) + multiply<8>(w, r.w)).sign();
}

// Sign of the height of r over the surface (c > 0).
int above(const Surface& s, const HPoint& r) { return side_of_plane(s.plane, r); }

}  // namespace

std::optional<HPoint> point_in_column(const Plan& plan, const std::array<int, 3>& base, int floor,
                                      int ceiling) {
    const PlanPoint &a = plan.points[base[0]], &b = plan.points[base[1]], &c = plan.points[base[2]];
    const Surface &below = at(plan.surfaces, floor), &over = at(plan.surfaces, ceiling);
    for (int i = 1; i <= 6; ++i)
        for (int j = 1; j <= 6; ++j)
            for (int k = 1; k <= 6; ++k) {
                const double sum = i + j + k, u = i / sum, v = j / sum;
                PlanPoint p;
                p.x = c.x + (u * (a.x - c.x) + v * (b.x - c.x));
                p.y = c.y + (u * (a.y - c.y) + v * (b.y - c.y));
                const double z = (height(below, p).z + height(over, p).z) / 2;
                const HPoint q = hpoint_from({p.x, p.y, z});
                if (turn(a, b, q) > 0 && turn(b, c, q) > 0 && turn(c, a, q) > 0 &&
                    above(below, q) > 0 && above(over, q) < 0)
                    return q;
            }
    return std::nullopt;
}

}  // namespace tetra::fence
