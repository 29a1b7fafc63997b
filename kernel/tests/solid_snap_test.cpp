// SPDX-License-Identifier: LGPL-2.1-or-later
// Snapping keeps surfaces closed, and repairs what turns flat without changing the volume.
#include "tetra/solid/snap.h"

#include <gtest/gtest.h>

#include "solid_support.h"
#include "tetra/exact/predicates.h"
#include "tetra/solid/edges.h"

namespace tetra::testing {
namespace {

bool any_flat(const GridSolid& s) {
    for (const Triangle& t : s.triangles)
        if (collinear(s.points[static_cast<std::size_t>(t[0])],
                      s.points[static_cast<std::size_t>(t[1])],
                      s.points[static_cast<std::size_t>(t[2])]))
            return true;
    return false;
}

bool points_distinct(const GridSolid& s) {
    std::vector<Vec3i> p = s.points;
    std::sort(p.begin(), p.end());
    return std::adjacent_find(p.begin(), p.end()) == p.end();
}

// Splits edges of a solid at random grid points inside them on one side only, filling the gap with
// flat triangles: several per edge, stacked.
GridSolid with_flat_triangles(const TestSolid& solid, std::uint64_t seed) {
    Random random(seed);
    GridSolid s = grid_solid(map(solid, {{{12, 0, 0}, {0, 12, 0}, {0, 0, 12}}}));
    const std::size_t n = s.triangles.size();
    for (std::size_t t = 0; t < n; ++t) {
        if (!random.chance(1, 2)) continue;
        const int side = random.between(0, 2);
        const Triangle old = s.triangles[t];
        const int a = old[static_cast<std::size_t>(side)],
                  b = old[static_cast<std::size_t>((side + 1) % 3)],
                  c = old[static_cast<std::size_t>((side + 2) % 3)];
        const int count = random.between(1, 3);
        std::vector<int> row{a};
        for (int k = 1; k <= count; ++k) {
            Vec3i p;
            for (std::size_t i = 0; i < 3; ++i) {
                const Vec3i &u = s.points[static_cast<std::size_t>(a)],
                            &v = s.points[static_cast<std::size_t>(b)];
                p[i] = u[i] + (v[i] - u[i]) * k / 4;
            }
            row.push_back(static_cast<int>(s.points.size()));
            s.points.push_back(p);
            s.point_source.push_back(row.back());
        }
        row.push_back(b);
        s.triangles[t] = {row[0], row[1], c};
        const auto add = [&](const Triangle& corners) {
            s.triangles.push_back(corners);
            s.triangle_source.push_back(static_cast<int>(t));
            s.solid.push_back(0);
        };
        for (std::size_t k = 1; k + 1 < row.size(); ++k) add({row[k], row[k + 1], c});
        // The flat polygon between the broken line and a -> b, cut up from a random end.
        for (std::size_t i = 0, j = row.size() - 1; j - i >= 2;) {
            if (random.chance(1, 2)) {
                add({row[i], row[j], row[i + 1]});
                ++i;
            } else {
                add({row[i], row[j], row[j - 1]});
                --j;
            }
        }
    }
    return s;
}

TEST(Snap, RepairsStackedFlatTriangles) {
    for (std::uint64_t seed = 1; seed <= 60; ++seed) {
        VoxelOptions options;
        options.max_bits = 12;
        // Where both triangles of an edge got points, these fall together: merging welds them.
        const GridSolid split = with_flat_triangles(random_voxel_solid(seed, options), seed);
        const Surface surface = surface_of({split.points, split.triangles});
        const GridSolid broken = merge_on_grid({surface.vertices, surface.triangles, {}, {}}, 22);
        ASSERT_TRUE(is_closed(broken.triangles, broken.solid));
        ASSERT_TRUE(any_flat(broken));
        SnapReport report;
        const GridSolid repaired = repair_flat_triangles(broken, &report);
        ASSERT_TRUE(is_closed(repaired.triangles, repaired.solid));
        ASSERT_FALSE(any_flat(repaired));
        ASSERT_TRUE(volume6(repaired) == volume6(broken));
        Progress progress;
        const Validation v = validated(surface);
        ASSERT_EQ(kinds(v.defects), "") << seed;
        const GridSolid snapped = build_grid_solid(v.surface(surface.vertices), 22);
        ASSERT_FALSE(any_flat(snapped));
        ASSERT_TRUE(points_distinct(snapped));
        ASSERT_EQ(kinds(find_defects(snapped, progress)), "") << seed;
    }
}

TEST(Snap, FlatTriangleOfOpenSurfaceIsReported) {
    GridSolid s;
    s.points = {{0, 0, 0}, {2, 0, 0}, {1, 0, 0}};
    s.point_source = {0, 1, 2};
    s.triangles = {{0, 1, 2}};
    s.triangle_source = {7};
    s.solid = {0};
    try {
        repair_flat_triangles(s);
        FAIL();
    } catch (const InvalidSolid& e) {
        EXPECT_EQ(e.defects.at(0).kind, "degenerate_triangle");
        EXPECT_EQ(e.defects.at(0).triangles, std::vector<int>{7});
    }
}

// A plate thinner than a grid step disappears where it hangs free, and its solid stays.
TEST(Snap, PartsWithoutThicknessAreCancelled) {
    const TestSolid body = cube(1 << 20);
    TestSolid plate = map(cube(1), {{{1 << 10, 0, 0}, {0, 1 << 10, 0}, {0, 0, 1}}});
    const Surface both =
        surface_of(join(body, map(plate, {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}}, {2 << 20, 0, 0})));
    SnapReport report;
    const GridSolid s = build_grid_solid({both.vertices, both.triangles, {}, {}}, 12, &report);
    EXPECT_EQ(s.triangles.size(), 12u);
    EXPECT_GT(report.dropped_triangles, 0);
    EXPECT_GT(report.merged_points, 0);
}

TEST(Snap, EverythingTooThinIsFlat) {
    const Surface plate = surface_of(map(cube(1), {{{1 << 10, 0, 0}, {0, 1 << 10, 0}, {0, 0, 1}}}));
    EXPECT_THROW(build_grid_solid({plate.vertices, plate.triangles, {}, {}}, 5), InvalidSolid);
}

TEST(Snap, CorpusStaysClosedOnAnyGrid) {
    for (const char* folder : {"off", "family"})
        for (const std::string& path : corpus_files(folder)) {
            const Surface surface = read_off(path);
            for (const int bits : {6, 8, 10, 12, 16, 20, 22, 26, 30}) {
                const GridSolid s =
                    build_grid_solid({surface.vertices, surface.triangles, {}, {}}, bits);
                ASSERT_TRUE(is_closed(s.triangles, s.solid)) << path << " " << bits;
                ASSERT_FALSE(any_flat(s)) << path << " " << bits;
                ASSERT_TRUE(points_distinct(s)) << path << " " << bits;
            }
        }
}

TEST(Snap, SolidsAreRepairedEachByItself) {
    for (std::uint64_t seed = 1; seed <= 20; ++seed) {
        VoxelOptions options;
        options.map = VoxelMap::jitter_mapped;
        const TestSolid one = random_voxel_solid(seed, options);
        const TestSolid two = map(one, {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}}, {1, 2, 3});
        const Surface both = surface_of(join(one, two));
        std::vector<int> solid(both.triangles.size(), 0);
        for (std::size_t t = one.triangles.size(); t < solid.size(); ++t) solid[t] = 1;
        for (const int bits : {3, 4, 5, 6}) {
            GridSolid s;
            try {
                s = build_grid_solid({both.vertices, both.triangles, {}, solid}, bits);
            } catch (const InvalidSolid& e) {
                EXPECT_EQ(kinds(e.defects), "flat_solid");
                continue;
            }
            std::array<GridSolid, 2> part;
            for (std::size_t t = 0; t < s.triangles.size(); ++t)
                part[static_cast<std::size_t>(s.solid[t])].triangles.push_back(s.triangles[t]);
            for (const GridSolid& p : part) EXPECT_TRUE(is_closed(p.triangles, {}));
        }
    }
}

}  // namespace
}  // namespace tetra::testing
