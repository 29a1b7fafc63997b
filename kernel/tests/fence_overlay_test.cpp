// SPDX-License-Identifier: LGPL-2.1-or-later
// The oracle: the overlay of all projected edges gives each (floor, ceiling) the same base area.
#include <gtest/gtest.h>

#include <algorithm>
#include <map>

#include "../src/fence/bases.h"
#include "random_solids.h"

namespace tetra::testing {
namespace {

using Wide = WideInt<16>;
using Mod = std::uint64_t;

// n / d with d > 0, never reduced: small solids only.
struct Fraction {
    Wide n = 0, d = 1;
    Fraction() = default;
    Fraction(std::int64_t v) : n(v) {}  // NOLINT: implicit like a number
    Fraction(const Wide& a, const Wide& b) : n(b.negative() ? -a : a), d(b.negative() ? -b : b) {}
    friend Fraction operator+(const Fraction& a, const Fraction& b) {
        return {a.n * b.d + b.n * a.d, a.d * b.d};
    }
    friend Fraction operator-(const Fraction& a, const Fraction& b) {
        return {a.n * b.d - b.n * a.d, a.d * b.d};
    }
    friend Fraction operator*(const Fraction& a, const Fraction& b) {
        return {a.n * b.n, a.d * b.d};
    }
    friend bool operator<(const Fraction& a, const Fraction& b) { return a.n * b.d < b.n * a.d; }
    friend bool operator==(const Fraction& a, const Fraction& b) { return a.n * b.d == b.n * a.d; }
    Mod mod() const { return multiply_mod(n.mod(kHashPrime), inverse_mod(d.mod(kHashPrime))); }
};

Mod add(Mod a, Mod b) { return (a + b) % kHashPrime; }
Mod sub(Mod a, Mod b) { return (a + kHashPrime - b) % kHashPrime; }

using Areas = std::map<std::pair<int, int>, Mod>;  // (floor, ceiling) -> twice the base area

// No visibility, no stacks beside lines: slabs in x, trapezoids in y, one ray for each.
class Overlay {
  public:
    explicit Overlay(const fence::Plan& plan) : plan_(plan) {
        for (const Triangle& t : plan.input->triangles)
            for (std::size_t k = 0; k < 3; ++k) add_segment(t[k], t[(k + 1) % 3]);
    }

    Areas areas() {
        std::vector<Fraction> xs;
        for (const Segment& s : segments_) {
            xs.push_back(s.a[0]);
            xs.push_back(s.b[0]);
            for (const Segment& t : segments_) add_crossing(s, t, xs);
        }
        std::sort(xs.begin(), xs.end());
        xs.erase(std::unique(xs.begin(), xs.end()), xs.end());
        for (std::size_t i = 1; i < xs.size(); ++i) add_slab(xs[i - 1], xs[i]);
        return areas_;
    }

  private:
    struct Segment {
        Vec3i a, b;  // a left of b; vertical in the plan: none needed between slabs
        std::int64_t dx() const { return b[0] - a[0]; }
        std::int64_t dy() const { return b[1] - a[1]; }
        Fraction y(const Fraction& x) const {
            return Fraction(a[1]) + (x - Fraction(a[0])) * Fraction(Wide(dy()), Wide(dx()));
        }
    };

    void add_segment(int u, int v) {
        const Vec3i &p = plan_.at(u), &q = plan_.at(v);
        if (p[0] < q[0]) segments_.push_back({p, q});
    }

    static void add_crossing(const Segment& s, const Segment& t, std::vector<Fraction>& xs) {
        const std::int64_t w = s.dx() * t.dy() - s.dy() * t.dx();
        if (w == 0) return;
        const std::int64_t u =
            (t.a[0] - s.a[0]) * t.dy() - (t.a[1] - s.a[1]) * t.dx();  // s.a + u / w (s.b - s.a)
        const Fraction x(Wide(s.a[0]) * Wide(w) + Wide(u) * Wide(s.dx()), Wide(w));
        if (x < Fraction(std::max(s.a[0], t.a[0])) || Fraction(std::min(s.b[0], t.b[0])) < x)
            return;
        xs.push_back(x);
    }

    void add_slab(const Fraction& x0, const Fraction& x1) {
        const Fraction half(1, 2), x = (x0 + x1) * half;
        std::vector<std::pair<Fraction, const Segment*>> row;
        for (const Segment& s : segments_)
            if (!(x0 < Fraction(s.a[0])) && !(Fraction(s.b[0]) < x1)) row.emplace_back(s.y(x), &s);
        std::sort(row.begin(), row.end(),
                  [](const auto& a, const auto& b) { return a.first < b.first; });
        for (std::size_t i = 1; i < row.size(); ++i) {
            if (row[i - 1].first == row[i].first) continue;
            const Segment &low = *row[i - 1].second, &high = *row[i].second;
            const Mod left = (high.y(x0) - low.y(x0)).mod(), right = (high.y(x1) - low.y(x1)).mod();
            add_trapezoid(x, (row[i - 1].first + row[i].first) * half,
                          multiply_mod((x1 - x0).mod(), add(left, right)));
        }
    }

