// SPDX-License-Identifier: LGPL-2.1-or-later
// Convex hulls by exact decisions on degenerate points, and cells merged within limits.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "../src/assemble/convex_hull.h"
#include "../src/assemble/hull_planes.h"
#include "../src/assemble/part_distance.h"
#include "tetra/assemble/double_predicates.h"
#include "tetra/assemble/limit_cells.h"

namespace tetra {
namespace {

std::size_t at(int i) { return static_cast<std::size_t>(i); }

double noise(std::uint64_t& state) {
    state = state * 6364136223846793005u + 1442695040888963407u;
    return static_cast<double>(state >> 11) * 0x1p-53 - 0.5;
}

// Closed, of the sphere's type, and no point strictly beyond any facet.
void expect_hull(const std::vector<Vec3d>& points, const std::vector<Triangle>& hull) {
    std::map<std::array<int, 2>, int> edges;
    std::set<int> corners;
    for (const Triangle& t : hull)
        for (std::size_t e = 0; e < 3; ++e) {
            corners.insert(t[e]);
            EXPECT_EQ((++edges[{t[e], t[(e + 1) % 3]}]), 1);
        }
    for (const auto& [edge, count] : edges) EXPECT_EQ(edges.count({edge[1], edge[0]}), 1u);
    EXPECT_EQ(corners.size() + hull.size(), edges.size() / 2 + 2);
    for (const Triangle& t : hull)
        for (const Vec3d& p : points)
            EXPECT_LE(orient3d(points[at(t[0])], points[at(t[1])], points[at(t[2])], p), 0);
}

TEST(ConvexHull, OfAGridIsTheCube) {
    std::vector<Vec3d> points;
    for (int x = 0; x < 4; ++x)
        for (int y = 0; y < 4; ++y)
            for (int z = 0; z < 4; ++z) points.push_back({x / 3.0, y / 3.0, z / 3.0});
    const std::vector<Triangle> hull = convex_hull(points);
    expect_hull(points, hull);
    EXPECT_DOUBLE_EQ(volume6(points, hull), 6);
}

TEST(ConvexHull, OfGeneralRepeatedAndTurnedPoints) {
    std::uint64_t state = 7;
    for (int round = 0; round < 200; ++round) {
        std::vector<Vec3d> points;
        const int count = 4 + round % 60;
        // Few values per coordinate: many equal, collinear and coplanar points.
        const double steps = round % 3 == 0 ? 1e9 : 2 + round % 5;
        for (int i = 0; i < count; ++i) {
            Vec3d p;
            for (double& x : p) x = std::round(noise(state) * steps) / 3;
            if (round % 2 == 1) p = {0.6 * p[0] - 0.8 * p[1], 0.8 * p[0] + 0.6 * p[1], p[2]};
            points.push_back(p);
        }
        const std::vector<Triangle> hull = convex_hull(points);
        if (hull.empty()) {
            for (int i = 3; i < count; ++i)
                EXPECT_EQ(orient3d(points[0], points[1], points[2], points[at(i)]), 0);
            continue;
        }
        expect_hull(points, hull);
        EXPECT_GT(volume6(points, hull), 0);
    }
}

TEST(ConvexHull, OfFlatOrFewPointsIsEmpty) {
    EXPECT_TRUE(convex_hull(std::vector<Vec3d>{}).empty());
    EXPECT_TRUE(convex_hull(std::vector<Vec3d>(9, {1, 2, 3})).empty());
    EXPECT_TRUE(
        convex_hull(std::vector<Vec3d>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}}).empty());
}

std::vector<Vec3d> ring_prism(int sides) {
    std::vector<Vec3d> points;
    for (int i = 0; i < sides; ++i)
        for (const double z : {0.0, 1.0})
            points.push_back({std::cos(2 * M_PI * i / sides), std::sin(2 * M_PI * i / sides), z});
    return points;
}

TEST(EnclosedByFewer, KeepsAllPointsInsideAndTheLimit) {
    const std::vector<Vec3d> points = ring_prism(100);
    const std::vector<Triangle> hull = convex_hull(points);
    for (const int most : {8, 24, 60}) {
        const Polytope few = enclosed_by_fewer(points, hull, most);
        EXPECT_LE(few.points.size(), at(most));
        expect_hull(few.points, few.triangles);
        for (const HalfSpace& half : half_spaces(few.points, few.triangles))
            for (const Vec3d& p : points) EXPECT_LT(beyond(half, p), 1e-12);
        // The best prism of most / 2 sides around the unit circle; the greedy choice stays
        // within 2.5 times.
        double reach = 0;
        for (const Vec3d& p : few.points) reach = std::max(reach, std::hypot(p[0], p[1]));
        EXPECT_LT(reach - 1, 2.5 * (1 / std::cos(2 * M_PI / most) - 1) + 1e-9);
    }
}

