// SPDX-License-Identifier: LGPL-2.1-or-later
// Quickhull on exact orientations: the farthest point outside a facet replaces all it sees.
#include "convex_hull.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "tetra/assemble/double_predicates.h"
#include "vec3.h"

namespace tetra {
namespace {

std::size_t at(int i) { return static_cast<std::size_t>(i); }

bool share_coordinate(const Vec3d& a, const Vec3d& b, const Vec3d& c, const Vec3d& d) {
    for (std::size_t k = 0; k < 3; ++k)
        if (a[k] == b[k] && a[k] == c[k] && a[k] == d[k]) return true;
    return false;
}

// orient3d, spared its expansions where CAD puts points into planes of the axes.
int side(const Vec3d& a, const Vec3d& b, const Vec3d& c, const Vec3d& d) {
    return share_coordinate(a, b, c, d) ? 0 : orient3d(a, b, c, d);
}

struct Facet {
    Triangle corners{};
    std::array<int, 3> beside{};  // the facet over the edge from corner i to corner i + 1
    std::vector<int> outside;     // points strictly beyond this facet that no older facet has
    bool alive = true;
    int seen = -1;  // the last point this facet was judged for
    bool visible = false;
};

class Quickhull {
  public:
    explicit Quickhull(std::span<const Vec3d> points) : points_(points) {}

    std::vector<Triangle> run() {
        const auto first = simplex();
        if (!first) return {};
        start(*first);
        for (std::size_t f = 0; f < facets_.size(); ++f)
            while (facets_[f].alive && !facets_[f].outside.empty()) add(static_cast<int>(f));
        std::vector<Triangle> triangles;
        for (const Facet& facet : facets_)
            if (facet.alive) triangles.push_back(facet.corners);
        return triangles;
    }

  private:
    std::span<const Vec3d> points_;
    std::vector<Facet> facets_;
    struct Ridge {
        int inside, outside, edge;  // a visible facet, the one over its edge, and the edge's number
    };
    std::vector<int> stack_, visible_;
    std::vector<Ridge> horizon_;

    const Vec3d& point(int i) const { return points_[at(i)]; }

    bool sees(int p, const Triangle& t) const {
        return side(point(t[0]), point(t[1]), point(t[2]), point(p)) > 0;
    }

    // Four points that span space: extreme ones, so that most points are inside at once.
    std::optional<std::array<int, 4>> simplex() const {
        const int n = static_cast<int>(points_.size());
        if (n < 4) return std::nullopt;
        int a = 0, b = 0;
        for (int i = 1; i < n; ++i)
            if (point(i) < point(a)) a = i;
        b = farthest([&](int i) { return norm(minus(point(i), point(a))); });
        int c = farthest([&](int i) { return norm(normal_of(point(a), point(b), point(i))); });
        const auto height = [&](int i) {
            return std::abs(det3_of_points(point(a), point(b), point(c), point(i)));
        };
        int d = farthest(height);
        if (side(point(a), point(b), point(c), point(d)) != 0) return std::array{a, b, c, d};
        // The measures were too coarse: look for any point off the line, then off the plane.
        for (c = 0; c < n; ++c)
            for (d = c + 1; d < n; ++d)
                if (side(point(a), point(b), point(c), point(d)) != 0)
                    return std::array{a, b, c, d};
        return std::nullopt;
    }

    template <class Measure>
    int farthest(Measure measure) const {
        int best = 0;
        double most = -1;
        for (int i = 0; i < static_cast<int>(points_.size()); ++i)
            if (const double value = measure(i); value > most) {
                most = value;
                best = i;
            }
        return best;
    }

    void start(std::array<int, 4> s) {
        if (side(point(s[0]), point(s[1]), point(s[2]), point(s[3])) > 0) std::swap(s[0], s[1]);
        // Now s[3] lies below (s0, s1, s2); the other facets follow from it.
        const Triangle corners[4] = {
            {s[0], s[1], s[2]}, {s[0], s[3], s[1]}, {s[1], s[3], s[2]}, {s[2], s[3], s[0]}};
        const std::array<int, 3> beside[4] = {{1, 2, 3}, {3, 2, 0}, {1, 3, 0}, {2, 1, 0}};
        for (int f = 0; f < 4; ++f) {
            facets_.push_back({});
            facets_.back().corners = corners[f];
            facets_.back().beside = beside[f];
        }
        std::vector<int> all(points_.size());
        for (std::size_t i = 0; i < all.size(); ++i) all[i] = static_cast<int>(i);
        distribute(all, 0);
    }

