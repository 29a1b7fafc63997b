// SPDX-License-Identifier: LGPL-2.1-or-later
// Triangulation of random regions: polyominoes, stars and monotone polygons on small grids.

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "polygon_support.h"
#include "tetra/polygon/triangulate.h"

namespace tetra {
namespace {

using testing::case_count;
using testing::draw;
using testing::IntegerPoints;
using testing::Point;
using testing::Polyomino;

TEST(TriangulateRandom, polyominoes) {
    std::mt19937_64 random(20260101);
    const int cases = case_count(5000);
    for (int k = 0; k < cases; ++k) {
        const Polyomino p = testing::random_polyomino(random, 9);
        const IntegerPoints oracle(p.points(testing::integer_map(k)));
        const auto edges = p.boundary();
        const auto triangles = triangulate_region(edges, oracle);
        ASSERT_EQ(testing::flaw_of(triangles, edges, oracle), "") << "case " << k;
        ASSERT_EQ(static_cast<int>(triangles.size()),
                  static_cast<int>(edges.size()) - 2 * p.euler())
            << "case " << k;
        const auto inner = p.inner_points();
        std::vector<PointId> some;
        for (const PointId id : inner) {
            if (draw(random, 0, 2) == 0) some.push_back(id);
        }
        const auto with_inner = triangulate_region(edges, oracle, some);
        ASSERT_EQ(testing::flaw_of(with_inner, edges, oracle), "") << "case " << k;
        ASSERT_EQ(with_inner.size(), triangles.size() + 2 * some.size()) << "case " << k;
    }
}

/// Inner grid edges drawn at random, in both directions.
std::vector<DirectedEdge> random_slits(std::mt19937_64& random, const Polyomino& p) {
    std::vector<DirectedEdge> slits;
    const auto add = [&](int a, int b) {
        if (draw(random, 0, 3) == 0) slits.insert(slits.end(), {{a, b}, {b, a}});
    };
    for (int y = 0; y < p.height; ++y) {
        for (int x = 0; x < p.width; ++x) {
            if (p.at(x, y) && p.at(x + 1, y)) add(p.id(x + 1, y), p.id(x + 1, y + 1));
            if (p.at(x, y) && p.at(x, y + 1)) add(p.id(x, y + 1), p.id(x + 1, y + 1));
        }
    }
    return slits;
}

TEST(TriangulateRandom, slits_and_inner_points_in_polyominoes) {
    std::mt19937_64 random(20260102);
    const int cases = case_count(2000);
    for (int k = 0; k < cases; ++k) {
        const Polyomino p = testing::random_polyomino(random, 9);
        const auto map = testing::integer_map(k);
        const IntegerPoints oracle(p.points(map));
        auto edges = p.boundary();
        const auto slits = random_slits(random, p);
        edges.insert(edges.end(), slits.begin(), slits.end());
        const auto triangles = triangulate_region(edges, oracle, p.inner_points());
        ASSERT_EQ(testing::flaw_of(triangles, edges, oracle), "") << "case " << k;
        // All grid points are vertices, so every triangle is half an image of a cell.
        const int determinant = map[0] * map[3] - map[1] * map[2];
        for (const PlanarTriangle& t : triangles) ASSERT_EQ(oracle.twice_area(t), determinant);
        const auto without = triangulate_region(edges, oracle);
        ASSERT_EQ(testing::flaw_of(without, edges, oracle), "") << "case " << k;
    }
}

TEST(TriangulateRandom, order_of_edges_and_ids_does_not_matter) {
    std::mt19937_64 random(20260103);
    for (int k = 0; k < 500; ++k) {
        const Polyomino p = testing::random_polyomino(random, 8);
        const auto positions = p.points(testing::integer_map(k));
        auto edges = p.boundary();
        auto inner = p.inner_points();
        const auto expected = triangulate_region(edges, IntegerPoints(positions), inner);

        std::vector<int> renamed(positions.size());
        std::iota(renamed.begin(), renamed.end(), 0);
        std::shuffle(renamed.begin(), renamed.end(), random);
        std::vector<Point> moved(positions.size());
        for (std::size_t i = 0; i < positions.size(); ++i) moved[renamed[i]] = positions[i];
        std::shuffle(edges.begin(), edges.end(), random);
        for (DirectedEdge& e : edges) e = {renamed[e.from], renamed[e.to]};
        for (PointId& id : inner) id = renamed[id];
        auto renamed_expected = expected;
        for (PlanarTriangle& t : renamed_expected) {
            for (PointId& id : t) id = renamed[id];
        }
        ASSERT_EQ(triangulate_region(edges, IntegerPoints(moved), inner), renamed_expected);
    }
}

/// Points of a small grid sorted by angle around the origin: star-shaped, many equal x.
std::vector<Point> random_star(std::mt19937_64& random, int n, int size) {
    std::map<double, Point> by_angle;
    for (int k = 0; k < n; ++k) {
        const std::int64_t x = draw(random, -size, size);
        const std::int64_t y = draw(random, -size, size);
        const std::int64_t g = std::gcd(x, y);
        if (g == 0) continue;
        by_angle[std::atan2(static_cast<double>(y / g), static_cast<double>(x / g))] = {x, y};
    }
    std::vector<Point> points;
    for (const auto& [angle, point] : by_angle) points.push_back(point);
    return points;
}

/// Triangulates the polygon of the points in their order.
void expect_triangulated(const std::vector<Point>& points) {
    const IntegerPoints oracle(points);
    std::vector<DirectedEdge> edges;
    for (int k = 0; k < static_cast<int>(points.size()); ++k) {
        edges.push_back({k, (k + 1) % static_cast<int>(points.size())});
    }
    const auto triangles = triangulate_region(edges, oracle);
    ASSERT_EQ(testing::flaw_of(triangles, edges, oracle), "");
    ASSERT_EQ(triangles.size(), points.size() - 2);
}

TEST(TriangulateRandom, star_polygons_on_small_grids) {
    std::mt19937_64 random(7);
    const int cases = case_count(1000);
    int used = 0;
    for (int k = 0; k < cases; ++k) {
        const auto points = random_star(random, draw(random, 8, 60), 6);
        const IntegerPoints oracle(points);
        bool around = points.size() > 3;  // the origin must be in the kernel of the star
        for (std::size_t i = 0; i < points.size(); ++i) {
            const Point& p = points[i];
            const Point& q = points[(i + 1) % points.size()];
            around = around && p[0] * q[1] - p[1] * q[0] > 0;
        }
        if (!around) continue;
        ++used;
        expect_triangulated(points);
    }
    EXPECT_GT(used, cases / 4);
}

TEST(TriangulateRandom, monotone_polygons_on_small_grids) {
    std::mt19937_64 random(11);
    const int cases = case_count(1000);
    for (int k = 0; k < cases; ++k) {
        const int width = draw(random, 1, 14);
        std::vector<Point> points{{0, 0}};
        std::vector<Point> upper;
        for (int x = 1; x < width; ++x) {
            if (draw(random, 0, 1) == 0) points.push_back({x, -draw(random, 1, 3)});
            if (draw(random, 0, 1) == 0) upper.push_back({x, draw(random, 1, 3)});
        }
        points.push_back({width, -draw(random, 0, 1)});
        points.push_back({width, 2});
        points.insert(points.end(), upper.rbegin(), upper.rend());
        const auto m = testing::integer_map(k);
        for (Point& p : points) p = {m[0] * p[0] + m[1] * p[1], m[2] * p[0] + m[3] * p[1]};
        expect_triangulated(points);
    }
}

}  // namespace
}  // namespace tetra
