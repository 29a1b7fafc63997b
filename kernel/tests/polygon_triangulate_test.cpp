// SPDX-License-Identifier: LGPL-2.1-or-later
// Triangulation of regions: named shapes, degenerate boundaries, random polyominoes and polygons.

#include "tetra/polygon/triangulate.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>
#include <string>

#include "polygon_support.h"

namespace tetra {
namespace {

using testing::edges_of;
using testing::IntegerPoints;
using testing::Point;
using testing::Polyomino;

using Loops = std::vector<std::vector<PointId>>;

Loops one_loop(std::size_t n) {
    Loops loops(1);
    loops[0].resize(n);
    std::iota(loops[0].begin(), loops[0].end(), 0);
    return loops;
}

/// Triangulates, judges, and returns the number of triangles.
std::size_t count_judged(const std::vector<Point>& points, const std::vector<DirectedEdge>& edges,
                         const std::vector<PointId>& inner = {}) {
    const IntegerPoints oracle(points);
    const auto triangles = triangulate_region(edges, oracle, inner);
    EXPECT_EQ(testing::flaw_of(triangles, edges, oracle), "");
    return triangles.size();
}

std::size_t count_judged(const std::vector<Point>& points) {
    return count_judged(points, edges_of(one_loop(points.size())));
}

TEST(Triangulate, nothing_gives_nothing) { EXPECT_EQ(count_judged({}, {}), 0U); }

TEST(Triangulate, square) { EXPECT_EQ(count_judged({{0, 0}, {4, 0}, {4, 4}, {0, 4}}), 2U); }

TEST(Triangulate, l_shape) {
    EXPECT_EQ(count_judged({{0, 0}, {4, 0}, {4, 2}, {2, 2}, {2, 4}, {0, 4}}), 4U);
}

TEST(Triangulate, comb_towards_each_side) {
    for (int turn = 0; turn < 8; ++turn) {
        const auto m = testing::integer_map(turn);
        std::vector<Point> points;
        const auto add = [&](int x, int y) {
            points.push_back({m[0] * x + m[1] * y, m[2] * x + m[3] * y});
        };
        add(0, 0);
        add(20, 0);
        for (int tooth = 9; tooth >= 0; --tooth) {
            add(2 * tooth + 2, 10);
            add(2 * tooth + 1, 10);
            add(2 * tooth + 1, 1);
            if (tooth > 0) add(2 * tooth, 1);
        }
        add(0, 1);
        EXPECT_EQ(count_judged(points), points.size() - 2);
    }
}

TEST(Triangulate, spiral_with_corridors_of_width_one) {
    // A polyomino snake that winds inwards with walls of width one between the turns.
    Polyomino p{31, 31, std::vector<char>(31 * 31, 0)};
    int x = 0, y = 0, dx = 1, dy = 0;
    p.filled[0] = 1;
    const auto free = [&](int cx, int cy) {
        return cx >= 0 && cy >= 0 && cx < p.width && cy < p.height && !p.at(cx, cy);
    };
    for (int turns = 0; turns < 2;) {
        const bool wall_ahead = p.at(x + 2 * dx, y + 2 * dy);
        if (free(x + dx, y + dy) && !wall_ahead) {
            x += dx;
            y += dy;
            p.filled[y * p.width + x] = 1;
            turns = 0;
        } else {
            const int old = dx;
            dx = -dy;
            dy = old;
            ++turns;
        }
    }
    for (int k = 0; k < 8; ++k) {
        const auto edges = p.boundary();
        EXPECT_EQ(count_judged(p.points(testing::integer_map(k)), edges), edges.size() - 2);
    }
}

TEST(Triangulate, star) {
    const std::vector<Point> points{{0, -10}, {2, -3}, {9, -3}, {4, 1},   {6, 8},
                                    {0, 4},   {-6, 8}, {-4, 1}, {-9, -3}, {-2, -3}};
    EXPECT_EQ(count_judged(points), 8U);
}

TEST(Triangulate, square_with_up_to_25_holes) {
    for (int holes = 0; holes <= 25; ++holes) {
        std::vector<Point> points{{0, 0}, {100, 0}, {100, 100}, {0, 100}};
        Loops loops{{0, 1, 2, 3}};
        for (int h = 0; h < holes; ++h) {
            const int x = 10 + 18 * (h % 5);
            const int y = 10 + 18 * (h / 5);
            const int first = static_cast<int>(points.size());
            points.insert(points.end(), {{x, y}, {x, y + 8}, {x + 8, y + 8}, {x + 8, y}});
            loops.push_back({first, first + 1, first + 2, first + 3});
        }
        const std::size_t expected = points.size() + 2 * holes - 2;
        EXPECT_EQ(count_judged(points, edges_of(loops)), expected);
    }
}

TEST(Triangulate, hole_touches_outer_boundary_in_a_vertex) {
    // The hole and the outer boundary become one cycle: as many triangles as edges, less two.
    const std::vector<Point> points{{0, 0}, {8, 0}, {8, 8}, {0, 8}, {3, 2}, {2, 3}};
    const auto edges = edges_of({{0, 1, 2, 3}, {0, 5, 4}});
    EXPECT_EQ(count_judged(points, edges), 5U);
}

TEST(Triangulate, two_holes_touch_in_a_vertex) {
    const std::vector<Point> points{{0, 0}, {9, 0}, {9, 9}, {0, 9}, {4, 4},
                                    {2, 5}, {2, 3}, {6, 3}, {6, 5}};
    const auto edges = edges_of({{0, 1, 2, 3}, {4, 6, 5}, {4, 8, 7}});
    EXPECT_EQ(count_judged(points, edges), edges.size() - 2 + 2);
}

TEST(Triangulate, pieces_that_touch_in_one_vertex_from_many_sides) {
    std::vector<Point> points{{0, 0}};
    Loops loops;
    const std::vector<Point> ring{{6, 0},  {6, 2},   {4, 4},   {1, 6},   {-1, 6}, {-4, 4}, {-6, 2},
                                  {-6, 0}, {-6, -2}, {-4, -4}, {-1, -6}, {1, -6}, {4, -4}, {6, -2}};
    for (std::size_t k = 0; k < ring.size(); k += 2) {
        const int first = static_cast<int>(points.size());
        points.push_back(ring[k]);
        points.push_back(ring[k + 1]);
        loops.push_back({0, first, first + 1});
    }
    EXPECT_EQ(count_judged(points, edges_of(loops)), 7U);
}

TEST(Triangulate, collinear_points_on_all_sides) {
    for (int per_side = 1; per_side <= 12; ++per_side) {
        for (int k = 0; k < 8; ++k) {
            Polyomino p{per_side, per_side, std::vector<char>(per_side * per_side, 1)};
            const auto edges = p.boundary();
            EXPECT_EQ(count_judged(p.points(testing::integer_map(k)), edges), edges.size() - 2);
        }
    }
}

TEST(Triangulate, triangle_with_one_straight_side_of_many_points) {
    for (int k = 0; k < 8; ++k) {
        for (int apex = -3; apex <= 12; ++apex) {
            const auto m = testing::integer_map(k);
            std::vector<Point> points;
            for (int x = 0; x <= 9; ++x) points.push_back({m[0] * x, m[2] * x});
            points.push_back({m[0] * apex + m[1] * 2, m[2] * apex + m[3] * 2});
            EXPECT_EQ(count_judged(points), 9U);
        }
    }
}

TEST(Triangulate, slits_have_the_region_on_both_sides) {
    std::vector<Point> points{{0, 0}, {9, 0}, {9, 9}, {0, 9}, {3, 3}, {6, 3}, {6, 6}, {5, 8}};
    auto edges = edges_of({{0, 1, 2, 3}});
    // A bent slit that floats, then one that hangs on a corner.
    const auto add_slit = [&](int a, int b) {
        edges.push_back({a, b});
        edges.push_back({b, a});
    };
    add_slit(4, 5);
    add_slit(5, 6);
    EXPECT_EQ(count_judged(points, edges), edges.size() - 2 + 2);
    add_slit(3, 7);
    EXPECT_EQ(count_judged(points, edges), edges.size() - 2 + 2);
    add_slit(7, 6);
    EXPECT_EQ(count_judged(points, edges), edges.size() - 2);
}

TEST(Triangulate, inner_points_become_vertices) {
    for (int size = 2; size <= 9; ++size) {
        for (int k = 0; k < 8; ++k) {
            const Polyomino p{size, size, std::vector<char>(size * size, 1)};
            const std::size_t n =
                count_judged(p.points(testing::integer_map(k)), p.boundary(), p.inner_points());
            EXPECT_EQ(n, 2U * size * size);  // all grid points are vertices: unimodular triangles
        }
    }
}

TEST(Triangulate, inner_points_may_come_twice_or_be_on_the_boundary_already) {
    const std::vector<Point> points{{0, 0}, {4, 0}, {4, 4}, {0, 4}, {1, 1}};
    EXPECT_EQ(count_judged(points, edges_of({{0, 1, 2, 3}}), {4, 2, 4}), 4U);
}

TEST(Triangulate, ids_may_be_sparse_and_in_any_order) {
    std::vector<Point> points(1001);
    points[7] = {0, 0};
    points[1000] = {4, 0};
    points[0] = {4, 4};
    points[512] = {0, 4};
    EXPECT_EQ(count_judged(points, {{0, 512}, {7, 1000}, {512, 7}, {1000, 0}}), 2U);
}

class Bad : public ::testing::Test {
  protected:
    static InvalidRegion failure(const std::vector<Point>& points,
                                 const std::vector<DirectedEdge>& edges,
                                 const std::vector<PointId>& inner = {}) {
        try {
            triangulate_region(edges, IntegerPoints(points), inner);
        } catch (const InvalidRegion& e) {
            return e;
        }
        return {"no error", {}, {}};
    }
    const std::vector<Point> square{{0, 0}, {4, 0}, {4, 4}, {0, 4}, {2, 2}, {2, 0}, {5, 1}};
    const std::vector<DirectedEdge> around{{0, 1}, {1, 2}, {2, 3}, {3, 0}};
};

TEST_F(Bad, open_boundary) {
    EXPECT_EQ(failure(square, {{0, 1}, {1, 2}, {2, 3}}).points_at_fault, std::vector<PointId>{0});
}

TEST_F(Bad, clockwise_boundary) {
    const auto e = failure(square, {{1, 0}, {2, 1}, {3, 2}, {0, 3}});
    EXPECT_EQ(e.points_at_fault, std::vector<PointId>{0});
    EXPECT_EQ(e.edges_at_fault, (std::vector<int>{0, 3}));
}

TEST_F(Bad, edge_given_twice) {
    auto edges = around;
    edges.push_back({0, 1});
    EXPECT_EQ(failure(square, edges).edges_at_fault, (std::vector<int>{0, 4}));
}

TEST_F(Bad, edge_without_length) {
    auto edges = around;
    edges.push_back({2, 2});
    EXPECT_EQ(failure(square, edges).edges_at_fault, std::vector<int>{4});
}

TEST_F(Bad, coinciding_points) {
    auto points = square;
    points[3] = points[2];
    EXPECT_EQ(failure(points, around).points_at_fault.size(), 2U);
}

TEST_F(Bad, inner_point_on_edge_and_outside) {
    EXPECT_EQ(failure(square, around, {5}).edges_at_fault, std::vector<int>{0});
    EXPECT_EQ(failure(square, around, {6}).points_at_fault, std::vector<PointId>{6});
}

TEST_F(Bad, crossing_boundary) {
    EXPECT_NE(std::string(failure(square, {{0, 2}, {2, 1}, {1, 3}, {3, 0}}).what()), "no error");
}

TEST(Triangulate, calls_of_the_oracle_stay_within_n_log_n) {
    std::mt19937_64 random(3);
    Polyomino p{220, 220, {}};
    for (int k = 0; k < p.width * p.height; ++k) {
        p.filled.push_back(testing::draw(random, 0, 99) < 55 ? 1 : 0);
    }
    const IntegerPoints oracle(p.points({3, 1, -2, 5}));
    const auto edges = p.boundary();
    const auto triangles = triangulate_region(edges, oracle);
    EXPECT_EQ(testing::flaw_of(triangles, edges, oracle), "");
    const double n = static_cast<double>(edges.size());
    EXPECT_LT(static_cast<double>(oracle.compare_calls), 1.5 * n * std::log2(n));
    EXPECT_LT(static_cast<double>(oracle.orient_calls), 1.0 * n * std::log2(n));
    RecordProperty("edges", std::to_string(edges.size()));
    RecordProperty("compare", std::to_string(oracle.compare_calls));
    RecordProperty("orient", std::to_string(oracle.orient_calls));
}

}  // namespace
}  // namespace tetra
