// SPDX-License-Identifier: LGPL-2.1-or-later
// Compaction of meshes whose Steiner points can all go, exact against the solid.
#include "tetra/assemble/compact.h"

#include <gtest/gtest.h>

#include "assemble_compact_support.h"
#include "tetra/assemble/double_predicates.h"
#include "tetra/errors.h"

namespace tetra {
namespace {

using testing_support::box_voxels;
using testing_support::flaw_of;
using testing_support::random_voxels;
using testing_support::Refined;
using testing_support::refined_voxels;
using testing_support::RefinedOptions;
using testing_support::Voxel;

CompactStats compacted(Refined& r, CompactLevel level = CompactLevel::standard) {
    Progress progress;
    EXPECT_EQ(flaw_of(r.mesh, r.solid), "") << "before";
    CompactOptions options;
    options.level = level;
    const CompactStats stats = compact(r.mesh, r.solid, {}, options, progress);
    EXPECT_EQ(flaw_of(r.mesh, r.solid), "") << "after";
    return stats;
}

RefinedOptions oblique(int parts, std::int64_t spacing) {
    RefinedOptions o;
    o.parts = parts;
    o.spacing = spacing;
    o.map = {{{3, 1, -2}, {-1, 4, 1}, {2, -1, 5}}};
    return o;
}

TEST(Compact, BoxLosesAllSteinerPoints) {
    for (int parts : {2, 3, 4}) {
        Refined r = refined_voxels(box_voxels(1, 1, 1), oblique(parts, 5));
        const CompactStats stats = compacted(r);
        EXPECT_EQ(stats.steiner_after.total(), 0);
        EXPECT_EQ(r.mesh.points.size(), 8u);
        EXPECT_LE(r.mesh.tets.size(), 6u);
        EXPECT_EQ(r.mesh.skin.size(), 12u);
    }
}

TEST(Compact, LShapeAndBeamLoseAllSteinerPoints) {
    for (const std::set<Voxel>& voxels :
         {std::set<Voxel>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, box_voxels(4, 1, 1)}) {
        Refined r = refined_voxels(voxels, oblique(3, 7));
        const CompactStats stats = compacted(r);
        EXPECT_GT(stats.steiner_before.edge, 0);
        EXPECT_GT(stats.steiner_before.facet, 0);
        EXPECT_GT(stats.steiner_before.inner, 0);
        EXPECT_EQ(stats.steiner_after.total(), 0);
    }
}

TEST(Compact, ContactsAlongEdgesAndAtCornersStay) {
    for (const std::set<Voxel>& voxels :
         {std::set<Voxel>{{0, 0, 0}, {1, 1, 0}}, std::set<Voxel>{{0, 0, 0}, {1, 1, 1}},
          std::set<Voxel>{{0, 0, 0}, {1, 1, 0}, {1, 0, 1}, {0, 1, 1}}}) {
        Refined r = refined_voxels(voxels, oblique(2, 6));
        const CompactStats stats = compacted(r);
        EXPECT_EQ(stats.steiner_after.total(), 0);
        EXPECT_LE(r.mesh.tets.size(), 6 * voxels.size());
    }
}

TEST(Compact, RandomVoxelSolids) {
    int before = 0, after = 0;
    for (std::uint64_t seed = 0; seed < 60; ++seed) {
        RefinedOptions o = seed % 2 ? oblique(2, 5) : RefinedOptions{};
        o.uneven = seed % 3 == 0;
        Refined r = refined_voxels(random_voxels(seed, 3, 45), o);
        const CompactStats stats = compacted(r);
        ASSERT_FALSE(HasFailure()) << seed;
        before += stats.steiner_before.total();
        after += stats.steiner_after.total();
    }
    EXPECT_GT(before, 5000);
    EXPECT_LE(after, before / 200) << before;
}

TEST(Compact, MaxLevelEmptiesWhatStandardLeaves) {
    for (std::uint64_t seed = 0; seed < 10; ++seed) {
        Refined r = refined_voxels(random_voxels(seed, 3, 50), oblique(3, 4));
        EXPECT_LE(compacted(r, CompactLevel::max).steiner_after.total(), 1) << seed;
    }
}

TEST(Compact, SameInputSameOutput) {
    const auto run = [] {
        Refined r = refined_voxels(random_voxels(7, 3, 50), oblique(3, 4));
        compacted(r, CompactLevel::max);
        return r.mesh;
    };
    const ExactMesh a = run(), b = run();
    EXPECT_EQ(a.tets, b.tets);
    EXPECT_EQ(a.skin, b.skin);
    EXPECT_EQ(a.skin_source, b.skin_source);
}

TEST(Compact, FacesOfOnePlaneKeepTheirBorder) {
    Refined r = refined_voxels(box_voxels(2, 1, 1), oblique(2, 4));
    std::vector<int> faces(r.solid.triangles.size());
    // The first voxel's triangles are face 0, the second's face 1.
    for (std::size_t k = faces.size() / 2; k < faces.size(); ++k) faces[k] = 1;
    Progress progress;
    compact(r.mesh, r.solid, faces, {}, progress);
    EXPECT_EQ(flaw_of(r.mesh, r.solid), "");
    EXPECT_EQ(count_steiner(r.mesh).total(), 0);
    int skins[2] = {0, 0};
    for (int source : r.mesh.skin_source) ++skins[faces[static_cast<std::size_t>(source)]];
    EXPECT_EQ(skins[0], 10);
    EXPECT_EQ(skins[1], 10);
}

TEST(Compact, RefusesABrokenSkin) {
    Refined r = refined_voxels(box_voxels(1, 1, 1));
    r.mesh.skin.pop_back();
    r.mesh.skin_source.pop_back();
    Progress progress;
    EXPECT_THROW(compact(r.mesh, r.solid, {}, {}, progress), VerificationFailed);
}

TEST(Compact, CanBeCancelled) {
    Refined r = refined_voxels(box_voxels(3, 3, 3), oblique(4, 8));
    Progress progress([](const std::string&, double) { return false; });
    EXPECT_THROW(compact(r.mesh, r.solid, {}, {}, progress), Cancelled);
}

TEST(DoublePredicates, ExactOnNearlyFlatTetrahedra) {
    // d = a point of the plane x + y + z = 1 moved by single units in the last place.
    const Vec3d a{1, 0, 0}, b{0, 1, 0}, c{0, 0, 1};
    for (int ulps = -3; ulps <= 3; ++ulps) {
        const double z = 0.25 + ulps * 0x1p-54;
        EXPECT_EQ(orient3d(a, b, c, {0.5, 0.25, z}), (ulps > 0) - (ulps < 0)) << ulps;
    }
    const Vec3d far{1e15, -3e15, 7e14};
    EXPECT_EQ(orient3d(far, {1e15, -3e15, 7e14 + 1}, {1e-15, 0, 0}, {0, 1e-15, 0}),
              -orient3d(far, {1e15, -3e15, 7e14 + 1}, {0, 1e-15, 0}, {1e-15, 0, 0}));
}

TEST(DoublePredicates, HomogeneousPointsAgreeWithDoubles) {
    const auto h = [](std::int64_t x, std::int64_t y, std::int64_t z, std::int64_t w) {
        return HPoint{x * w, y * w, z * w, w};
    };
    const HPoint a = h(0, 0, 0, 3), b = h(5, 1, 0, 7), c = h(1, 6, 2, 1), d = h(2, 2, 9, 11);
    EXPECT_EQ(orient3d(a, b, c, d), 1);
    EXPECT_EQ(orient3d(a, c, b, d), -1);
    EXPECT_EQ(orient3d(a, b, c, h(6, 7, 2, 5)), 0);
    HPoint above = h(6, 7, 2, std::int64_t{1} << 40);
    above.z += 1;
    EXPECT_EQ(orient3d(a, b, c, above), 1);
}

}  // namespace
}  // namespace tetra
