// SPDX-License-Identifier: LGPL-2.1-or-later
// The fence-off is an exact conforming partition, of named and of random solids, along all axes.
#include "tetra/fence/fence_off.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "fence_check.h"
#include "random_solids.h"
#include "tetra/errors.h"

namespace tetra::testing {
namespace {

constexpr Matrix3 kAsIs{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
constexpr Matrix3 kTurned45{{{1, -1, 0}, {1, 1, 0}, {0, 0, 1}}};
constexpr Matrix3 kGeneral{{{5, 1, -2}, {-1, 4, 3}, {2, -3, 6}}};
// Cyclic: x, y or z is laid on z without turning the solid over.
constexpr Matrix3 kAxes[3] = {
    {{{0, 1, 0}, {0, 0, 1}, {1, 0, 0}}}, {{{0, 0, 1}, {1, 0, 0}, {0, 1, 0}}}, kAsIs};

FenceInput fence_input(const TestSolid& solid) {
    FenceInput input;
    input.points = solid.points;
    input.triangles = solid.triangles;
    return input;
}

// The counts of a run along z, after it was found exact.
FenceCounts checked(const FenceInput& input, std::size_t* tets = nullptr) {
    Progress progress;
    const FenceResult result = fence_off(input, progress);
    EXPECT_EQ(fence_fault(input, result), "");
    if (tets) *tets = result.mesh.tets.size();
    return result.counts;
}

void check_axes(const TestSolid& solid, const std::string& what) {
    for (int axis = 0; axis < 3; ++axis) {
        SCOPED_TRACE(what + " along axis " + std::to_string(axis));
        FenceInput input = fence_input(map(solid, kAxes[axis]));
        checked(input);
        input.keep.assign(input.points.size(), 0);
        checked(input);
    }
}

TestSolid jittered(const TestSolid& solid, std::uint64_t seed) {
    TestSolid s = map(solid, {{{64, 0, 0}, {0, 64, 0}, {0, 0, 64}}});
    Random random(seed);
    for (Vec3i& p : s.points)
        for (std::int64_t& x : p) x += random.between(-3, 3);
    return s;
}

TEST(FenceOff, NamedSolidsInFourPoses) {
    for (const NamedSolid& named : named_solids()) {
        check_axes(named.solid, named.name);
        check_axes(map(named.solid, kTurned45), std::string(named.name) + " turned");
        check_axes(map(named.solid, kGeneral), std::string(named.name) + " mapped");
    }
}

TEST(FenceOff, JitteredTinySolids) {
    const TestSolid solids[] = {cube(), octahedron(), schoenhardt(), plate_with_holes(1, 2),
                                chazelle(2)};
    for (const TestSolid& solid : solids)
        for (std::uint64_t seed = 1; seed <= 5; ++seed) check_axes(jittered(solid, seed), "jitter");
}

// Counts of FENCES.md, "Tiny gates".
TEST(FenceOff, TinyGates) {
    const auto tets_along_z = [](const TestSolid& solid) {
        std::size_t tets = 0;
        checked(fence_input(solid), &tets);
        return tets;
    };
    EXPECT_EQ(tets_along_z(cube()), 6u);
    EXPECT_EQ(tets_along_z(octahedron()), 4u);
}

// The quadratic family: (N+1)(N+4)-1 cells seen from the side, (2N+3)^2 from above.
TEST(FenceOff, ChazelleCells) {
    for (const int n : {2, 3, 4, 6, 8}) {
        const TestSolid solid = chazelle(n);
        EXPECT_EQ(checked(fence_input(map(solid, kAxes[0]))).cells, (n + 1) * (n + 4) - 1);
        EXPECT_EQ(checked(fence_input(map(solid, kAxes[1]))).cells, (n + 1) * (n + 4) - 1);
        EXPECT_EQ(checked(fence_input(solid)).cells, (2 * n + 3) * (2 * n + 3));
    }
}

TEST(FenceOff, CyclicColumnGetsAConePoint) {
    const TestSolid solid = chazelle(4, 32);
    EXPECT_EQ(checked(fence_input(map(solid, kAxes[0]))).cyclic_columns, 3);
    EXPECT_EQ(checked(fence_input(solid)).cyclic_columns, 0);
}

TEST(FenceOff, RandomVoxelSolids) {
    for (std::uint64_t seed = 0; seed < 150; ++seed) {
        VoxelOptions options;
        options.cavities = seed % 5 == 0;
        check_axes(random_voxel_solid(seed, options), "voxels " + std::to_string(seed));
    }
}

TEST(FenceOff, RandomConvexSolids) {
    for (std::uint64_t seed = 0; seed < 20; ++seed)
        check_axes(random_convex_solid(seed, 20), "convex " + std::to_string(seed));
}

TEST(FenceOff, VertexStandingOnAFacet) {
    for (std::uint64_t seed = 0; seed < 40; ++seed)
        check_axes(random_type1_solid(seed), "type 1, " + std::to_string(seed));
}

// Facets of different owners stay apart, also within one plane.
TEST(FenceOff, OwnersAreKept) {
    for (std::uint64_t seed = 0; seed < 60; ++seed) {
        SCOPED_TRACE(seed);
        const TestSolid solid = random_voxel_solid(seed);
        Random random(seed);
        FenceInput input = fence_input(solid);
        for (std::size_t t = 0; t < solid.triangles.size(); ++t)
            input.owner.push_back(random.between(0, 2));
        checked(input);
    }
}

// A face gridded finely: all its inner vertices are flat, those on its rims mid-edge.
TEST(FenceOff, FlatVerticesSurvive) {
    std::vector<std::string> rows(5, "#####");
    const TestSolid block = voxel_solid({rows, rows});
    check_axes(block, "block");
    check_axes(map(block, kGeneral), "mapped block");
}

TEST(FenceOff, SolidsSideBySideShareOnlyInputPoints) {
    TestSolid both = join(cube(4), map(cube(4), kAsIs, {4, 0, 0}));
    const std::size_t half = both.triangles.size() / 2;
    both = weld(both);
    FenceInput input = fence_input(both);
    input.solid.assign(both.triangles.size(), 0);
    std::fill(input.solid.begin() + static_cast<std::ptrdiff_t>(half), input.solid.end(), 1);
    Progress progress;
    const FenceResult result = fence_off(input, progress);
    EXPECT_EQ(result.mesh.points.size(), 12u);
    EXPECT_EQ(result.mesh.tets.size(), 12u);
    EXPECT_EQ(std::ranges::count(result.mesh.tet_solid, 1), 6);
}

TEST(FenceOff, CrossingShellsAreRefused) {
    const TestSolid crossing = join(cube(8), map(cube(8), kAsIs, {3, 3, 3}));
    Progress progress;
    EXPECT_THROW(fence_off(fence_input(crossing), progress), InvalidSolid);
}

// R12: part of a face in common is ambiguous within one solid, whichever way the face looks.
TEST(FenceOff, FaceContactsAreRefused) {
    const TestSolid contact = weld(join(cube(8), map(cube(4), kAsIs, {8, 2, 2})));
    for (const Matrix3& axis : kAxes) {
        Progress progress;
        try {
            fence_off(fence_input(map(contact, axis)), progress);
            ADD_FAILURE() << "no error";
        } catch (const InvalidSolid& error) {
            EXPECT_EQ(error.defects.front().kind, "face_contact");
            EXPECT_FALSE(error.defects.front().triangles.empty());
        }
    }
}

TEST(FenceOff, CancelStops) {
    int calls = 0;
    Progress progress([&](const std::string&, double) { return ++calls < 1; });
    EXPECT_THROW(fence_off(fence_input(chazelle(8)), progress), Cancelled);
}

TEST(FenceOff, EqualInputEqualOutput) {
    const FenceInput input = fence_input(random_voxel_solid(7));
    Progress progress;
    const FenceResult a = fence_off(input, progress), b = fence_off(input, progress);
    EXPECT_EQ(a.mesh.tets, b.mesh.tets);
    EXPECT_EQ(a.mesh.skin, b.mesh.skin);
    EXPECT_EQ(a.mesh.skin_source, b.mesh.skin_source);
}

}  // namespace
}  // namespace tetra::testing
