// SPDX-License-Identifier: LGPL-2.1-or-later
// A tree over cells tells inside from outside, a tree over skin triangles how far outside.
#include "part_distance.h"

#include <cmath>

#include "vec3.h"

namespace tetra {
namespace {

std::size_t at(std::int64_t i) { return static_cast<std::size_t>(i); }

std::vector<FloatBox> boxes_of_cells(const CellArrays& part) {
    std::vector<FloatBox> boxes(part.cell_solid.size());
    for (std::size_t c = 0; c < boxes.size(); ++c)
        for (std::int64_t f = part.cell_offsets[c]; f < part.cell_offsets[c + 1]; ++f)
            for (std::int64_t i = part.facet_offsets[at(f)]; i < part.facet_offsets[at(f + 1)]; ++i)
                boxes[c].add(part.points[at(part.facet_vertices[at(i)])]);
    return boxes;
}

std::vector<Triangle> skin_of(const CellArrays& part) {
    std::vector<Triangle> skin;
    for (std::size_t f = 0; f < part.facet_source.size(); ++f) {
        if (part.facet_source[f] < 0) continue;
        const auto first = static_cast<std::int64_t>(f);
        const std::vector<Triangle> fan = fans(part, first, first + 1);
        skin.insert(skin.end(), fan.begin(), fan.end());
    }
    return skin;
}

std::vector<FloatBox> boxes_of_triangles(std::span<const Vec3d> points,
                                         const std::vector<Triangle>& triangles) {
    std::vector<FloatBox> boxes(triangles.size());
    for (std::size_t t = 0; t < triangles.size(); ++t)
        for (const int i : triangles[t]) boxes[t].add(points[at(i)]);
    return boxes;
}

constexpr double kCoarse = 1e-3;
constexpr double kTouching = 1e-9;  // of the part's size

double square(double x) { return x * x; }

double distance2_to_segment(const Vec3d& p, const Vec3d& a, const Vec3d& b) {
    const Vec3d ab = minus(b, a), ap = minus(p, a);
    const double length2 = dot(ab, ab);
    const double t = length2 > 0 ? std::clamp(dot(ap, ab) / length2, 0.0, 1.0) : 0;
    return square(ap[0] - t * ab[0]) + square(ap[1] - t * ab[1]) + square(ap[2] - t * ab[2]);
}

double distance2_to_triangle(const Vec3d& p, const Vec3d& a, const Vec3d& b, const Vec3d& c) {
    const Vec3d n = normal_of(a, b, c);
    const double n2 = dot(n, n);
    const auto inside = [&](const Vec3d& u, const Vec3d& v) {
        return dot(cross(minus(v, u), minus(p, u)), n) >= 0;
    };
    if (n2 > 0 && inside(a, b) && inside(b, c) && inside(c, a))
        return square(dot(minus(p, a), n)) / n2;
    return std::min({distance2_to_segment(p, a, b), distance2_to_segment(p, b, c),
                     distance2_to_segment(p, c, a)});
}

}  // namespace

Ball ball_around(const Corners& corners) {
    Ball ball{{}, 0};
    for (const Vec3d& p : corners)
        for (std::size_t k = 0; k < 3; ++k) ball.middle[k] += p[k] / 3;
    for (const Vec3d& p : corners) ball.radius = std::max(ball.radius, norm(minus(p, ball.middle)));
    return ball;
}

std::array<Corners, 4> quarters(const Corners& corners) {
    const auto& [a, b, c] = corners;
    const auto between = [](const Vec3d& u, const Vec3d& v) {
        return Vec3d{(u[0] + v[0]) / 2, (u[1] + v[1]) / 2, (u[2] + v[2]) / 2};
    };
    const Vec3d ab = between(a, b), bc = between(b, c), ca = between(c, a);
    return {{{ab, bc, ca}, {a, ab, ca}, {ab, b, bc}, {ca, bc, c}}};
}

double beyond(const HalfSpace& half, const Vec3d& p) { return dot(half.normal, p) - half.height; }

double distance_to(const Vec3d& p, std::span<const Vec3d> points,
                   std::span<const Triangle> triangles) {
    double nearest2 = std::numeric_limits<double>::infinity();
    for (const Triangle& t : triangles)
        nearest2 = std::min(nearest2, distance2_to_triangle(p, points[at(t[0])], points[at(t[1])],
                                                            points[at(t[2])]));
    return std::sqrt(nearest2);
}

std::vector<HalfSpace> half_spaces(std::span<const Vec3d> points,
                                   std::span<const Triangle> triangles) {
    std::vector<HalfSpace> halves;
    for (const Triangle& t : triangles) {
        Vec3d n = normal_of(points[at(t[0])], points[at(t[1])], points[at(t[2])]);
        const double length = norm(n);
        if (!(length > 0)) continue;
        for (double& x : n) x /= length;
        halves.push_back({n, dot(n, points[at(t[0])])});
    }
    return halves;
}

std::vector<Triangle> fans(const CellArrays& part, std::int64_t first, std::int64_t last) {
    std::vector<Triangle> triangles;
    for (std::int64_t f = first; f < last; ++f) {
        const std::int64_t begin = part.facet_offsets[at(f)], end = part.facet_offsets[at(f + 1)];
        for (std::int64_t i = begin + 1; i + 1 < end; ++i)
            triangles.push_back({part.facet_vertices[at(begin)], part.facet_vertices[at(i)],
                                 part.facet_vertices[at(i + 1)]});
    }
    return triangles;
}

PartDistance::PartDistance(const CellArrays& part)
    : points_(part.points),
      skin_(skin_of(part)),
      cells_(boxes_of_cells(part)),
      surface_(boxes_of_triangles(part.points, skin_)) {
    for (std::size_t c = 0; c < part.cell_solid.size(); ++c)
        halves_.push_back(
            half_spaces(points_, fans(part, part.cell_offsets[c], part.cell_offsets[c + 1])));
    FloatBox box;
    for (const int i : part.facet_vertices) box.add(points_[at(i)]);
    if (part.facet_vertices.empty()) return;
    const double diagonal = norm(minus(box.high, box.low));
    touching_ = kTouching * diagonal;
    coarse_ = kCoarse * diagonal;
}

bool PartDistance::inside(std::size_t cell, const Vec3d& p) const {
    const std::vector<HalfSpace>& halves = halves_[cell];
    return std::all_of(halves.begin(), halves.end(),
                       [&](const HalfSpace& h) { return beyond(h, p) <= touching_; });
}

double PartDistance::operator()(const Vec3d& p) const {
    return in_one_cell({p, p, p}) ? 0 : to_surface(p);
}

double PartDistance::to_surface(const Vec3d& p) const {
    double nearest2 = std::numeric_limits<double>::infinity();
    surface_.visit_near(p, nearest2, [&](int t) {
        const Triangle& s = skin_[at(t)];
        nearest2 = std::min(nearest2, distance2_to_triangle(p, points_[at(s[0])], points_[at(s[1])],
                                                            points_[at(s[2])]));
    });
    return std::sqrt(nearest2);
}

bool PartDistance::in_one_cell(const Corners& corners) const {
    return !middle_unless_covered(corners, false).has_value();
}

std::optional<double> PartDistance::middle_unless_covered(const Corners& corners,
                                                          bool measured) const {
    double reach2 = touching_ * touching_;
    bool covered = false, within = false;
    const Vec3d middle = ball_around(corners).middle;
    cells_.visit_near(middle, reach2, [&](int c) {
        if (covered || !inside(at(c), middle)) return;
        within = true;
        covered = std::ranges::all_of(corners, [&](const Vec3d& p) { return inside(at(c), p); });
        if (covered) reach2 = -1;
    });
    if (covered) return std::nullopt;
    return within || !measured ? 0 : to_surface(middle);
}

}  // namespace tetra
