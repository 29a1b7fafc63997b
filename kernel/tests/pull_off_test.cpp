// SPDX-License-Identifier: LGPL-2.1-or-later
// Pull-off: convex solids vanish whole, the paper's bounds hold, volumes are exact.
#include <gtest/gtest.h>

#include <algorithm>

#include "pull_off_support.h"

namespace tetra::testing {
namespace {

void expect_consumed(const TestSolid& solid, int cap = 25) {
    PullOptions options;
    options.degree_cap = cap;
    const PullOff result = pull(solid, options);
    expect_sound(solid, result);
    EXPECT_TRUE(result.triangles.empty()) << result.triangles.size();
    EXPECT_LE(cup_tets(result), 3 * static_cast<int>(solid.points.size()));
}

TEST(PullOff, ConvexSolidsVanishWhole) {
    expect_consumed(cube());
    expect_consumed(octahedron());
    expect_consumed(prism(12, 1000, 700));
    expect_consumed(prism(100, 500000, 300000));
    expect_consumed(moment_curve_hull(40));
    for (const int cap : {6, 11, 25}) expect_consumed(moment_curve_hull(20), cap);
    for (const int cells : {2, 3, 5}) expect_consumed(gridded_cube(cells, 7));
}

TEST(PullOff, RandomHullsVanishWhole) {
    for (const int count : {20, 50, 100, 200, 300})
        for (const int cap : {6, 11, 25}) {
            SCOPED_TRACE(count);
            expect_consumed(hull_of(random_sphere_points(7, count, 500000)), cap);
        }
    for (std::uint64_t seed = 0; seed < 40; ++seed) expect_consumed(random_convex_solid(seed, 30));
}

TEST(PullOff, FigureOfThePrototypeForAHull) {
    // PULLOFF "Order and degree cap": 508 tetrahedra for a random hull of 200 points.
    const TestSolid solid = hull_of(random_sphere_points(1, 200, 500000));
    const PullOff result = pull(solid);
    EXPECT_GE(cup_tets(result), 450);
    EXPECT_LE(cup_tets(result), 560);
    EXPECT_EQ(cup_tets(pull(moment_curve_hull(40))), 37);
}

TEST(PullOff, SphereSnappedToTheGridVanishes) {
    for (const int n : {12, 24, 48}) {
        const TestSolid solid = uv_sphere(n, n / 2, 500000);
        const PullOff result = pull(solid);
        expect_sound(solid, result);
        EXPECT_TRUE(result.triangles.empty());
        EXPECT_LE(cup_tets(result), 3 * static_cast<int>(solid.points.size()));
    }
}

TEST(PullOff, SchoenhardtStays) {
    const TestSolid solid = schoenhardt();
    const PullOff result = pull(solid);
    EXPECT_EQ(result.statistics.removed, 0);
    EXPECT_EQ(result.triangles.size(), solid.triangles.size());
}

TEST(PullOff, OneDentLeavesLittle) {
    const TestSolid hull = hull_of(random_sphere_points(3, 150, 500000));
    for (const int depth : {1, 4, 8, 12}) {
        const TestSolid solid = dented(hull, 17, depth);
        const PullOff result = pull(solid);
        expect_sound(solid, result);
        EXPECT_LE(static_cast<int>(result.triangles.size()), 12 * reflex_edges(solid) + 12);
        EXPECT_GE(result.statistics.removed, 100);
    }
}

// L2.5: at most 2r pointed vertices are hindered, in the paper's normal form (no coplanar dome that
// an existing diagonal divides).
TEST(PullOff, HinderedPointedVerticesAreFew) {
    std::vector<TestSolid> solids{schoenhardt()};
    for (const int n : {2, 3, 4, 8}) solids.push_back(chazelle(n));
    int with_hindered = 0;
    for (std::uint64_t seed = 0; seed < 40; ++seed) {
        const TestSolid void_of_four = hull_of(random_sphere_points(seed, 4, 480000));
        solids.push_back(
            join(hull_of(random_sphere_points(seed + 100, 60, 500000)), mirrored(void_of_four)));
    }
    for (std::uint64_t seed = 0; seed < 60; ++seed)
        solids.push_back(random_voxel_solid(seed, {2, 4, VoxelMap::jitter, 20, false}));
    for (const int depth : {2, 6, 10, 14})
        for (const int vertex : {3, 30, 60})
            solids.push_back(dented(hull_of(random_sphere_points(9, 80, 500000)), vertex, depth));
    for (const TestSolid& solid : solids) {
        const std::vector<PulledKind> kinds = classify_vertices(
            solid.points, solid.triangles, facet_owners(solid.points, solid.triangles, {}, {}));
        const auto hindered = std::count_if(kinds.begin(), kinds.end(), [](PulledKind k) {
            return k == PulledKind::hindered_by_vertex || k == PulledKind::hindered_by_edge;
        });
        EXPECT_LE(hindered, 2 * reflex_edges(solid));
        with_hindered += hindered > 0;
    }
    EXPECT_GE(with_hindered, 10);
}

// An octahedron with a void of a spike's shape that reaches into the cup of every corner.
TEST(PullOff, SpikeHindersADome) {
    TestSolid solid = octahedron(1000);
    const TestSolid spike{{{-10, -10, -300}, {10, -10, -300}, {0, 10, -300}, {0, 0, 500}},
                          {{0, 1, 2}, {0, 3, 1}, {1, 3, 2}, {2, 3, 0}}};
    solid = join(solid, spike);
    const std::vector<PulledKind> kinds = classify_vertices(
        solid.points, solid.triangles, facet_owners(solid.points, solid.triangles, {}, {}));
    EXPECT_EQ(std::count(kinds.begin(), kinds.end(), PulledKind::hindered_by_vertex), 6);
    const PullOff result = pull(solid);
    EXPECT_EQ(result.statistics.removed, 0);
    EXPECT_GE(result.statistics.hindered_by_vertex, 6);
}

TEST(PullOff, RandomSolidsKeepVolume) {
    for (std::uint64_t seed = 0; seed < 400; ++seed) {
        SCOPED_TRACE(seed);
        VoxelOptions voxels;
        voxels.cavities = seed % 7 == 0;
        const TestSolid solid = random_voxel_solid(seed, voxels);
        for (const PullMode mode : {PullMode::all, PullMode::crossings}) {
            const PullOff result = pull(solid, {seed % 2 ? 25 : 6, mode});
            expect_sound(solid, result);
        }
    }
}

TEST(PullOff, GainModeLowersCrossings) {
    Progress progress;
    for (std::uint64_t seed = 0; seed < 60; ++seed) {
        const TestSolid solid = random_voxel_solid(seed, {2, 4, VoxelMap::jitter, 20, false});
        const auto owners = facet_owners(solid.points, solid.triangles, {}, {});
        const PullOff result = pull(solid, {25, PullMode::crossings});
        EXPECT_LE(projected_crossings(solid.points, result.triangles, result.owners, progress),
                  projected_crossings(solid.points, solid.triangles, owners, progress));
    }
}

TEST(PullOff, EqualInputGivesEqualOutput) {
    const TestSolid solid = random_voxel_solid(5, {3, 4, VoxelMap::jitter, 20, false});
    const PullOff a = pull(solid), b = pull(solid);
    EXPECT_EQ(a.triangles, b.triangles);
    EXPECT_EQ(a.owners, b.owners);
}

TEST(PullOff, StopsWhenAsked) {
    const TestSolid solid = uv_sphere(60, 30, 500000);
    Progress progress([](const std::string&, double) { return false; });
    const auto owners = facet_owners(solid.points, solid.triangles, {}, {});
    EXPECT_THROW(pull_off(solid.points, solid.triangles, owners, {}, progress), Cancelled);
}

}  // namespace
}  // namespace tetra::testing
