// SPDX-License-Identifier: LGPL-2.1-or-later
// Lawson flips with exact legality and an approximate preference.

#include "tetra/polygon/delaunay.h"

#include <algorithm>
#include <cmath>

#include "half_edges.h"

namespace tetra {

namespace {

constexpr double margin = 1e-10;
constexpr std::size_t flips_per_triangle = 64;

using Vector = std::array<double, 2>;

Vector minus(const Vector& a, const Vector& b) { return {a[0] - b[0], a[1] - b[1]}; }
double cross(const Vector& a, const Vector& b) { return a[0] * b[1] - a[1] * b[0]; }
double dot(const Vector& a, const Vector& b) { return a[0] * b[0] + a[1] * b[1]; }

class Flipper {
  public:
    Flipper(std::span<const PlanarTriangle> triangles, std::span<const DirectedEdge> fixed,
            const PointOracle& oracle, const ApproximatePoint& approximate)
        : oracle_(oracle), opposite_(opposite_sides(triangles, fixed)) {
        for (const PlanarTriangle& t : triangles) {
            ids_.insert(ids_.end(), t.begin(), t.end());
        }
        std::sort(ids_.begin(), ids_.end());
        ids_.erase(std::unique(ids_.begin(), ids_.end()), ids_.end());
        for (const PointId id : ids_) {
            place_.push_back(approximate(id));
        }
        for (const PlanarTriangle& t : triangles) {
            for (const PointId id : t) {
                const auto at = std::lower_bound(ids_.begin(), ids_.end(), id);
                start_.push_back(static_cast<int>(at - ids_.begin()));
            }
        }
    }

    void run() {
        waiting_.assign(start_.size(), 0);
        for (int side = static_cast<int>(start_.size()) - 1; side >= 0; --side) {
            push(side);
        }
        std::size_t flips_left = flips_per_triangle * (start_.size() / 3);
        while (!stack_.empty() && flips_left > 0) {
            const int side = stack_.back();
            stack_.pop_back();
            waiting_[side] = 0;
            if (opposite_[side] >= 0 && is_wanted(side) && is_legal(side)) {
                flip(side);
                --flips_left;
            }
        }
    }

    std::vector<PlanarTriangle> triangles() const {
        std::vector<PlanarTriangle> out;
        for (std::size_t k = 0; k < start_.size(); k += 3) {
            out.push_back({ids_[start_[k]], ids_[start_[k + 1]], ids_[start_[k + 2]]});
        }
        return out;
    }

  private:
    /// The quadrilateral a, d, b, c around a side from a to b, counter-clockwise.
    struct Quad {
        int a, b, c, d;
    };

    Quad quad_around(int side) const {
        const int other = opposite_[side];
        return {start_[side], start_[other], start_[previous_side(side)],
                start_[previous_side(other)]};
    }

    /// Each pair of sides waits once, as the lower of the two.
    void push(int side) {
        const int other = opposite_[side];
        if (other < 0) {
            return;
        }
        const int key = std::min(side, other);
        if (waiting_[key] == 0) {
            waiting_[key] = 1;
            stack_.push_back(key);
        }
    }

    bool is_wanted(int side) const {
        const Quad q = quad_around(side);
        const Vector ca = minus(place_[q.a], place_[q.c]);
        const Vector cb = minus(place_[q.b], place_[q.c]);
        const Vector da = minus(place_[q.a], place_[q.d]);
        const Vector db = minus(place_[q.b], place_[q.d]);
        const double sine_c = cross(ca, cb);
        const double sine_d = cross(db, da);
        const double cosine_c = dot(ca, cb);
        const double cosine_d = dot(da, db);
        const double scale =
            (std::abs(sine_c) + std::abs(cosine_c)) * (std::abs(sine_d) + std::abs(cosine_d));
        return sine_c * cosine_d + cosine_c * sine_d < -margin * scale;
    }

    bool is_legal(int side) const {
        const Quad q = quad_around(side);
        return oracle_.orient(ids_[q.a], ids_[q.d], ids_[q.c]) > 0 &&
               oracle_.orient(ids_[q.d], ids_[q.b], ids_[q.c]) > 0;
    }

    /// Keeps the sides of the two triangles in their six places: d c a and c d b.
    void flip(int h) {
        const Quad q = quad_around(h);
        const int g = opposite_[h];
        const int h_next = next_side(h);
        const int h_last = previous_side(h);
        const int g_next = next_side(g);
        const int g_last = previous_side(g);
        const int beyond_bc = opposite_[h_next];
        const int beyond_ca = opposite_[h_last];
        const int beyond_ad = opposite_[g_next];
        const int beyond_db = opposite_[g_last];
        start_[h] = q.d;
        start_[h_next] = q.c;
        start_[h_last] = q.a;
        start_[g] = q.c;
        start_[g_next] = q.d;
        start_[g_last] = q.b;
        link(h_next, beyond_ca);
        link(h_last, beyond_ad);
        link(g_next, beyond_db);
        link(g_last, beyond_bc);
        for (const int side : {h_next, h_last, g_next, g_last}) {
            push(side);
        }
    }

    void link(int side, int other) {
        opposite_[side] = other;
        if (other >= 0) {
            opposite_[other] = side;
        }
    }

    const PointOracle& oracle_;
    std::vector<int> opposite_;
    std::vector<PointId> ids_;
    std::vector<Vector> place_;
    std::vector<int> start_;  ///< per side the point it comes from, as an index into ids_
    std::vector<int> stack_;
    std::vector<char> waiting_;
};

}  // namespace

std::vector<PlanarTriangle> flip_towards_delaunay(std::vector<PlanarTriangle> triangles,
                                                  std::span<const DirectedEdge> fixed,
                                                  const PointOracle& oracle,
                                                  const ApproximatePoint& approximate) {
    Flipper flipper(triangles, fixed, oracle, approximate);
    flipper.run();
    return flipper.triangles();
}

}  // namespace tetra
