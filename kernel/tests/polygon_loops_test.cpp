// SPDX-License-Identifier: LGPL-2.1-or-later
// Loops into regions: parity, orientation, touching, and edges at fault against brute force.

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "polygon_support.h"
#include "tetra/polygon/double_points.h"
#include "tetra/polygon/triangulate.h"

namespace tetra {
namespace {

using testing::IntegerPoints;
using testing::Point;
using testing::Polyomino;
using Loops = std::vector<std::vector<PointId>>;

std::vector<int> edges_at_fault(const std::vector<Point>& points, const Loops& loops) {
    try {
        region_of_loops(loops, IntegerPoints(points));
    } catch (const InvalidRegion& e) {
        return e.edges_at_fault;
    }
    return {};
}

TEST(Loops, direction_does_not_matter) {
    const IntegerPoints points(
        {{0, 0}, {9, 0}, {9, 9}, {0, 9}, {3, 3}, {6, 3}, {6, 6}, {3, 6}, {4, 4}, {5, 4}, {4, 5}});
    const Loops loops{{0, 1, 2, 3}, {7, 6, 5, 4}, {8, 9, 10}};
    const std::int64_t area = 2 * (81 - 9) + 1;
    for (int turned = 0; turned < 8; ++turned) {
        Loops some = loops;
        for (int k = 0; k < 3; ++k) {
            if ((turned >> k) % 2 != 0) std::reverse(some[k].begin(), some[k].end());
        }
        const auto edges = region_of_loops(some, points);
        EXPECT_EQ(points.twice_area(edges), area);
        EXPECT_EQ(testing::flaw_of(triangulate_region(edges, points), edges, points), "");
    }
}

TEST(Loops, edges_keep_their_positions) {
    const IntegerPoints points({{0, 0}, {9, 0}, {9, 9}});
    const auto edges = region_of_loops(Loops{{0, 2, 1}}, points);
    EXPECT_EQ(edges, (std::vector<DirectedEdge>{{2, 0}, {1, 2}, {0, 1}}));
}

TEST(Loops, may_touch_in_vertices) {
    const IntegerPoints points({{0, 0}, {8, 0}, {8, 8}, {0, 8}, {3, 2}, {2, 3}});
    const auto edges = region_of_loops(Loops{{0, 1, 2, 3}, {0, 4, 5}}, points);
    EXPECT_EQ(points.twice_area(edges), 2 * 64 - 5);
    EXPECT_EQ(testing::flaw_of(triangulate_region(edges, points), edges, points), "");
}

TEST(Loops, edges_at_fault_are_named) {
    const std::vector<Point> square{{0, 0}, {4, 0}, {4, 4}, {0, 4}, {2, 0}, {2, 9}, {1, 5}};
    EXPECT_EQ(edges_at_fault(square, {{0, 1, 3, 2}}), (std::vector<int>{1, 3}));  // bow tie
    EXPECT_EQ(edges_at_fault(square, {{0, 1, 2, 3}, {4, 5, 6}}), (std::vector<int>{2, 6}));
    EXPECT_EQ(edges_at_fault(square, {{0, 1, 2, 3}, {0, 1, 5}}), (std::vector<int>{0, 4}));
    EXPECT_EQ(edges_at_fault(square, {{0, 1, 4}}), (std::vector<int>{0, 2}));  // flat
    EXPECT_EQ(edges_at_fault(square, {{0, 1, 1, 2}}), std::vector<int>{1});
}

TEST(Loops, short_loops_and_coinciding_points_are_errors) {
    const IntegerPoints points({{0, 0}, {4, 0}, {4, 4}, {4, 4}, {0, 4}});
    EXPECT_THROW(region_of_loops(Loops{{0, 1}}, points), InvalidRegion);
    EXPECT_THROW(region_of_loops(Loops{{0, 1, 2, 3, 4}}, points), InvalidRegion);
}

/// Whether two edges have more in common than one end.
bool clash(const IntegerPoints& points, const DirectedEdge& p, const DirectedEdge& q) {
    const auto& at = points.points();
    const auto on = [&](int x, const DirectedEdge& e) {
        const Point low = std::min(at[e.from], at[e.to]);
        const Point high = std::max(at[e.from], at[e.to]);
        return points.orient(e.from, e.to, x) == 0 && low <= at[x] && at[x] <= high;
    };
    const auto inside = [&](int x, const DirectedEdge& e) {
        return x != e.from && x != e.to && on(x, e);
    };
    if (inside(p.from, q) || inside(p.to, q) || inside(q.from, p) || inside(q.to, p)) return true;
    if ((p.from == q.from && p.to == q.to) || (p.from == q.to && p.to == q.from)) return true;
    return points.orient(p.from, p.to, q.from) * points.orient(p.from, p.to, q.to) < 0 &&
           points.orient(q.from, q.to, p.from) * points.orient(q.from, q.to, p.to) < 0;
}

TEST(LoopsRandom, sweep_agrees_with_all_pairs) {
    std::mt19937_64 random(10);
    const int cases = testing::case_count(5000);
    int good = 0;
    for (int k = 0; k < cases; ++k) {
        std::set<Point> distinct;
        const int size = testing::draw(random, 2, 7);
        const int n = testing::draw(random, 3, 9);
        while (static_cast<int>(distinct.size()) < std::min(n, size * size)) {
            distinct.insert({testing::draw(random, 0, size), testing::draw(random, 0, size)});
        }
        std::vector<Point> positions(distinct.begin(), distinct.end());
        std::shuffle(positions.begin(), positions.end(), random);
        const IntegerPoints points(positions);
        Loops loops(1);
        for (std::size_t i = 0; i < positions.size(); ++i) {
            if (loops.back().size() >= 3 && positions.size() - i >= 3 &&
                testing::draw(random, 0, 3) == 0) {
                loops.emplace_back();
                if (testing::draw(random, 0, 1) == 0) loops.back().push_back(0);
            }
            loops.back().push_back(static_cast<int>(i));
        }
        const auto given = testing::edges_of(loops);
        bool bad = false;
        for (std::size_t i = 0; i < given.size(); ++i) {
            for (std::size_t j = 0; j < i; ++j) bad = bad || clash(points, given[i], given[j]);
        }
        try {
            const auto edges = region_of_loops(loops, points);
            ASSERT_FALSE(bad) << "case " << k;
            const auto triangles = triangulate_region(edges, points);
            ASSERT_EQ(testing::flaw_of(triangles, edges, points), "") << "case " << k;
            ++good;
        } catch (const InvalidRegion& e) {
            ASSERT_TRUE(bad) << "case " << k << ": " << e.what();
            ASSERT_EQ(e.edges_at_fault.size(), 2U);
            ASSERT_TRUE(clash(points, given[e.edges_at_fault[0]], given[e.edges_at_fault[1]]))
                << "case " << k << ": " << e.what();
        }
    }
    EXPECT_GT(good, cases / 20);
}

/// A soup of crossing edges gives an error, or triangles that cover what it winds around.
TEST(LoopsRandom, triangulation_of_crossing_soups_is_never_wrong_in_silence) {
    std::mt19937_64 random(12);
    const int cases = testing::case_count(5000);
    for (int k = 0; k < cases; ++k) {
        const int n = testing::draw(random, 3, 9);
        std::set<Point> distinct;
        while (static_cast<int>(distinct.size()) < n) {
            distinct.insert({testing::draw(random, 0, 6), testing::draw(random, 0, 6)});
        }
        std::vector<Point> positions(distinct.begin(), distinct.end());
        std::shuffle(positions.begin(), positions.end(), random);
        const IntegerPoints points(positions);
        std::vector<DirectedEdge> edges;
        for (int i = 0; i < n; ++i) edges.push_back({i, (i + 1) % n});
        try {
            const auto triangles = triangulate_region(edges, points);
            ASSERT_EQ(testing::flaw_of(triangles, edges, points), "") << "case " << k;
        } catch (const InvalidRegion&) {
            continue;
        }
    }
}

TEST(DoublePoints, orientation_is_exact_near_a_line) {
    // The classic grid of neighbouring doubles around (0.5, 0.5) against the line of two far
    // points.
    std::vector<std::array<double, 2>> points{{12.0, 12.0}, {24.0, 24.0}};
    for (int y = 0; y < 32; ++y) {
        for (int x = 0; x < 32; ++x) points.push_back({0.5 + x * 0x1p-53, 0.5 + y * 0x1p-53});
    }
    const DoublePoints oracle(points);
    for (std::size_t k = 2; k < points.size(); ++k) {
        const int expected =
            points[k][0] == points[k][1] ? 0 : (points[k][1] > points[k][0] ? 1 : -1);
        EXPECT_EQ(oracle.orient(0, 1, static_cast<int>(k)), expected);
    }
}

TEST(DoublePoints, orientation_agrees_with_wide_integers) {
    std::mt19937_64 random(13);
    for (int k = 0; k < 20000; ++k) {
        // Nearly collinear points with 60-bit coordinates; their determinant needs 122 bits.
        std::vector<Point> whole(3);
        for (int i = 0; i < 2; ++i) {
            whole[i] = {static_cast<std::int64_t>(random() >> 12),
                        static_cast<std::int64_t>(random() >> 12)};
        }
        const int t = testing::draw(random, 0, 4);
        whole[2] = {
            whole[0][0] + (whole[1][0] - whole[0][0]) / 4 * t + testing::draw(random, -1, 1),
            whole[0][1] + (whole[1][1] - whole[0][1]) / 4 * t + testing::draw(random, -1, 1)};
        std::vector<std::array<double, 2>> points;
        for (const Point& p : whole) {
            points.push_back({std::ldexp(static_cast<double>(p[0]), -300),
                              std::ldexp(static_cast<double>(p[1]), 300)});
        }
        const auto wide = [&](int i, int c) { return static_cast<__int128>(whole[i][c]); };
        const __int128 determinant = (wide(1, 0) - wide(0, 0)) * (wide(2, 1) - wide(0, 1)) -
                                     (wide(1, 1) - wide(0, 1)) * (wide(2, 0) - wide(0, 0));
        const int expected = determinant > 0 ? 1 : (determinant < 0 ? -1 : 0);
        ASSERT_EQ(DoublePoints(points).orient(0, 1, 2), expected) << "case " << k;
    }
}

TEST(DoublePoints, unusable_coordinates_are_named) {
    const double inf = std::numeric_limits<double>::infinity();
    const std::vector<std::array<double, 2>> points{
        {0, 1}, {inf, 0}, {0, std::nan("")}, {1e-300, 0}};
    try {
        const DoublePoints oracle(points);
        FAIL();
    } catch (const InvalidRegion& e) {
        EXPECT_EQ(e.points_at_fault, (std::vector<PointId>{1, 2, 3}));
    }
}

}  // namespace
}  // namespace tetra
