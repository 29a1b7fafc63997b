// SPDX-License-Identifier: LGPL-2.1-or-later
// Validation in C++: random solids stay valid, penetrations are found, the corpus holds.
#include "tetra/solid/validate.h"

#include <gtest/gtest.h>

#include "solid_support.h"
#include "tetra/solid/edges.h"

namespace tetra::testing {
namespace {

const Matrix3 kIdentity{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};

TestSolid turned(TestSolid s) {
    for (Triangle& t : s.triangles) std::swap(t[1], t[2]);
    return s;
}

// The volume of the validated surface, in the solid's own integer coordinates.
Int256 volume_after(const TestSolid& solid, const Validation& v) {
    return volume6({solid.points, v.triangles});
}

TEST(Validate, NamedSolids) {
    for (const NamedSolid& named : named_solids()) {
        const Validation v = validated(surface_of(named.solid));
        EXPECT_EQ(kinds(v.defects), "") << named.name;
        EXPECT_TRUE(v.turned.empty()) << named.name;
        EXPECT_EQ(v.triangles, named.solid.triangles) << named.name;
        const Validation w = validated(surface_of(turned(named.solid)));
        EXPECT_EQ(kinds(w.defects), "") << named.name;
        EXPECT_EQ(w.counts.shells, v.counts.shells) << named.name;
        EXPECT_EQ(w.counts.genus, v.counts.genus) << named.name;
        EXPECT_EQ(w.turned.size(), static_cast<std::size_t>(w.counts.shells)) << named.name;
        EXPECT_TRUE(volume_after(named.solid, w) == volume6(named.solid)) << named.name;
    }
}

TEST(Validate, RandomVoxelSolids) {
    for (std::uint64_t seed = 0; seed < 300; ++seed) {
        VoxelOptions options;
        options.cavities = seed % 3 == 0;
        const TestSolid solid = random_voxel_solid(seed, options);
        const Validation v = validated(surface_of(solid));
        ASSERT_EQ(kinds(v.defects), "") << seed;
        ASSERT_TRUE(v.turned.empty()) << seed;
        ASSERT_EQ(v.counts.euler % 2, 0) << seed;
        ASSERT_GE(v.counts.genus, 0) << seed;
        ASSERT_TRUE(volume_after(solid, v) == volume6(solid)) << seed;
    }
}

TEST(Validate, RandomSolidsInsideOutOrShuffled) {
    for (std::uint64_t seed = 0; seed < 100; ++seed) {
        VoxelOptions options;
        options.cavities = seed % 2 == 0;
        const TestSolid solid = random_voxel_solid(seed, options);
        const Validation v = validated(surface_of(solid));
        const TestSolid mixed = shuffle(turned(solid), seed);
        const Validation w = validated(surface_of(mixed));
        ASSERT_EQ(kinds(w.defects), "") << seed;
        ASSERT_TRUE(volume_after(mixed, w) == volume6(solid)) << seed;
        ASSERT_EQ(w.counts.facets, v.counts.facets) << seed;
        ASSERT_EQ(w.counts.notches, v.counts.notches) << seed;
        ASSERT_EQ(w.counts.genus, v.counts.genus) << seed;
        ASSERT_EQ(w.counts.type2_edges, v.counts.type2_edges) << seed;
        ASSERT_EQ(w.counts.type3_vertices, v.counts.type3_vertices) << seed;
    }
}

TEST(Validate, VertexOnFacet) {
    for (std::uint64_t seed = 0; seed < 60; ++seed) {
        const Validation v = validated(surface_of(random_type1_solid(seed)));
        ASSERT_EQ(kinds(v.defects), "") << seed;
        ASSERT_GE(v.counts.type1_contacts, 1) << seed;
    }
}

TEST(Validate, OverlappingCopiesCross) {
    for (std::uint64_t seed = 0; seed < 60; ++seed) {
        VoxelOptions options;
        options.map = VoxelMap::mapped;
        // The shift is far below any thickness.
        const TestSolid solid =
            map(random_voxel_solid(seed, options), {{{16, 0, 0}, {0, 16, 0}, {0, 0, 16}}});
        Random random(seed);
        const Vec3i shift{random.between(-3, 3), random.between(-3, 3), random.between(1, 3)};
        const TestSolid both = join(solid, map(solid, kIdentity, shift));
        ASSERT_EQ(kinds(validated(surface_of(both)).defects), "self_crossing") << seed;
    }
}

TEST(Validate, FlippingOneTriangleNamesIt) {
    for (std::uint64_t seed = 0; seed < 40; ++seed) {
        TestSolid solid = random_convex_solid(seed, 12);
        Random random(seed);
        const auto t = static_cast<std::size_t>(
            random.between(0, static_cast<int>(solid.triangles.size()) - 1));
        std::swap(solid.triangles[t][1], solid.triangles[t][2]);
        const Validation v = validated(surface_of(solid));
        ASSERT_EQ(kinds(v.defects), "inconsistent_orientation");
        ASSERT_EQ(v.defects[0].triangles, std::vector<int>{static_cast<int>(t)});
    }
}

TEST(Validate, Corpus) {
    for (const char* folder : {"off", "family", "cases"})
        for (const std::string& path : corpus_files(folder)) {
            const Surface surface = read_off(path);
            const Validation v = validated(surface);
            ASSERT_EQ(kinds(v.defects), "") << path;
            ASSERT_TRUE(v.turned.empty()) << path;
            ASSERT_EQ(v.triangles, surface.triangles) << path;
            const bool page61 = path.find("Page_061") != std::string::npos;
            EXPECT_EQ(v.counts.type2_edges, page61 ? 5 : 0) << path;
        }
}

// Chazelle's polyhedron has 2N + 2 notches; 24 bits are needed for N = 32.
TEST(Validate, LowerBoundFamily) {
    for (const int n : {2, 3, 4, 6, 8, 16, 32}) {
        const Surface surface = surface_of(chazelle(n));
        const Validation v = validated(surface);
        ASSERT_EQ(kinds(v.defects), "");
        EXPECT_EQ(v.counts.notches, 2 * n + 2);
        EXPECT_EQ(v.counts.facets, 6 * n + 12);
        EXPECT_EQ(v.counts.euler, 2);
        Progress progress;
        EXPECT_LE(choose_grid(surface.vertices, v, 20, 27, progress).solid.grid.bits, 24);
    }
}

TEST(ChooseGrid, CorpusFindsACrossingFreeGrid) {
    for (const std::string& path : corpus_files("off")) {
        const Surface surface = read_off(path);
        const Validation v = validated(surface);
        Progress progress;
        const GridChoice choice = choose_grid(surface.vertices, v, 20, 27, progress);
        EXPECT_EQ(kinds(find_defects(choice.solid, progress)), "") << path;
        EXPECT_EQ(choice.report.merged_points, 0) << path;
        EXPECT_EQ(choice.solid.grid.bits, 20 + static_cast<int>(choice.rejected.size())) << path;
    }
}

TEST(Validate, CancelsQuickly) {
    const Surface surface = surface_of(plate_with_holes(20, 20));
    int calls = 0;
    Progress progress([&](const std::string&, double) { return ++calls < 1; });
    EXPECT_THROW(validate(surface.vertices, surface.triangles, {}, {}, progress), Cancelled);
}

}  // namespace
}  // namespace tetra::testing
