// SPDX-License-Identifier: LGPL-2.1-or-later
// Convex partition: weakly convex polygons, same vertices, same area, within four times optimal.

#include "tetra/polygon/convex_partition.h"

#include <gtest/gtest.h>

#include "polygon_support.h"
#include "tetra/polygon/triangulate.h"

namespace tetra {
namespace {

using testing::IntegerPoints;
using testing::Polyomino;
using Polygons = std::vector<std::vector<PointId>>;

/// The first thing wrong with a partition of the region, or nothing.
std::string flaw_of_partition(const Polygons& polygons, const std::vector<DirectedEdge>& boundary,
                              const IntegerPoints& points) {
    std::set<std::pair<int, int>> sides;
    std::int64_t area = 0;
    for (const auto& polygon : polygons) {
        std::int64_t own = 0;
        for (std::size_t k = 0; k < polygon.size(); ++k) {
            const int a = polygon[k];
            const int b = polygon[(k + 1) % polygon.size()];
            const int c = polygon[(k + 2) % polygon.size()];
            if (points.twice_area({a, b, c}) < 0) return "reflex angle";
            if (!sides.insert({a, b}).second) return "a side occurs twice";
            own += points.twice_area({polygon[0], a, b});
        }
        if (own <= 0) return "flat polygon";
        area += own;
    }
    if (area != points.twice_area(boundary)) return "wrong area";
    std::set<std::pair<int, int>> outer;
    for (const DirectedEdge& e : boundary) outer.insert({e.from, e.to});
    for (const auto& side : outer) {
        if (sides.count(side) == 0) return "boundary edge missing";
    }
    for (const auto& side : sides) {
        if (outer.count(side) == 0 && sides.count({side.second, side.first}) == 0) {
            return "open inner side";
        }
    }
    return {};
}

std::size_t pieces_of(const std::vector<testing::Point>& positions,
                      const std::vector<DirectedEdge>& edges) {
    const IntegerPoints points(positions);
    const auto polygons = convex_partition(triangulate_region(edges, points), {}, points);
    EXPECT_EQ(flaw_of_partition(polygons, edges, points), "");
    return polygons.size();
}

TEST(ConvexPartition, named_shapes) {
    EXPECT_EQ(pieces_of({{0, 0}, {4, 0}, {4, 4}, {0, 4}}, testing::edges_of({{0, 1, 2, 3}})), 1U);
    EXPECT_EQ(pieces_of({{0, 0}, {4, 0}, {4, 2}, {2, 2}, {2, 4}, {0, 4}},
                        testing::edges_of({{0, 1, 2, 3, 4, 5}})),
              2U);
    const std::vector<testing::Point> frame{{0, 0}, {9, 0}, {9, 9}, {0, 9},
                                            {3, 3}, {3, 6}, {6, 6}, {6, 3}};
    EXPECT_LE(pieces_of(frame, testing::edges_of({{0, 1, 2, 3}, {4, 5, 6, 7}})), 6U);
}

TEST(ConvexPartition, a_straight_angle_stays_a_vertex) {
    for (int size = 1; size <= 8; ++size) {
        const Polyomino p{size, size, std::vector<char>(size * size, 1)};
        EXPECT_EQ(pieces_of(p.points(testing::integer_map(size)), p.boundary()), 1U);
    }
}

TEST(ConvexPartition, slits_stay) {
    const IntegerPoints points({{0, 0}, {4, 0}, {4, 4}, {0, 4}, {2, 0}, {2, 4}});
    auto edges = testing::edges_of({{0, 4, 1, 2, 5, 3}});
    const std::vector<DirectedEdge> slit{{4, 5}, {5, 4}};
    edges.insert(edges.end(), slit.begin(), slit.end());
    EXPECT_EQ(convex_partition(triangulate_region(edges, points), slit, points).size(), 2U);
}

/// Corners with more than a straight angle of the region, per component bound of the optimum.
int reflex_corners(const Polyomino& p) {
    int count = 0;
    for (int y = 0; y <= p.height; ++y) {
        for (int x = 0; x <= p.width; ++x) {
            const int around = p.at(x, y) + p.at(x - 1, y) + p.at(x, y - 1) + p.at(x - 1, y - 1);
            if (around == 3) ++count;
        }
    }
    return count;
}

TEST(ConvexPartition, random_polyominoes) {
    std::mt19937_64 random(8);
    const int cases = testing::case_count(2000);
    for (int k = 0; k < cases; ++k) {
        const Polyomino p = testing::random_polyomino(random, 9);
        const IntegerPoints points(p.points(testing::integer_map(k)));
        const auto edges = p.boundary();
        const auto inner = k % 3 == 0 ? p.inner_points() : std::vector<PointId>{};
        const auto triangles = triangulate_region(edges, points, inner);
        const auto polygons = convex_partition(triangles, {}, points);
        ASSERT_EQ(flaw_of_partition(polygons, edges, points), "") << "case " << k;
        std::set<PointId> before;
        std::set<PointId> after;
        for (const auto& t : triangles) before.insert(t.begin(), t.end());
        for (const auto& polygon : polygons) after.insert(polygon.begin(), polygon.end());
        ASSERT_EQ(before, after) << "case " << k;
        if (inner.empty()) {
            // At most two needed diagonals at a reflex corner, which is Hertel and Mehlhorn's
            // bound.
            const int most = 2 * reflex_corners(p) + testing::components_of(triangles);
            ASSERT_LE(static_cast<int>(polygons.size()), most) << "case " << k;
        }
    }
}

}  // namespace
}  // namespace tetra
