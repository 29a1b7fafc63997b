// SPDX-License-Identifier: LGPL-2.1-or-later
// Interning of points by place and the filtered exact signs on them.
#include "point_table.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace tetra::notch {
namespace {

std::uint64_t cell_key(double x, double y, double z) {
    std::uint64_t h = 0;
    for (const double v : {x, y, z}) {
        h ^= static_cast<std::uint64_t>(static_cast<std::int64_t>(v)) + 0x9e3779b97f4a7c15u +
             (h << 6) + (h >> 2);
        h *= 0x9fb21c651e98df25u;
        h ^= h >> 28;
    }
    return h >> 1;
}

double as_double(Int128 v) { return static_cast<double>(v); }

const Int256& coordinate(const HPoint& p, int axis) {
    return axis == 0 ? p.x : (axis == 1 ? p.y : p.z);
}

}  // namespace

int PointTable::add_input(const Vec3i& point) {
    const Vec3d approx{static_cast<double>(point[0]), static_cast<double>(point[1]),
                       static_cast<double>(point[2])};
    const int id = add_moved_input(point, hpoint(point), approx);
    moved_.back() = 0;
    return id;
}

int PointTable::add_moved_input(const Vec3i& grid, const HPoint& exact, const Vec3d& approx) {
    // Every input point has an id of its own, also where two of them should fall together.
    inputs_.push_back(grid);
    moved_.push_back(1);
    std::uint64_t cell = 0;
    find(exact, approx, cell);
    return append(exact, approx, cell);
}

int PointTable::add_point(const HPoint& exact) { return intern(exact, to_doubles(exact)); }

int PointTable::add_plane(const Plane& plane) {
    const PlaneKey key = planes_.intern(plane);
    if (key.id == static_cast<int>(unit_.size())) {
        const Plane& p = planes_[key.id];
        const double a = static_cast<double>(p.a), b = static_cast<double>(p.b),
                     c = static_cast<double>(p.c);
        const double length = std::sqrt(a * a + b * b + c * c);
        unit_.push_back({a / length, b / length, c / length, as_double(p.d) / length});
    }
    return 2 * key.id + (key.side < 0 ? 1 : 0);
}

int PointTable::input_line(int u, int v) {
    lines_.push_back({u, v, -1, -1});
    return lines() - 1;
}

int PointTable::plane_line(int p, int q) {
    if (p > q) std::swap(p, q);
    const std::uint64_t key = pair_key(p, q);
    int id = plane_lines_.find(key);
    if (id < 0) {
        id = lines();
        lines_.push_back({-1, -1, p, q});
        plane_lines_.insert(key, id);
    }
    return id;
}

int PointTable::meet(int line, int plane, int also_p, int also_q) {
    const std::uint64_t key = pair_key(line, plane);
    int id = meets_.find(key);
    if (id < 0) {
        const Line& l = lines_[line];
        HPoint h;
        if (l.u >= 0) {
            const Vec3i &u = inputs_[l.u], &v = inputs_[l.v];
            h = tetra::meet(u, v, plane_value(planes_[plane], u), plane_value(planes_[plane], v));
        } else {
            h = tetra::meet(planes_[l.p], planes_[l.q], planes_[plane]);
        }
        id = intern(h, to_doubles(h));
        if (line_of_[id] < 0 && id >= inputs()) line_of_[id] = line;
        if (l.p >= 0) {
            set_on(id, l.p);
            set_on(id, l.q);
        }
        set_on(id, plane);
        meets_.insert(key, id);
    }
    set_on(id, also_p);
    set_on(id, also_q);
    return id;
}

int PointTable::find(const HPoint& exact, const Vec3d& approx, std::uint64_t& cell) const {
    // Cells of 1/256 step: equal points round to the same cell or to neighbours across a border
    // that is nearer than the error of their approximations.
    std::array<double, 3> base{};
    std::array<double, 3> other{};
    for (int k = 0; k < 3; ++k) {
        const double s = approx[k] * 256;
        base[k] = std::floor(s);
        const double part = s - base[k], reach = tolerance_ * 256;
        other[k] = part < reach ? base[k] - 1 : (part > 1 - reach ? base[k] + 1 : base[k]);
    }
    cell = cell_key(base[0], base[1], base[2]);
    for (int mask = 0; mask < 8; ++mask) {
        bool skip = false;
        std::array<double, 3> c = base;
        for (int k = 0; k < 3; ++k)
            if (mask >> k & 1) {
                skip |= other[k] == base[k];
                c[k] = other[k];
            }
        if (skip) continue;
        for (int i = cells_.find(cell_key(c[0], c[1], c[2])); i >= 0; i = next_in_cell_[i]) {
            const Vec3d& a = approx_[i];
            const double gap = std::max({std::fabs(a[0] - approx[0]), std::fabs(a[1] - approx[1]),
                                         std::fabs(a[2] - approx[2])});
            if (gap <= 2 * tolerance_ && same_point(exact_[i], exact)) return i;
        }
    }
    return -1;
}

