// SPDX-License-Identifier: LGPL-2.1-or-later
// Guards: every triangle has one, and the art-gallery bounds hold.

#include "tetra/polygon/guards.h"

#include <gtest/gtest.h>

#include "polygon_support.h"
#include "tetra/polygon/triangulate.h"

namespace tetra {
namespace {

using testing::IntegerPoints;
using testing::Point;
using testing::Polyomino;

bool all_seen(const std::vector<PlanarTriangle>& triangles, const std::vector<PointId>& guards) {
    return std::all_of(triangles.begin(), triangles.end(), [&](const PlanarTriangle& t) {
        return std::any_of(t.begin(), t.end(), [&](PointId id) {
            return std::find(guards.begin(), guards.end(), id) != guards.end();
        });
    });
}

std::size_t guards_of(const std::vector<Point>& positions,
                      const std::vector<std::vector<PointId>>& loops) {
    const IntegerPoints points(positions);
    const auto triangles = triangulate_region(testing::edges_of(loops), points);
    const auto guards = place_guards(triangles);
    EXPECT_TRUE(all_seen(triangles, guards));
    return guards.size();
}

TEST(Guards, nothing_needs_none) { EXPECT_TRUE(place_guards({}).empty()); }

TEST(Guards, one_for_a_triangle_and_for_a_square) {
    EXPECT_EQ(guards_of({{0, 0}, {4, 0}, {0, 4}}, {{0, 1, 2}}), 1U);
    EXPECT_EQ(guards_of({{0, 0}, {4, 0}, {4, 4}, {0, 4}}, {{0, 1, 2, 3}}), 1U);
}

TEST(Guards, chvatals_comb_needs_a_third_of_its_vertices) {
    for (int teeth = 1; teeth <= 20; ++teeth) {
        // Pointed teeth, whose tips no two can be seen from one place.
        std::vector<Point> points{{0, 0}, {30 * teeth - 20, 0}};
        for (int tooth = teeth - 1; tooth >= 0; --tooth) {
            const int x = 30 * tooth;
            if (tooth < teeth - 1) points.push_back({x + 10, 10});
            points.push_back({x + 5, 400});
            if (tooth > 0) points.push_back({x, 10});
        }
        std::vector<PointId> loop;
        for (std::size_t k = 0; k < points.size(); ++k) loop.push_back(static_cast<int>(k));
        ASSERT_EQ(points.size(), 3U * teeth);
        EXPECT_EQ(guards_of(points, {loop}), static_cast<std::size_t>(teeth));
    }
}

TEST(Guards, three_colours_of_a_simple_polygon_are_a_colouring_of_its_vertices) {
    const Polyomino p{7, 5, std::vector<char>(35, 1)};
    const IntegerPoints points(p.points());
    const auto triangles = triangulate_region(p.boundary(), points);
    const auto colours = three_colouring(triangles);
    std::map<PointId, int> colour_of;
    for (std::size_t t = 0; t < triangles.size(); ++t) {
        EXPECT_EQ(colours[t][0] + colours[t][1] + colours[t][2], 3);
        EXPECT_NE(colours[t][0], colours[t][1]);
        for (int k = 0; k < 3; ++k) {
            const auto [entry, fresh] = colour_of.insert({triangles[t][k], colours[t][k]});
            EXPECT_EQ(entry->second, colours[t][k]);
        }
    }
}

TEST(Guards, random_polyominoes_with_holes_and_pinches) {
    std::mt19937_64 random(9);
    const int cases = testing::case_count(2000);
    for (int k = 0; k < cases; ++k) {
        const Polyomino p = testing::random_polyomino(random, 9);
        const IntegerPoints points(p.points(testing::integer_map(k)));
        const auto edges = p.boundary();
        const auto triangles = triangulate_region(edges, points);
        const auto guards = place_guards(triangles);
        ASSERT_TRUE(all_seen(triangles, guards)) << "case " << k;
        ASSERT_TRUE(std::is_sorted(guards.begin(), guards.end()));
        // Over all c components floors of (n + 2h) / 3, and sums of floors are below the floor.
        const int components = testing::components_of(triangles);
        const int holes = components - p.euler();
        ASSERT_LE(3 * guards.size(), edges.size() + 2 * holes) << "case " << k;
    }
}

TEST(Guards, square_with_holes_stays_within_its_bound) {
    for (int holes = 0; holes <= 25; ++holes) {
        std::vector<Point> points{{0, 0}, {100, 0}, {100, 100}, {0, 100}};
        std::vector<std::vector<PointId>> loops{{0, 1, 2, 3}};
        for (int h = 0; h < holes; ++h) {
            const int x = 10 + 18 * (h % 5);
            const int y = 10 + 18 * (h / 5);
            const int first = static_cast<int>(points.size());
            points.insert(points.end(), {{x, y}, {x, y + 8}, {x + 8, y + 8}, {x + 8, y}});
            loops.push_back({first, first + 1, first + 2, first + 3});
        }
        EXPECT_LE(guards_of(points, loops), (points.size() + 2 * holes) / 3);
    }
}

}  // namespace
}  // namespace tetra
