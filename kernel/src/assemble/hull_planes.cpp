// SPDX-License-Identifier: LGPL-2.1-or-later
// Planes of a polytope as points of its dual, whose hull has a triangle per vertex.
#include "hull_planes.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <optional>

#include "convex_hull.h"
#include "tetra/assemble/double_predicates.h"
#include "vec3.h"

namespace tetra {
namespace {

constexpr double kSameDirection = 1e-6;  // radians: facets of one flat, apart by rounding only
constexpr double kSamePoint = 1e-9;  // of the polytope's size: where more than three planes meet
constexpr std::size_t kMostPlanes = 128;
constexpr double kNever = std::numeric_limits<double>::infinity();

std::size_t at(int i) { return static_cast<std::size_t>(i); }

struct Plane {
    Vec3d normal;   // unit, outward
    double height;  // of the supported points along the normal
};

double beyond(const Plane& plane, const Vec3d& p) { return dot(plane.normal, p) - plane.height; }

Plane supporting(const Vec3d& normal, std::span<const Vec3d> points) {
    double height = -kNever;
    for (const Vec3d& p : points) height = std::max(height, dot(normal, p));
    return {normal, height};
}

// Normals of the larger triangles first, each more than `angle` from those before it.
std::vector<Vec3d> directions(std::span<const Vec3d> points, std::span<const Triangle> triangles,
                              double angle) {
    std::vector<std::pair<double, std::size_t>> by_area;
    std::vector<Vec3d> normals;
    for (const Triangle& t : triangles) {
        normals.push_back(normal_of(points[at(t[0])], points[at(t[1])], points[at(t[2])]));
        by_area.push_back({-norm(normals.back()), normals.size() - 1});
    }
    std::sort(by_area.begin(), by_area.end());
    std::vector<Vec3d> kept;
    for (const auto& [minus_area, i] : by_area) {
        if (minus_area == 0) break;
        Vec3d n = normals[i];
        for (double& x : n) x /= -minus_area;
        const auto like = [&](const Vec3d& k) { return norm(minus(k, n)) < angle; };
        if (std::none_of(kept.begin(), kept.end(), like)) kept.push_back(n);
    }
    return kept;
}

// The corners of an intersection of half-spaces, and which planes meet in each.
struct Corners {
    std::vector<Vec3d> points;
    std::vector<Triangle> planes;  // numbers of three planes per corner
    int distinct = 0;              // corners where more than three planes meet counted once
};

class Reducer {
  public:
    Reducer(std::span<const Vec3d> points, std::span<const Triangle> triangles) {
        for (const Vec3d& p : points)
            for (std::size_t k = 0; k < 3; ++k)
                centre_[k] += p[k] / static_cast<double>(points.size());
        low_ = high_ = centre_;
        for (const Vec3d& p : points) {
            size_ = std::max(size_, norm(minus(p, centre_)));
            for (std::size_t k = 0; k < 3; ++k) {
                low_[k] = std::min(low_[k], p[k]);
                high_[k] = std::max(high_[k], p[k]);
            }
        }
        for (double angle = kSameDirection;; angle *= 2) {
            std::vector<Plane> found;
            for (const Vec3d& n : directions(points, triangles, angle))
                found.push_back(supporting(n, points));
            if (planes_.empty()) start_ = found;
            std::vector<Plane> before = std::move(planes_);
            planes_ = std::move(found);
            if (!corners(all())) {  // too coarse to bound a body
                planes_ = std::move(before);
                break;
            }
            if (planes_.size() <= kMostPlanes) break;
        }
    }

    // The corners of what is left of the polytope, few enough; nothing when it cannot be done.
    // The last planes are left out blindly: the box may stray less.
    std::optional<std::vector<Vec3d>> run(int most) {
        if (planes_.empty()) return std::nullopt;
        std::optional<std::vector<Vec3d>> found = reduced(most);
        std::vector<Vec3d> box = corners_of_box();
        if (!found || strays(box) < strays(*found)) return box;
        return found;
    }

  private:
    std::optional<std::vector<Vec3d>> reduced(int most) {
        kept_ = all();
        costs_.assign(planes_.size(), -1);
        for (;;) {
            const std::optional<Corners> now = corners(kept_);
            if (!now) return std::nullopt;
            if (now->distinct <= most) return merged(*now);
            drop_cheapest(*now);
        }
    }

    Vec3d centre_{}, low_{}, high_{};
    double size_ = 0;
    std::vector<Plane> start_, planes_;
    std::vector<int> kept_;
    std::vector<double> costs_;  // of leaving a plane out; negative: not known yet

    std::vector<int> all() const {
        std::vector<int> numbers(planes_.size());
        std::iota(numbers.begin(), numbers.end(), 0);
        return numbers;
    }