    void add_trapezoid(const Fraction& x, const Fraction& y, Mod area) {
        std::vector<std::pair<Fraction, int>> stack;
        for (std::size_t t = 0; t < plan_.facet_of.size(); ++t) {
            const int f = plan_.facet_of[t];
            const int side = fence::at(plan_.facets, f).side;
            if (side != 0 && covers(plan_.input->triangles[t], side, x, y))
                stack.emplace_back(height(fence::at(plan_.facets, f).plane, x, y), f);
        }
        std::sort(stack.begin(), stack.end(), [&](const auto& a, const auto& b) {
            if (!(a.first == b.first)) return a.first < b.first;
            return fence::at(plan_.facets, a.second).side > fence::at(plan_.facets, b.second).side;
        });
        ASSERT_EQ(stack.size() % 2, 0u);
        for (std::size_t i = 0; i < stack.size(); i += 2) {
            Mod& sum = areas_[{stack[i].second, stack[i + 1].second}];
            sum = add(sum, area);
        }
    }

    bool covers(const Triangle& t, int side, const Fraction& x, const Fraction& y) const {
        for (std::size_t k = 0; k < 3; ++k) {
            const Vec3i &u = plan_.at(t[k]), &v = plan_.at(t[(k + 1) % 3]);
            const Fraction turn = Fraction(v[0] - u[0]) * (y - Fraction(u[1])) -
                                  Fraction(v[1] - u[1]) * (x - Fraction(u[0]));
            if (turn.n.sign() * side <= 0) return false;
        }
        return true;
    }

    static Fraction height(const Plane& p, const Fraction& x, const Fraction& y) {
        const Fraction sum = Fraction(p.a) * x + Fraction(p.b) * y + Fraction(Wide(p.d), Wide(1));
        return sum * Fraction(Wide(-1), Wide(p.c));
    }

    const fence::Plan& plan_;
    std::vector<Segment> segments_;
    Areas areas_;
};

Areas areas_of_bases(const fence::Plan& plan, const fence::Bases& bases) {
    Areas areas;
    for (const fence::Base& base : bases.bases) {
        Mod sum = 0;
        for (int e = base.edge_first; e < base.edge_last; ++e) {
            const auto residue = [&](int point) {
                const fence::PlanPoint& p = plan.points[point];
                const Mod w = inverse_mod(Int256(p.w).mod(kHashPrime));
                return std::pair(multiply_mod(Int256(p.X).mod(kHashPrime), w),
                                 multiply_mod(Int256(p.Y).mod(kHashPrime), w));
            };
            const auto [ax, ay] = residue(fence::at(bases.edges, e).from);
            const auto [bx, by] = residue(fence::at(bases.edges, e).to);
            sum = add(sum, sub(multiply_mod(ax, by), multiply_mod(ay, bx)));
        }
        areas[{base.floor, base.ceiling}] = sum;
    }
    return areas;
}

void compare(const TestSolid& solid, const std::string& what) {
    SCOPED_TRACE(what);
    FenceInput input;
    input.points = solid.points;
    input.triangles = solid.triangles;
    fence::Plan plan = fence::make_plan(input);
    Progress progress;
    fence::Walls walls = fence::sweep_walls(plan, progress);
    std::vector<fence::InnerPoint> inner = fence::locate_flat_points(plan, walls);
    fence::join_walls(plan, walls, inner, progress);
    const fence::Bases bases = fence::collect_bases(walls, std::move(inner));
    EXPECT_EQ(areas_of_bases(plan, bases), Overlay(plan).areas());
}

TEST(FenceOverlay, NamedSolids) {
    const TestSolid solids[] = {cube(), octahedron(), schoenhardt(), plate_with_holes(1, 2)};
    for (const TestSolid& solid : solids) {
        compare(solid, "as is");
        compare(map(solid, {{{1, 2, 0}, {-1, 3, 1}, {2, 0, 1}}}), "mapped");
    }
}

TEST(FenceOverlay, RandomVoxelSolids) {
    for (std::uint64_t seed = 0; seed < 40; ++seed) {
        VoxelOptions options;
        options.min_size = options.max_size = 2;
        options.max_bits = 10;
        compare(random_voxel_solid(seed, options), "seed " + std::to_string(seed));
    }
}

}  // namespace
}  // namespace tetra::testing
