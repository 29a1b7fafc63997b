// SPDX-License-Identifier: LGPL-2.1-or-later
// The oracle: the overlay of all projected edges gives each (floor, ceiling) the same base area and
// volume, the same walls to each neighbour, and the same walls on the skin.
#include <gtest/gtest.h>

#include <algorithm>
#include <map>

#include "../src/fence/columns.h"
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

using Cell = std::pair<int, int>;  // floor, ceiling
constexpr Cell kOutside{-1, -1};

// Exact figures modulo the prime, for each cell and each pair of neighbours (or cell and outside).
// Of walls twice the areas of their projections along y and along x.
struct Census {
    std::map<Cell, Mod> base2, volume6;
    std::map<std::pair<Cell, Cell>, std::array<Mod, 2>> walls;
    friend bool operator==(const Census&, const Census&) = default;

    void add_wall(const Cell& a, const Cell& b, Mod dx, Mod dy, Mod heights) {
        std::array<Mod, 2>& sum = walls[{std::min(a, b), std::max(a, b)}];
        sum[0] = add(sum[0], multiply_mod(dx, heights));
        sum[1] = add(sum[1], multiply_mod(dy, heights));
    }
};

// No visibility, no stacks beside lines: slabs in x, trapezoids in y, one ray for each.
class Overlay {
  public:
    explicit Overlay(const fence::Plan& plan) : plan_(plan) {
        for (const Triangle& t : plan.input->triangles)
            for (std::size_t k = 0; k < 3; ++k) add_segment(t[k], t[(k + 1) % 3]);
    }

