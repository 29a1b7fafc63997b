// SPDX-License-Identifier: LGPL-2.1-or-later
// Canonical rational points, filtered comparisons and orientations.
#include "plan_points.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace tetra::fence {
namespace {

std::uint64_t hash_of(Int128 X, Int128 Y, std::int64_t w) {
    std::uint64_t h = 0x9e3779b97f4a7c15u;
    for (const std::uint64_t v :
         {static_cast<std::uint64_t>(X), static_cast<std::uint64_t>(X >> 64),
          static_cast<std::uint64_t>(Y), static_cast<std::uint64_t>(Y >> 64),
          static_cast<std::uint64_t>(w)}) {
        h = (h ^ v) * 0xff51afd7ed558ccdu;
        h ^= h >> 32;
    }
    return h;
}

std::int64_t magnitude(Int128 v) { return static_cast<std::int64_t>(v < 0 ? -v : v); }

Int256 product(Int128 a, std::int64_t b) { return multiply<4>(WideInt<2>(a), WideInt<1>(b)); }

int exact_orient(const PlanPoint& p, const PlanPoint& q, const PlanPoint& r) {
    const auto minor = [](const PlanPoint& s, const PlanPoint& t) {
        return multiply<4>(WideInt<2>(s.X), WideInt<2>(t.Y)) -
               multiply<4>(WideInt<2>(s.Y), WideInt<2>(t.X));
    };
    const auto scaled = [](const Int256& m, std::int64_t w) {
        return multiply<4>(m, WideInt<1>(w));
    };
    return (scaled(minor(p, q), r.w) + scaled(minor(q, r), p.w) + scaled(minor(r, p), q.w)).sign();
}

}  // namespace

int PlanPoints::crossing(Int128 X, Int128 Y, std::int64_t w) {
    if (w < 0) {
        X = -X;
        Y = -Y;
        w = -w;
    }
    const std::int64_t g = std::gcd(std::gcd(w, magnitude(X % w)), magnitude(Y % w));
    return intern(X / g, Y / g, w / g);
}

int PlanPoints::intern(Int128 X, Int128 Y, std::int64_t w) {
    if (2 * (points_.size() + 1) > slots_.size()) grow();
    const std::size_t mask = slots_.size() - 1;
    std::size_t at = hash_of(X, Y, w) & mask;
    for (; slots_[at] >= 0; at = (at + 1) & mask) {
        const PlanPoint& p = points_[static_cast<std::size_t>(slots_[at])];
        if (p.X == X && p.Y == Y && p.w == w) return slots_[at];
    }
    slots_[at] = size();
    const auto d = static_cast<double>(w);
    points_.push_back({X, Y, w, static_cast<double>(X) / d, static_cast<double>(Y) / d});
    return slots_[at];
}

void PlanPoints::grow() {
    slots_.assign(std::max<std::size_t>(1024, 2 * slots_.size()), -1);
    const std::size_t mask = slots_.size() - 1;
    for (int id = 0; id < size(); ++id) {
        const PlanPoint& p = (*this)[id];
        std::size_t at = hash_of(p.X, p.Y, p.w) & mask;
        while (slots_[at] >= 0) at = (at + 1) & mask;
        slots_[at] = id;
    }
}

int PlanPoints::compare_axis(int axis, int i, int j) const {
    if (i == j) return 0;
    const PlanPoint &p = (*this)[i], &q = (*this)[j];
    const double a = axis == 0 ? p.x : p.y, b = axis == 0 ? q.x : q.y;
    const double bound = 0x1p-49 * (std::fabs(a) + std::fabs(b));
    if (a - b > bound) return 1;
    if (b - a > bound) return -1;
    const Int128 A = axis == 0 ? p.X : p.Y, B = axis == 0 ? q.X : q.Y;
    return (product(A, q.w) - product(B, p.w)).sign();
}

int PlanPoints::compare(PointId i, PointId j) const {
    const int c = compare_axis(0, i, j);
    return c != 0 ? c : compare_axis(1, i, j);
}

int PlanPoints::orient(PointId i, PointId j, PointId k) const {
    const PlanPoint &p = (*this)[i], &q = (*this)[j], &r = (*this)[k];
    const double ax = q.x - p.x, ay = q.y - p.y, bx = r.x - p.x, by = r.y - p.y;
    const double left = ax * by, right = ay * bx, det = left - right;
    // Each coordinate is off by at most 2^-51 of the largest one.
    const double largest = std::max({std::fabs(p.x), std::fabs(p.y), std::fabs(q.x), std::fabs(q.y),
                                     std::fabs(r.x), std::fabs(r.y)});
    const double off = 0x1p-49 * largest;
    const double bound =
        0x1p-50 * (std::fabs(left) + std::fabs(right)) +
        off * (std::fabs(ax) + std::fabs(ay) + std::fabs(bx) + std::fabs(by) + 2 * off);
    if (det > bound) return 1;
    if (det < -bound) return -1;
    return exact_orient(p, q, r);
}

}  // namespace tetra::fence
