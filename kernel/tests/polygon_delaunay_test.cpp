// SPDX-License-Identifier: LGPL-2.1-or-later
// Flips towards Delaunay: stays a mesh of the same region, ends locally Delaunay where it may.

#include "tetra/polygon/delaunay.h"

#include <gtest/gtest.h>

#include "polygon_support.h"
#include "tetra/polygon/triangulate.h"

namespace tetra {
namespace {

using testing::IntegerPoints;
using testing::Point;
using testing::Polyomino;

ApproximatePoint as_doubles(const IntegerPoints& points) {
    return [&points](PointId id) {
        const Point& p = points.points()[id];
        return std::array<double, 2>{static_cast<double>(p[0]), static_cast<double>(p[1])};
    };
}

/// Inner edges, apart from the fixed ones, whose flip would be legal and is asked for exactly.
int wrong_edges(const std::vector<PlanarTriangle>& triangles,
                const std::vector<DirectedEdge>& fixed, const IntegerPoints& points) {
    std::map<std::pair<int, int>, int> apex;
    for (const PlanarTriangle& t : triangles) {
        for (int k = 0; k < 3; ++k) apex[{t[k], t[(k + 1) % 3]}] = t[(k + 2) % 3];
    }
    std::set<std::pair<int, int>> stays;
    for (const DirectedEdge& e : fixed) stays.insert({e.from, e.to});
    int wrong = 0;
    for (const auto& [side, c] : apex) {
        const auto [a, b] = side;
        const auto other = apex.find({b, a});
        if (other == apex.end() || stays.count(side) != 0) continue;
        const int d = other->second;
        if (points.twice_area({a, d, c}) <= 0 || points.twice_area({d, b, c}) <= 0) continue;
        const auto vector = [&](int from, int to) {
            const Point& p = points.points()[from];
            const Point& q = points.points()[to];
            return Point{q[0] - p[0], q[1] - p[1]};
        };
        const auto cross = [](Point p, Point q) { return p[0] * q[1] - p[1] * q[0]; };
        const auto dot = [](Point p, Point q) { return p[0] * q[0] + p[1] * q[1]; };
        const Point ca = vector(c, a), cb = vector(c, b), da = vector(d, a), db = vector(d, b);
        if (cross(ca, cb) * dot(da, db) + dot(ca, cb) * cross(db, da) < 0) ++wrong;
    }
    return wrong;
}

TEST(Delaunay, flips_the_long_diagonal_of_a_rhomb) {
    const IntegerPoints points({{0, 0}, {5, -1}, {10, 0}, {5, 1}});
    const auto flipped =
        flip_towards_delaunay({{0, 1, 2}, {0, 2, 3}}, {}, points, as_doubles(points));
    EXPECT_EQ(testing::flaw_of(flipped, testing::edges_of({{0, 1, 2, 3}}), points), "");
    EXPECT_EQ(wrong_edges(flipped, {}, points), 0);
}

TEST(Delaunay, leaves_fixed_and_cocircular_edges_alone) {
    const IntegerPoints rhomb({{0, 0}, {5, -1}, {10, 0}, {5, 1}});
    const std::vector<PlanarTriangle> long_way{{0, 1, 2}, {0, 2, 3}};
    const std::vector<DirectedEdge> diagonal{{2, 0}};
    EXPECT_EQ(flip_towards_delaunay(long_way, diagonal, rhomb, as_doubles(rhomb)), long_way);
    const IntegerPoints square({{0, 0}, {3, 0}, {3, 3}, {0, 3}});
    EXPECT_EQ(flip_towards_delaunay(long_way, {}, square, as_doubles(square)), long_way);
}

TEST(Delaunay, senseless_coordinates_do_no_harm) {
    std::mt19937_64 random(5);
    for (int k = 0; k < 200; ++k) {
        const Polyomino p = testing::random_polyomino(random, 8);
        const IntegerPoints points(p.points(testing::integer_map(k)));
        const auto edges = p.boundary();
        const auto raw = triangulate_region(edges, points, p.inner_points());
        const auto nonsense = [&](PointId id) {
            return std::array<double, 2>{static_cast<double>(id * 7919 % 101),
                                         static_cast<double>(id * 104729 % 97)};
        };
        const auto flipped = flip_towards_delaunay(raw, {}, points, nonsense);
        ASSERT_EQ(testing::flaw_of(flipped, edges, points), "") << "case " << k;
        ASSERT_EQ(flipped, flip_towards_delaunay(raw, {}, points, nonsense));
    }
}

TEST(Delaunay, random_polyominoes_become_constrained_delaunay) {
    std::mt19937_64 random(6);
    const int cases = testing::case_count(1000);
    for (int k = 0; k < cases; ++k) {
        const Polyomino p = testing::random_polyomino(random, 9);
        const IntegerPoints points(p.points(testing::integer_map(k)));
        auto edges = p.boundary();
        const auto inner = k % 2 == 0 ? p.inner_points() : std::vector<PointId>{};
        std::vector<DirectedEdge> slits;
        if (inner.size() > 1 && inner[1] == inner[0] + 1) {
            slits = {{inner[0], inner[1]}, {inner[1], inner[0]}};
            edges.insert(edges.end(), slits.begin(), slits.end());
        }
        const auto raw = triangulate_region(edges, points, inner);
        const auto flipped = flip_towards_delaunay(raw, slits, points, as_doubles(points));
        ASSERT_EQ(testing::flaw_of(flipped, edges, points), "") << "case " << k;
        ASSERT_EQ(flipped.size(), raw.size());
        ASSERT_EQ(wrong_edges(flipped, slits, points), 0) << "case " << k;
    }
}

TEST(Delaunay, overlapping_triangles_are_an_error) {
    const IntegerPoints points({{0, 0}, {5, 0}, {0, 5}, {1, 6}});
    EXPECT_THROW(flip_towards_delaunay({{0, 1, 2}, {0, 1, 3}}, {}, points, as_doubles(points)),
                 InvalidRegion);
}

}  // namespace
}  // namespace tetra