    Census census() {
        std::vector<Fraction> xs;
        for (const Segment& s : segments_) {
            xs.push_back(s.a[0]);
            xs.push_back(s.b[0]);
            for (const Segment& t : segments_) add_crossing(s, t, xs);
        }
        std::sort(xs.begin(), xs.end());
        xs.erase(std::unique(xs.begin(), xs.end()), xs.end());
        std::vector<Trapezoid> before;
        for (std::size_t i = 1; i < xs.size(); ++i) {
            std::vector<Trapezoid> here = slab(xs[i - 1], xs[i]);
            add_walls_at(xs[i - 1], before, here);
            before = std::move(here);
        }
        add_walls_at(xs.back(), before, {});
        return std::move(out_);
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

    using Place = std::array<Fraction, 2>;

    // Between two segments with nothing between; the cells over it bottom up.
    struct Trapezoid {
        const Segment *low, *high;
        std::vector<Cell> stack;
    };

    std::vector<Trapezoid> slab(const Fraction& x0, const Fraction& x1) {
        const Fraction half(1, 2), x = (x0 + x1) * half;
        std::vector<std::pair<Fraction, const Segment*>> row;
        for (const Segment& s : segments_)
            if (!(x0 < Fraction(s.a[0])) && !(Fraction(s.b[0]) < x1)) row.emplace_back(s.y(x), &s);
        std::sort(row.begin(), row.end(),
                  [](const auto& a, const auto& b) { return a.first < b.first; });
        row.erase(std::unique(row.begin(), row.end(),
                              [](const auto& a, const auto& b) { return a.first == b.first; }),
                  row.end());
        std::vector<Trapezoid> list;
        const std::vector<Cell> nothing;
        for (std::size_t i = 0; i < row.size(); ++i) {
            const Segment& s = *row[i].second;
            if (i + 1 < row.size())
                list.push_back(
                    {&s, row[i + 1].second, stack_at(x, (row[i].first + row[i + 1].first) * half)});
            const std::vector<Cell>& below = i > 0 ? list[i - 1].stack : nothing;
            const std::vector<Cell>& above = i + 1 < row.size() ? list[i].stack : nothing;
            add_wall(below, above, {x0, s.y(x0)}, {x1, s.y(x1)});
        }
        for (const Trapezoid& t : list) add_body(t, x0, x1);
        return list;
    }

    void add_body(const Trapezoid& t, const Fraction& x0, const Fraction& x1) {
        const Place a{x0, t.low->y(x0)}, b{x1, t.low->y(x1)}, c{x1, t.high->y(x1)},
            d{x0, t.high->y(x0)};
        for (const auto& triangle : {std::array{a, b, c}, std::array{a, c, d}}) {
            const auto& [p, q, r] = triangle;
            const Mod area2 = ((q[0] - p[0]) * (r[1] - p[1]) - (q[1] - p[1]) * (r[0] - p[0])).mod();
            for (const Cell& cell : t.stack) {
                Mod heights = 0;
                for (const Place& v : triangle)
                    heights = add(heights, (z(cell.second, v) - z(cell.first, v)).mod());
                out_.base2[cell] = add(out_.base2[cell], area2);
                out_.volume6[cell] = add(out_.volume6[cell], multiply_mod(area2, heights));
            }
        }
    }

    // Walls across the line of given x, between the trapezoids left and right of it.
    void add_walls_at(const Fraction& x, const std::vector<Trapezoid>& left,
                      const std::vector<Trapezoid>& right) {
        std::vector<Fraction> ys;
        for (const auto* side : {&left, &right})
            for (const Trapezoid& t : *side) {
                ys.push_back(t.low->y(x));
                ys.push_back(t.high->y(x));
            }
        std::sort(ys.begin(), ys.end());
        ys.erase(std::unique(ys.begin(), ys.end()), ys.end());
        for (std::size_t i = 1; i < ys.size(); ++i)
            add_wall(stack_between(left, x, ys[i - 1], ys[i]),
                     stack_between(right, x, ys[i - 1], ys[i]), {x, ys[i - 1]}, {x, ys[i]});
    }

    static std::vector<Cell> stack_between(const std::vector<Trapezoid>& list, const Fraction& x,
                                           const Fraction& y0, const Fraction& y1) {
        for (const Trapezoid& t : list)
            if (!(y0 < t.low->y(x)) && !(t.high->y(x) < y1)) return t.stack;
        return {};
    }

    // Over the straight line p - q, on which no two facets change their order.
    void add_wall(const std::vector<Cell>& a, const std::vector<Cell>& b, const Place& p,
                  const Place& q) {
        const Mod dx = size(q[0] - p[0]).mod(), dy = size(q[1] - p[1]).mod();
        for (const auto& [here, there] : {std::pair(&a, &b), std::pair(&b, &a)})
            for (const Cell& cell : *here) {
                Mod bare = 0;
                for (const Place& end : {p, q})
                    bare = add(bare, (z(cell.second, end) - z(cell.first, end)).mod());
                for (const Cell& other : *there) {
                    const Mod common =
                        add(overlap(cell, other, p).mod(), overlap(cell, other, q).mod());
                    bare = sub(bare, common);
                    if (here == &a && cell != other && common != 0)
                        out_.add_wall(cell, other, dx, dy, common);
                }
                if (bare != 0) out_.add_wall(kOutside, cell, dx, dy, bare);
            }
    }

    Fraction overlap(const Cell& a, const Cell& b, const Place& p) const {
        const Fraction low = std::max(z(a.first, p), z(b.first, p)),
                       high = std::min(z(a.second, p), z(b.second, p));
        return low < high ? high - low : Fraction(0);
    }

    static Fraction size(const Fraction& f) { return f < Fraction(0) ? Fraction(0) - f : f; }

    std::vector<Cell> stack_at(const Fraction& x, const Fraction& y) const {
        std::vector<std::pair<Fraction, int>> stack;
        for (std::size_t t = 0; t < plan_.facet_of.size(); ++t) {
            const int f = plan_.facet_of[t];
            const int side = fence::at(plan_.facets, f).side;
            if (side != 0 && covers(plan_.input->triangles[t], side, x, y))
                stack.emplace_back(z(f, {x, y}), f);
        }
        std::sort(stack.begin(), stack.end(), [&](const auto& a, const auto& b) {
            if (!(a.first == b.first)) return a.first < b.first;
            return fence::at(plan_.facets, a.second).side > fence::at(plan_.facets, b.second).side;
        });
        EXPECT_EQ(stack.size() % 2, 0u);
        std::vector<Cell> cells;
        for (std::size_t i = 0; i + 1 < stack.size(); i += 2)
            cells.emplace_back(stack[i].second, stack[i + 1].second);
        return cells;
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

    Fraction z(int facet, const Place& v) const {
        const Plane& p = fence::at(plan_.facets, facet).plane;
        const Fraction sum =
            Fraction(p.a) * v[0] + Fraction(p.b) * v[1] + Fraction(Wide(p.d), Wide(1));
        return sum * Fraction(Wide(-1), Wide(p.c));
    }

    const fence::Plan& plan_;
    std::vector<Segment> segments_;
    Census out_;
};

// The same from the tetrahedra of the fences, one (floor, ceiling) at a time.
class FenceCensus {
  public:
    FenceCensus(const fence::Plan& plan, const fence::Walls& walls, const fence::Joints& joints,
                const fence::Bases& bases)
        : plan_(plan), walls_(walls), joints_(joints), bases_(bases) {
        for (const fence::Mark& m : joints.marks)
            place_.push_back(residues(fence::place_of(plan, m)));
    }

    Census census() {
        for (const fence::Base& base : bases_.bases) add_base(base);
        for (const auto& [corners, cells] : wall_cells_) {
            EXPECT_LE(cells.size(), 2u) << "cells on a wall";
            const Cell other = cells.size() == 2 ? cells[1] : kOutside;
            if (cells[0] != other) add_triangle(corners, cells[0], other);
        }
        return std::move(out_);
    }

  private:
    void add_base(const fence::Base& base) {
        const Cell cell{base.floor, base.ceiling};
        Mod area2 = 0;
        for (int e = base.edge_first; e < base.edge_last; ++e) {
            const auto [ax, ay] = plan_residue(fence::at(bases_.edges, e).from);
            const auto [bx, by] = plan_residue(fence::at(bases_.edges, e).to);
            area2 = add(area2, sub(multiply_mod(ax, by), multiply_mod(ay, bx)));
        }
        out_.base2[cell] = area2;
        fence::Bases one = bases_;
        one.bases = {base};
        Progress progress;
        const fence::Columns columns = fence::build_columns(plan_, walls_, joints_, one, progress);
        std::vector<std::array<Mod, 3>> at = place_;
        for (const HPoint& p : columns.cone_points) at.push_back(residues(p));
        Mod& volume = out_.volume6[cell];
        for (const auto& t : columns.tets)
            volume = add(volume, det(fence::at(at, t[0]), fence::at(at, t[1]), fence::at(at, t[2]),
                                     fence::at(at, t[3])));
        for (const fence::WallTriangle& w : columns.walls) {
            Triangle corners = w.corners;
            std::sort(corners.begin(), corners.end());
            wall_cells_[corners].push_back(cell);
        }
    }

    std::pair<Mod, Mod> plan_residue(int point) const {
        const fence::PlanPoint& p = plan_.points[point];
        const Mod w = inverse_mod(Int256(p.w).mod(kHashPrime));
        return {multiply_mod(Int256(p.X).mod(kHashPrime), w),
                multiply_mod(Int256(p.Y).mod(kHashPrime), w)};
    }

    static Mod det(const std::array<Mod, 3>& a, const std::array<Mod, 3>& b,
                   const std::array<Mod, 3>& c, const std::array<Mod, 3>& d) {
        std::array<std::array<Mod, 3>, 3> m{b, c, d};
        for (auto& row : m)
            for (std::size_t k = 0; k < 3; ++k) row[k] = sub(row[k], a[k]);
        Mod sum = 0;
        for (std::size_t k = 0; k < 3; ++k) {
            const std::size_t u = (k + 1) % 3, v = (k + 2) % 3;
            const Mod minor = sub(multiply_mod(m[1][u], m[2][v]), multiply_mod(m[1][v], m[2][u]));
            sum = add(sum, multiply_mod(m[0][k], minor));
        }
        return sum;
    }

    // Two corners lie on one vertical line; marks ascend with the height.
    void add_triangle(const Triangle& corners, const Cell& a, const Cell& b) {
        const auto point = [&](std::size_t i) {
            return fence::at(joints_.marks, corners[i]).point;
        };
        const bool low_pair = point(0) == point(1);
        const std::size_t i = low_pair ? 0 : 1, lone = low_pair ? 2 : 0;
        ASSERT_EQ(point(i), point(i + 1));
        const Mod height =
            sub(fence::at(place_, corners[i + 1])[2], fence::at(place_, corners[i])[2]);
        out_.add_wall(a, b, distance(point(lone), point(i), 0), distance(point(lone), point(i), 1),
                      height);
    }

    Mod distance(int p, int q, std::size_t axis) const {
        const fence::PlanPoint &a = plan_.points[p], &b = plan_.points[q];
        const auto [ax, ay] = plan_residue(p);
        const auto [bx, by] = plan_residue(q);
        const Mod difference = axis == 0 ? sub(bx, ax) : sub(by, ay);
        const bool falls = axis == 0 ? b.x < a.x : b.y < a.y;
        return falls ? sub(0, difference) : difference;
    }

    const fence::Plan& plan_;
    const fence::Walls& walls_;
    const fence::Joints& joints_;
    const fence::Bases& bases_;
    std::vector<std::array<Mod, 3>> place_;  // of marks
    std::map<Triangle, std::vector<Cell>> wall_cells_;
    Census out_;
};

void compare(const TestSolid& solid, const std::string& what) {
    SCOPED_TRACE(what);
    FenceInput input;
    input.points = solid.points;
    input.triangles = solid.triangles;
    fence::Plan plan = fence::make_plan(input);
    Progress progress;
    fence::Walls walls = fence::sweep_walls(plan, progress);
    std::vector<fence::InnerPoint> inner = fence::locate_flat_points(plan, walls);
    const fence::Joints joints = fence::join_walls(plan, walls, inner, progress);
    const fence::Bases bases = fence::collect_bases(walls, std::move(inner));
    const Census found = FenceCensus(plan, walls, joints, bases).census(),
                 wanted = Overlay(plan).census();
    EXPECT_EQ(found.base2, wanted.base2);
    EXPECT_EQ(found.volume6, wanted.volume6);
    EXPECT_EQ(found.walls, wanted.walls);
    Mod volume = 0;
    for (const auto& [cell, v] : found.volume6) volume = add(volume, v);
    EXPECT_EQ(volume, volume6(solid).mod(kHashPrime));
}

TEST(FenceOverlay, NamedSolids) {
    const TestSolid solids[] = {cube(), octahedron(), schoenhardt(), plate_with_holes(1, 2)};
    for (const TestSolid& solid : solids) {
        compare(solid, "as is");
        compare(map(solid, {{{1, 2, 0}, {-1, 3, 1}, {2, 0, 1}}}), "mapped");
    }
}

TEST(FenceOverlay, RandomVoxelSolids) {
    for (std::uint64_t seed = 0; seed < 20; ++seed) {
        VoxelOptions options;
        options.min_size = options.max_size = 2;
        options.max_bits = 10;
        compare(random_voxel_solid(seed, options), "seed " + std::to_string(seed));
    }
}

}  // namespace
}  // namespace tetra::testing
