// SPDX-License-Identifier: LGPL-2.1-or-later
// Makes unimodular maps, gathers candidate directions and sorts them by swept walls.
#include "tetra/fence/directions.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <map>
#include <numeric>
#include <stdexcept>

#include "tetra/errors.h"
#include "walls.h"

namespace tetra {
namespace {

constexpr std::int64_t kCoordinateLimit = std::int64_t{1} << 26;
constexpr double kObliqueHandicap = 1.5;

std::int64_t dot(const Vec3i& a, const Vec3i& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

Vec3i cross(const Vec3i& a, const Vec3i& b) {
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

Vec3i minus(const Vec3i& a, std::int64_t k, const Vec3i& b) {
    return {a[0] - k * b[0], a[1] - k * b[1], a[2] - k * b[2]};
}

std::int64_t nearest_quotient(std::int64_t a, std::int64_t b) {  // b > 0
    return static_cast<std::int64_t>(std::floor(
        (2 * static_cast<double>(a) + static_cast<double>(b)) / (2 * static_cast<double>(b))));
}

// s a + t b = gcd(a, b) >= 0.
std::int64_t bezout(std::int64_t a, std::int64_t b, std::int64_t& s, std::int64_t& t) {
    if (b == 0) {
        s = a < 0 ? -1 : 1;
        t = 0;
        return std::abs(a);
    }
    std::int64_t u = 0, v = 0;
    const std::int64_t g = bezout(b, a % b, u, v);
    s = v;
    t = u - (a / b) * v;
    return g;
}

Vec3i primitive(const Vec3i& v) {
    const std::int64_t g = std::gcd(std::gcd(v[0], v[1]), v[2]);
    if (g == 0) throw std::invalid_argument("a direction must not be zero");
    return {v[0] / g, v[1] / g, v[2] / g};
}

// d and -d are one direction: the last non-zero entry is made positive.
Vec3i canonical(const Vec3i& v) {
    const Vec3i d = primitive(v);
    const std::int64_t last = d[2] ? d[2] : (d[1] ? d[1] : d[0]);
    return last > 0 ? d : Vec3i{-d[0], -d[1], -d[2]};
}

int nonzeros(const Vec3i& d) { return (d[0] != 0) + (d[1] != 0) + (d[2] != 0); }

std::string name_of(const Vec3i& d) {
    if (nonzeros(d) == 1) return d[0] ? "x" : (d[1] ? "y" : "z");
    return std::to_string(d[0]) + "," + std::to_string(d[1]) + "," + std::to_string(d[2]);
}

// Rows u, v span the integer vectors normal to d with u x v = d; m d = 1. All reduced.
std::array<Vec3i, 3> unimodular_rows(const Vec3i& d) {
    std::int64_t s = 0, t = 0, e = 0, f = 0;
    const std::int64_t g = bezout(d[0], d[1], s, t);
    if (g == 0) return {{{d[2], 0, 0}, {0, 1, 0}, {0, 0, d[2]}}};
    bezout(g, d[2], e, f);
    Vec3i u{d[1] / g, -d[0] / g, 0}, v{s * d[2], t * d[2], -g}, m{e * s, e * t, f};
    for (;;) {  // Lagrange's reduction; swaps keep u x v = d
        v = minus(v, nearest_quotient(dot(u, v), dot(u, u)), u);
        if (dot(v, v) >= dot(u, u)) break;
        const Vec3i w = u;
        u = v;
        v = {-w[0], -w[1], -w[2]};
    }
    m = minus(m, nearest_quotient(dot(m, u), dot(u, u)), u);
    m = minus(m, nearest_quotient(dot(m, v), dot(v, v)), v);
    return {u, v, m};
}

// Base edges of the walls along every so manieth line, scaled up; the count ends above `most`.
double counted(fence::Plan& plan, int sampled_lines, double most, Progress& progress) {
    const auto lines = static_cast<int>(plan.lines.size());
    if (lines == 0) return 0;
    fence::WallSample sample;
    sample.stride = std::max(1, lines / std::max(1, sampled_lines));
    const double scale = static_cast<double>(lines) / ((lines + sample.stride - 1) / sample.stride);
    if (most < 1e15) sample.enough = static_cast<std::int64_t>(most / scale) + 1;
    return scale * static_cast<double>(fence::sweep_walls(plan, progress, sample).sides);
}

class Rater {
  public:
    Rater(const std::vector<Vec3i>& points, const std::vector<Triangle>& triangles,
          const std::vector<int>& owner, const DirectionOptions& options, Progress& progress)
        : points_(points),
          triangles_(triangles),
          owner_(owner),
          options_(options),
          progress_(progress) {}

    std::vector<FenceDirection> run() {
        for (const Vec3i& axis : axes()) add(axis, "axis");
        const double good = options_.good * static_cast<double>(triangles_.size());
        for (std::size_t i = 0; i < 3 && best_ > good; ++i) rate(directions_[i]);
        for (const Vec3d& v : options_.candidates) add(nearest(v), "given");
        if (best_ > good) {
            add_edges();
            add_facets();
            for (std::size_t i = 3; i < directions_.size(); ++i) rate(directions_[i]);
        }
        if (std::ranges::all_of(directions_, &FenceDirection::refused))
            throw InvalidSolid(defects_);
        std::stable_sort(
            directions_.begin(), directions_.end(),
            [](const FenceDirection& a, const FenceDirection& b) { return weight(a) < weight(b); });
        return std::move(directions_);
    }

  private:
    static double weight(const FenceDirection& d) {
        if (d.cost < 0) return HUGE_VAL;
        return nonzeros(d.direction) == 1 ? d.cost : d.cost * kObliqueHandicap;
    }

    // Those with most sides along them first: a prism is seen best along its axis.
    std::array<Vec3i, 3> axes() const {
        std::array<std::pair<int, Vec3i>, 3> order{
            {{0, {1, 0, 0}}, {0, {0, 1, 0}}, {0, {0, 0, 1}}}};
        for (const Triangle& t : triangles_)
            for (std::size_t k = 0; k < 3; ++k) {
                const Vec3i e = edge(t, k);
                for (std::size_t axis = 0; axis < 3; ++axis)
                    order[axis].first -= e[(axis + 1) % 3] == 0 && e[(axis + 2) % 3] == 0;
            }
        std::stable_sort(order.begin(), order.end(),
                         [](const auto& a, const auto& b) { return a.first < b.first; });
        return {order[0].second, order[1].second, order[2].second};
    }

    Vec3i nearest(const Vec3d& v) const {
        return nearest_integer_direction(v, options_.largest_entry);
    }

    void add(const Vec3i& v, const char* note) {
        const Vec3i d = canonical(v);
        for (const FenceDirection& known : directions_)
            if (known.direction == d) return;
        directions_.push_back(lay_on_z(d));
        directions_.back().note = note;
    }

    Vec3i edge(const Triangle& t, std::size_t k) const {
        return minus(points_[static_cast<std::size_t>(t[(k + 1) % 3])], 1,
                     points_[static_cast<std::size_t>(t[k])]);
    }

    // Commonest exact directions of the triangles' sides.
    void add_edges() {
        std::map<Vec3i, int> uses;
        for (const Triangle& t : triangles_)
            for (std::size_t k = 0; k < 3; ++k) {
                const Vec3i d = canonical(edge(t, k));
                if (std::ranges::all_of(
                        d, [&](std::int64_t x) { return std::abs(x) <= options_.largest_entry; }))
                    ++uses[d];
            }
        std::vector<std::pair<int, Vec3i>> order;
        for (const auto& [d, n] : uses)
            if (nonzeros(d) > 1) order.emplace_back(-n, d);
        std::sort(order.begin(), order.end());
        for (int i = 0; i < options_.from_edges && i < static_cast<int>(order.size()); ++i)
            add(order[static_cast<std::size_t>(i)].second, "edges");
    }

    // Normals of the planes with most area.
    void add_facets() {
        PlaneTable table;
        std::vector<std::pair<double, int>> area;
        for (const Triangle& t : triangles_) {
            const auto point = [&](int k) {
                return points_[static_cast<std::size_t>(t[static_cast<std::size_t>(k)])];
            };
            const int id = table.intern(plane_through(point(0), point(1), point(2))).id;
            if (id == static_cast<int>(area.size())) area.emplace_back(0, id);
            const Vec3i n = cross(edge(t, 0), edge(t, 1));
            fence::at(area, id).first -= std::hypot(n[0], n[1], n[2]);
        }
        std::sort(area.begin(), area.end());
        for (int i = 0; i < options_.from_facets && i < static_cast<int>(area.size()); ++i) {
            const Plane& p = table[fence::at(area, i).second];
            add(nearest(
                    {static_cast<double>(p.a), static_cast<double>(p.b), static_cast<double>(p.c)}),
                "facet normal");
        }
    }

    void rate(FenceDirection& d) {
        std::vector<Vec3i> laid(points_.size());
        for (std::size_t i = 0; i < points_.size(); ++i)
            for (std::size_t k = 0; k < 3; ++k) {
                laid[i][k] = dot(d.matrix[k], points_[i]);
                if (std::abs(laid[i][k]) > kCoordinateLimit) {
                    d.note += ", needs too many bits";
                    return;
                }
            }
        try {
            FenceInput input;
            input.points = std::move(laid);
            input.triangles = triangles_;
            input.owner = owner_;
            fence::Plan plan = fence::make_plan(input);
            const double handicap = nonzeros(d.direction) == 1 ? 1 : kObliqueHandicap;
            const double most = options_.counted_to * best_ / handicap;
            d.cost = counted(plan, options_.sampled_lines, most, progress_);
            if (d.cost > most) d.note += ", or more";
            best_ = std::min(best_, weight(d));
        } catch (const InvalidSolid& error) {
            d.refused = true;
            d.note += ", " + std::string(error.what());
            defects_ = error.defects;
        }
    }

    const std::vector<Vec3i>& points_;
    const std::vector<Triangle>& triangles_;
    const std::vector<int>& owner_;
    const DirectionOptions& options_;
    Progress& progress_;
    std::vector<FenceDirection> directions_;
    std::vector<Defect> defects_;
    double best_ = HUGE_VAL;
};

}  // namespace

FenceDirection lay_on_z(const Vec3i& direction) {
    FenceDirection out;
    out.direction = primitive(direction);
    out.name = name_of(out.direction);
    if (nonzeros(out.direction) == 1 && dot(out.direction, {1, 1, 1}) == 1) {
        const std::size_t axis = out.direction[0] ? 0 : (out.direction[1] ? 1 : 2);
        for (std::size_t k = 0; k < 3; ++k) {
            out.matrix[k] = {0, 0, 0};
            out.matrix[k][(axis + 1 + k) % 3] = 1;
        }
    } else {
        out.matrix = unimodular_rows(out.direction);
    }
    // det = 1: the inverse has the cross products of the rows as its columns.
    const Vec3i columns[3] = {cross(out.matrix[1], out.matrix[2]),
                              cross(out.matrix[2], out.matrix[0]),
                              cross(out.matrix[0], out.matrix[1])};
    out.growth = 0;
    for (std::size_t k = 0; k < 3; ++k) {
        for (std::size_t c = 0; c < 3; ++c) out.inverse[k][c] = columns[c][k];
        const Vec3i& row = out.matrix[k];
        out.growth = std::max(
            out.growth, static_cast<int>(std::abs(row[0]) + std::abs(row[1]) + std::abs(row[2])));
    }
    return out;
}

Vec3i nearest_integer_direction(const Vec3d& vector, int largest_entry) {
    const double length = std::hypot(vector[0], vector[1], vector[2]);
    if (!(length > 0) || !std::isfinite(length))
        throw std::invalid_argument("a direction must be a finite vector, not zero");
    const double largest =
        std::max({std::fabs(vector[0]), std::fabs(vector[1]), std::fabs(vector[2])});
    Vec3i best{0, 0, 1};
    double best_cosine = -1;
    for (int n = 1; n <= largest_entry; ++n) {
        Vec3i d;
        double product = 0;
        for (std::size_t k = 0; k < 3; ++k) {
            d[k] = std::llround(vector[k] / largest * n);
            product += static_cast<double>(d[k]) * vector[k] / length;
        }
        const double cosine = product / std::hypot(d[0], d[1], d[2]);
        if (cosine > best_cosine + 1e-12) {
            best_cosine = cosine;
            best = d;
        }
    }
    return primitive(best);
}

double count_walls(const std::vector<Vec3i>& points, const std::vector<Triangle>& triangles,
                   const std::vector<int>& owner, int sampled_lines, Progress& progress) {
    FenceInput input;
    input.points = points;
    input.triangles = triangles;
    input.owner = owner;
    fence::Plan plan = fence::make_plan(input);
    return counted(plan, sampled_lines, HUGE_VAL, progress);
}

std::vector<FenceDirection> fence_directions(const std::vector<Vec3i>& points,
                                             const std::vector<Triangle>& triangles,
                                             const std::vector<int>& owner,
                                             const DirectionOptions& options, Progress& progress) {
    return Rater(points, triangles, owner, options, progress).run();
}

}  // namespace tetra