    // Nothing when the half-spaces do not bound a body around the centre.
    std::optional<Corners> corners(const std::vector<int>& numbers) const {
        std::vector<Vec3d> dual;
        for (const int i : numbers) {
            const Plane& plane = planes_[at(i)];
            const double depth = -beyond(plane, centre_);
            if (!(depth > 0)) return std::nullopt;
            dual.push_back(
                {plane.normal[0] / depth, plane.normal[1] / depth, plane.normal[2] / depth});
        }
        Corners found;
        for (const Triangle& t : convex_hull(dual)) {
            const Vec3d &a = dual[at(t[0])], &b = dual[at(t[1])], &c = dual[at(t[2])];
            if (orient3d(a, b, c, Vec3d{0, 0, 0}) >= 0) return std::nullopt;
            const Vec3d m = normal_of(a, b, c);
            const double d = dot(m, a);
            found.points.push_back(
                {centre_[0] + m[0] / d, centre_[1] + m[1] / d, centre_[2] + m[2] / d});
            found.planes.push_back({numbers[at(t[0])], numbers[at(t[1])], numbers[at(t[2])]});
        }
        if (found.points.empty()) return std::nullopt;
        found.distinct = static_cast<int>(merged(found).size());
        return found;
    }

    // Corners that are neighbours in the dual and the same place are one.
    std::vector<Vec3d> merged(const Corners& found) const {
        std::vector<int> parent(found.points.size());
        std::iota(parent.begin(), parent.end(), 0);
        const auto root = [&](int i) {
            while (parent[at(i)] != i) i = parent[at(i)] = parent[at(parent[at(i)])];
            return i;
        };
        std::map<std::array<int, 2>, int> across;
        for (int i = 0; i < static_cast<int>(found.planes.size()); ++i)
            for (std::size_t e = 0; e < 3; ++e) {
                const int u = found.planes[at(i)][e], v = found.planes[at(i)][(e + 1) % 3];
                const auto [other, is_new] = across.insert({{std::min(u, v), std::max(u, v)}, i});
                const int j = other->second;
                if (is_new ||
                    norm(minus(found.points[at(i)], found.points[at(j)])) > kSamePoint * size_)
                    continue;
                parent[at(std::max(root(i), root(j)))] = std::min(root(i), root(j));
            }
        std::vector<Vec3d> points;
        for (int i = 0; i < static_cast<int>(parent.size()); ++i)
            if (root(i) == i) points.push_back(found.points[at(i)]);
        return points;
    }

    void drop_cheapest(const Corners& now) {
        std::vector<char> used(planes_.size(), 0);
        for (const Triangle& t : now.planes)
            for (const int i : t) used[at(i)] = 1;
        int cheapest = -1;
        for (const int i : kept_) {
            if (!used[at(i)]) costs_[at(i)] = 0;  // touches the body nowhere or in a point
            if (costs_[at(i)] < 0) costs_[at(i)] = cost(i);
            if (cheapest < 0 || costs_[at(i)] < costs_[at(cheapest)]) cheapest = i;
        }
        for (const Triangle& t : now.planes)
            if (std::find(t.begin(), t.end(), cheapest) != t.end())
                for (const int i : t) costs_[at(i)] = -1;
        std::erase(kept_, cheapest);
    }

    std::vector<Vec3d> corners_of_box() const {
        std::vector<Vec3d> box;
        for (const double x : {low_[0], high_[0]})
            for (const double y : {low_[1], high_[1]})
                for (const double z : {low_[2], high_[2]}) box.push_back({x, y, z});
        return box;
    }

    // How far points lie beyond the planes of the start.
    double strays(const std::vector<Vec3d>& points) const {
        double most = 0;
        for (const Vec3d& p : points)
            for (const Plane& plane : start_) most = std::max(most, beyond(plane, p));
        return most;
    }

    // How far the corners that appear without plane i lie beyond the planes of the start.
    double cost(int i) const {
        std::vector<int> others = kept_;
        std::erase(others, i);
        const std::optional<Corners> without = corners(others);
        if (!without) return kNever;
        double most = 0;
        for (const Vec3d& p : without->points) {
            if (beyond(planes_[at(i)], p) <= kSamePoint * size_) continue;
            for (const Plane& plane : start_) most = std::max(most, beyond(plane, p));
        }
        return most;
    }
};

}  // namespace

Polytope enclosed_by_fewer(std::span<const Vec3d> points, std::span<const Triangle> triangles,
                           int most) {
    const auto corners = Reducer(points, triangles).run(most);
    Polytope result;
    if (corners) {
        result.points = *corners;
        result.triangles = convex_hull(result.points);
    }
    if (result.triangles.empty())
        return {{points.begin(), points.end()}, {triangles.begin(), triangles.end()}};
    return result;
}

}  // namespace tetra
