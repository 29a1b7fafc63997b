// SPDX-License-Identifier: LGPL-2.1-or-later
// Rule R11: a cyclic column without a cone point is avoided by another diagonal of its base.
#include "../src/fence/columns.h"

#include <gtest/gtest.h>

#include <map>

#include "random_solids.h"
#include "tetra/errors.h"

namespace tetra::testing {
namespace {

using Mod = std::uint64_t;

struct Stages {
    FenceInput input;
    fence::Plan plan;
    fence::Walls walls;
    fence::Joints joints;
    fence::Bases bases;
    Progress progress;

    explicit Stages(const TestSolid& solid) {
        input.points = solid.points;
        input.triangles = solid.triangles;
        plan = fence::make_plan(input);
        walls = fence::sweep_walls(plan, progress);
        std::vector<fence::InnerPoint> inner = fence::locate_flat_points(plan, walls);
        joints = fence::join_walls(plan, walls, inner, progress);
        bases = fence::collect_bases(walls, std::move(inner));
    }

    // Refuses calls first .. last - 1.
    fence::Columns columns(int first, int last, int* calls = nullptr) {
        int count = 0;
        const auto finder = [&](const fence::Plan& p, const std::array<int, 3>& base, int floor,
                                int ceiling) {
            const int call = count++;
            if (calls) *calls = count;
            return call >= first && call < last ? std::nullopt
                                                : fence::point_in_column(p, base, floor, ceiling);
        };
        return fence::build_columns(plan, walls, joints, bases, progress, finder);
    }
};

Mod minus(Mod a, Mod b) { return (a + kHashPrime - b) % kHashPrime; }

using Residue = std::array<Mod, 3>;

Mod det(const Residue& a, const Residue& b, const Residue& c) {
    Mod sum = 0;
    for (std::size_t k = 0; k < 3; ++k) {
        const std::size_t u = (k + 1) % 3, v = (k + 2) % 3;
        const Mod minor = minus(multiply_mod(b[u], c[v]), multiply_mod(b[v], c[u]));
        sum = (sum + multiply_mod(a[k], minor)) % kHashPrime;
    }
    return sum;
}

// Exact volume, and no triangle on more than two tetrahedra.
void check(const Stages& stages, const fence::Columns& columns, const TestSolid& solid) {
    std::vector<Residue> at;
    for (const fence::Mark& m : stages.joints.marks)
        at.push_back(residues(fence::place_of(stages.plan, m)));
    for (const HPoint& p : columns.cone_points) at.push_back(residues(p));
    Mod volume = 0;
    std::map<Triangle, int> uses;
    for (const auto& t : columns.tets) {
        const auto corner = [&](std::size_t i) { return at[static_cast<std::size_t>(t[i])]; };
        const auto edge = [&](std::size_t i) {
            Residue d{};
            for (std::size_t k = 0; k < 3; ++k) d[k] = minus(corner(i)[k], corner(0)[k]);
            return d;
        };
        volume = (volume + det(edge(1), edge(2), edge(3))) % kHashPrime;
        for (std::size_t i = 0; i < 4; ++i) {
            Triangle side{t[(i + 1) % 4], t[(i + 2) % 4], t[(i + 3) % 4]};
            std::sort(side.begin(), side.end());
            ++uses[side];
        }
    }
    EXPECT_EQ(volume, volume6(solid).mod(kHashPrime));
    for (const auto& [side, n] : uses) EXPECT_LE(n, 2);
}

TEST(FenceColumns, AnotherDiagonalWhereThereIsNoConePoint) {
    int flipped = 0, refused = 0;
    for (std::uint64_t seed = 0; seed < 400 && flipped < 3; ++seed) {
        SCOPED_TRACE(seed);
        VoxelOptions options;
        options.map = VoxelMap::jitter;
        const TestSolid solid = random_voxel_solid(seed, options);
        Stages stages(solid);
        int calls = 0;
        const fence::Columns plain = stages.columns(0, 0, &calls);
        if (calls == 0) continue;
        try {
            const fence::Columns other = stages.columns(0, 1);
            check(stages, other, solid);
            EXPECT_EQ(other.base_triangles, plain.base_triangles);
            ++flipped;
        } catch (const VerificationFailed&) {
            ++refused;  // its base has no inner edge that can be exchanged
        }
    }
    EXPECT_GE(flipped, 3);
}

TEST(FenceColumns, TypedErrorWhenNothingHelps) {
    Stages stages(schoenhardt());
    int calls = 0;
    const fence::Columns plain = stages.columns(0, 0, &calls);
    ASSERT_GT(calls, 0) << "seen along its axis one column is cyclic";
    check(stages, plain, schoenhardt());
    EXPECT_THROW(stages.columns(0, 1000), VerificationFailed);
}

}  // namespace
}  // namespace tetra::testing