int PointTable::intern(const HPoint& exact, const Vec3d& approx) {
    std::uint64_t cell = 0;
    const int id = find(exact, approx, cell);
    return id >= 0 ? id : append(exact, approx, cell);
}

int PointTable::append(const HPoint& exact, const Vec3d& approx, std::uint64_t cell) {
    const int id = points();
    exact_.push_back(exact);
    approx_.push_back(approx);
    on_.emplace_back();
    line_of_.push_back(-1);
    next_in_cell_.push_back(cells_.find(cell));
    cells_.insert(cell, id);
    return id;
}

void PointTable::set_on(int point, int plane) {
    if (!is_on(point, plane)) on_[point].push_back(plane);
}

bool PointTable::is_on(int point, int plane) const {
    for (const int p : on_[point])
        if (p == plane) return true;
    return false;
}

int PointTable::side(int point, int plane) {
    const double value = distance(point, plane);
    if (value > kClassReach) return 1;
    if (value < -kClassReach) return -1;
    if (is_on(point, plane)) return 0;
    if (value > tolerance_) return 1;
    if (value < -tolerance_) return -1;
    const int sign = side_of_plane(planes_[plane], exact_[point]);
    if (sign == 0) on_[point].push_back(plane);
    return sign;
}

int PointTable::compare(int a, int b, int axis) const {
    if (a == b) return 0;
    const double gap = approx_[a][axis] - approx_[b][axis];
    if (gap > 2 * tolerance_) return 1;
    if (gap < -2 * tolerance_) return -1;
    const HPoint &p = exact_[a], &q = exact_[b];
    const Int512 left = multiply<8>(coordinate(p, axis), q.w);
    const Int512 right = multiply<8>(coordinate(q, axis), p.w);
    return left < right ? -1 : (right < left ? 1 : 0);
}

int PointTable::orient(int a, int b, int c, int axis) const {
    const int u = (axis + 1) % 3, v = (axis + 2) % 3;
    const double bu = approx_[b][u] - approx_[a][u], bv = approx_[b][v] - approx_[a][v];
    const double cu = approx_[c][u] - approx_[a][u], cv = approx_[c][v] - approx_[a][v];
    const double det = bu * cv - bv * cu;
    const double bound =
        8 * tolerance_ * (std::fabs(bu) + std::fabs(bv) + std::fabs(cu) + std::fabs(cv) + 1);
    if (det > bound) return 1;
    if (det < -bound) return -1;
    using Wide = WideInt<10>;
    const HPoint *p = &exact_[a], *q = &exact_[b], *r = &exact_[c];
    const auto minor = [&](const HPoint& s, const HPoint& t) {
        return multiply<10>(coordinate(s, u), coordinate(t, v)) -
               multiply<10>(coordinate(s, v), coordinate(t, u));
    };
    const Wide sum = multiply<10>(minor(*q, *r), p->w) + multiply<10>(minor(*r, *p), q->w) +
                     multiply<10>(minor(*p, *q), r->w);
    return sum.sign();
}

Direction PointTable::cross(int p, int q) const {
    const Plane &a = planes_[p], &b = planes_[q];
    return {static_cast<Int128>(a.b) * b.c - static_cast<Int128>(a.c) * b.b,
            static_cast<Int128>(a.c) * b.a - static_cast<Int128>(a.a) * b.c,
            static_cast<Int128>(a.a) * b.b - static_cast<Int128>(a.b) * b.a};
}

Direction PointTable::direction(int line) const {
    const Line& l = lines_[line];
    if (l.u < 0) return cross(l.p, l.q);
    const Vec3i &u = inputs_[l.u], &v = inputs_[l.v];
    return {v[0] - u[0], v[1] - u[1], v[2] - u[2]};
}

}  // namespace tetra::notch