    // Gives each point to the first facet from `first` on that it lies strictly beyond.
    void distribute(const std::vector<int>& points, std::size_t first) {
        for (const int p : points)
            for (std::size_t f = first; f < facets_.size(); ++f)
                if (sees(p, facets_[f].corners)) {
                    facets_[f].outside.push_back(p);
                    break;
                }
    }

    // The farthest point of a facet joins the hull.
    void add(int f) {
        const Triangle& t = facets_[at(f)].corners;
        int p = -1;
        double most = -1;
        for (const int q : facets_[at(f)].outside) {
            const double height = det3_of_points(point(t[0]), point(t[1]), point(t[2]), point(q));
            if (height > most || p < 0) {
                most = height;
                p = q;
            }
        }
        find_visible(f, p);
        std::vector<int> orphans;
        for (const int v : visible_) {
            facets_[at(v)].alive = false;
            for (const int q : facets_[at(v)].outside)
                if (q != p) orphans.push_back(q);
            facets_[at(v)].outside = {};
        }
        const std::size_t first = facets_.size();
        cap(p);
        distribute(orphans, first);
    }

    // Gathers what p sees from f on, and the edges where that ends.
    void find_visible(int f, int p) {
        visible_.clear();
        horizon_.clear();
        stack_.assign(1, f);
        facets_[at(f)].seen = p;
        facets_[at(f)].visible = true;
        while (!stack_.empty()) {
            const int v = stack_.back();
            stack_.pop_back();
            visible_.push_back(v);
            for (int e = 0; e < 3; ++e) {
                const int g = facets_[at(v)].beside[at(e)];
                Facet& next = facets_[at(g)];
                if (next.seen != p) {
                    next.seen = p;
                    next.visible = sees(p, next.corners);
                    if (next.visible) stack_.push_back(g);
                }
                if (!next.visible) horizon_.push_back({v, g, e});
            }
        }
    }

    // New facets from p over the horizon, which is one closed cycle of edges.
    void cap(int p) {
        const int first = static_cast<int>(facets_.size());
        std::vector<std::array<int, 2>> starts;  // (first corner, facet)
        for (std::size_t i = 0; i < horizon_.size(); ++i) {
            const auto [v, g, e] = horizon_[i];
            const Triangle& t = facets_[at(v)].corners;
            const int a = t[at(e)], b = t[at((e + 1) % 3)];
            const int made = first + static_cast<int>(i);
            starts.push_back({a, made});
            Facet facet;
            facet.corners = {a, b, p};
            facet.beside[0] = g;
            for (int& back : facets_[at(g)].beside)
                if (back == v && edge_is(g, back, b, a)) {
                    back = made;
                    break;
                }
            facets_.push_back(std::move(facet));
        }
        std::sort(starts.begin(), starts.end());
        for (int i = first; i < static_cast<int>(facets_.size()); ++i) {
            const int b = facets_[at(i)].corners[1];
            const auto next = std::lower_bound(starts.begin(), starts.end(), std::array{b, -1});
            const int after = (*next)[1];
            facets_[at(i)].beside[1] = after;
            facets_[at(after)].beside[2] = i;
        }
    }

    // Whether the edge that `slot` (of facet g) stands for runs from a to b.
    bool edge_is(int g, const int& slot, int a, int b) const {
        const Facet& facet = facets_[at(g)];
        const auto e = static_cast<int>(&slot - facet.beside.data());
        return facet.corners[at(e)] == a && facet.corners[at((e + 1) % 3)] == b;
    }
};

}  // namespace

std::vector<Triangle> convex_hull(std::span<const Vec3d> points) { return Quickhull(points).run(); }

double volume6(std::span<const Vec3d> points, std::span<const Triangle> triangles) {
    if (triangles.empty()) return 0;
    const Vec3d& origin = points[at(triangles.front()[0])];
    double sum = 0;
    for (const Triangle& t : triangles)
        sum += dot(minus(points[at(t[0])], origin),
                   cross(minus(points[at(t[1])], origin), minus(points[at(t[2])], origin)));
    return sum;
}

}  // namespace tetra