// Unit cubes at given places in a row of cubes, faces between neighbours inside the part.
CellArrays cubes(const std::vector<int>& places, std::vector<int> solids) {
    CellArrays part;
    part.facet_offsets = {0};
    part.cell_offsets = {0};
    part.cell_solid = std::move(solids);
    const std::set<int> filled(places.begin(), places.end());
    std::map<Vec3d, int> ids;
    const auto id = [&](const Vec3d& p) {
        const auto [place, is_new] = ids.insert({p, static_cast<int>(part.points.size())});
        if (is_new) part.points.push_back(p);
        return place->second;
    };
    const int loops[6][4] = {{0, 1, 3, 2}, {4, 6, 7, 5}, {0, 4, 5, 1},
                             {2, 3, 7, 6}, {0, 2, 6, 4}, {1, 5, 7, 3}};
    for (const int x : places) {
        for (int f = 0; f < 6; ++f) {
            for (const int corner : loops[f])
                part.facet_vertices.push_back(
                    id({x + (corner >> 2 & 1) * 1.0, (corner >> 1 & 1) * 1.0, (corner & 1) * 1.0}));
            part.facet_offsets.push_back(static_cast<std::int64_t>(part.facet_vertices.size()));
            const bool inside =
                (f == 0 && filled.contains(x - 1)) || (f == 1 && filled.contains(x + 1));
            part.facet_source.push_back(inside ? -1 : f);
        }
        part.cell_offsets.push_back(static_cast<std::int64_t>(part.facet_source.size()));
    }
    return part;
}

TEST(LimitCells, JoinsWhatIsFlushBeforeWhatIsNot) {
    Progress progress;
    const CellArrays part = cubes({0, 1, 5, 6}, {0, 0, 0, 0});
    const LimitedCells two = limit_cells(part, {2, 0}, progress);
    ASSERT_EQ(two.pieces.size(), 2u);
    EXPECT_EQ(two.pieces[0].cells, (std::vector<int>{0, 1}));
    EXPECT_EQ(two.pieces[1].cells, (std::vector<int>{2, 3}));
    EXPECT_EQ(two.error_found, 0);
    EXPECT_LT(two.error, 1e-8);
    EXPECT_NEAR(two.volume_added, 0, 1e-12);
    // The gap is 3 wide: its middle, on the hull's side, is 1.5 from both cubes.
    const LimitedCells one = limit_cells(part, {1, 0}, progress);
    ASSERT_EQ(one.pieces.size(), 1u);
    EXPECT_GT(one.error_found, 1.45);
    EXPECT_LE(one.error_found, 1.5);
    EXPECT_GE(one.error, 1.5);
    EXPECT_LE(one.error, 1.05 * 1.5);
    EXPECT_NEAR(one.volume_added, 3, 1e-12);
}

TEST(LimitCells, LeavesAloneWhatKeepsTheLimitsAndKeepsSolidsApart) {
    Progress progress;
    const CellArrays part = cubes({0, 1, 2}, {0, 0, 1});
    const LimitedCells same = limit_cells(part, {3, 8}, progress);
    for (const LimitedPiece& piece : same.pieces) EXPECT_TRUE(piece.triangles.empty());
    EXPECT_EQ(same.error, 0);
    const LimitedCells two = limit_cells(part, {2, 0}, progress);
    ASSERT_EQ(two.pieces.size(), 2u);
    EXPECT_EQ(two.pieces[0].cells, (std::vector<int>{0, 1}));
    EXPECT_TRUE(two.pieces[1].triangles.empty());
}

TEST(PartDistance, IsZeroInsideAndEuclideanOutside) {
    const CellArrays part = cubes({0, 1}, {0, 0});
    const PartDistance distance(part);
    EXPECT_EQ(distance({1, 0.5, 0.5}), 0);
    EXPECT_EQ(distance({0, 0, 0}), 0);
    EXPECT_DOUBLE_EQ(distance({5, 0.5, 0.5}), 3);
    EXPECT_DOUBLE_EQ(distance({-3, -4, 0.5}), 5);
    EXPECT_NEAR(distance({3, 2, 2}), std::sqrt(3), 1e-15);
    EXPECT_TRUE(distance.in_one_cell({{{0, 0, 0}, {1, 0, 0}, {1, 1, 1}}}));
    EXPECT_FALSE(distance.in_one_cell({{{0, 0, 0}, {2, 0, 0}, {2, 1, 1}}}));
}

}  // namespace
}  // namespace tetra
