// SPDX-License-Identifier: LGPL-2.1-or-later
// The generators of test solids keep what they promise: closed, outward, repeatable, small.
#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <map>

#include "random_solids.h"
#include "tetra/exact/predicates.h"

namespace tetra::testing {
namespace {

void expect_closed(const TestSolid& solid) {
    std::map<std::pair<int, int>, int> balance;
    for (const Triangle& t : solid.triangles) {
        EXPECT_FALSE(collinear(solid.points[t[0]], solid.points[t[1]], solid.points[t[2]]));
        for (int i = 0; i < 3; ++i) {
            ++balance[{t[i], t[(i + 1) % 3]}];
            --balance[{t[(i + 1) % 3], t[i]}];
        }
    }
    for (const auto& [edge, count] : balance) EXPECT_EQ(count, 0);
    EXPECT_EQ(volume6(solid).sign(), 1);
}

std::int64_t reach(const TestSolid& solid) {
    std::int64_t result = 0;
    for (const Vec3i& p : solid.points)
        for (const std::int64_t c : p) result = std::max(result, std::abs(c));
    return result;
}

TestSolid read_off(const std::string& path) {
    std::ifstream file(path);
    std::string word;
    std::size_t points = 0, triangles = 0, skip = 0;
    file >> word >> points >> triangles >> skip;
    TestSolid solid;
    solid.points.resize(points);
    solid.triangles.resize(triangles);
    for (Vec3i& p : solid.points) file >> p[0] >> p[1] >> p[2];
    for (Triangle& t : solid.triangles) file >> skip >> t[0] >> t[1] >> t[2];
    EXPECT_TRUE(file) << path;
    return solid;
}

TEST(TestSolids, NamedAreClosed) {
    for (const NamedSolid& named : named_solids()) {
        SCOPED_TRACE(named.name);
        expect_closed(named.solid);
    }
}

TEST(TestSolids, VolumesAreKnown) {
    std::map<std::string, int> cells_of_64{{"cube", 1},    {"l_prism", 3}, {"boss", 10},
                                           {"cavity", 26}, {"frame", 8},   {"stairs", 15}};
    for (const NamedSolid& named : named_solids())
        if (cells_of_64.contains(named.name)) {
            EXPECT_EQ(volume6(named.solid), Int256(6 * 64 * cells_of_64[named.name])) << named.name;
        }
}

TEST(TestSolids, ChazelleEqualsTheCorpus) {
    for (const int n : {2, 3, 4, 8}) {
        const TestSolid ours = chazelle(n, 4 * n * n);
        const TestSolid theirs = read_off(std::string(TETRA_SHARED_DIR) +
                                          "/corpus/family/chazelle-" + std::to_string(n) + ".off");
        EXPECT_EQ(ours.points.size(), theirs.points.size());
        EXPECT_EQ(ours.triangles.size(), theirs.triangles.size());
        EXPECT_EQ(volume6(ours), volume6(theirs));
        expect_closed(ours);
    }
}

TEST(TestSolids, RandomAreClosedSmallAndRepeatable) {
    for (std::uint64_t seed = 0; seed < 500; ++seed) {
        SCOPED_TRACE(seed);
        VoxelOptions options;
        options.cavities = seed % 5 == 4;
        const TestSolid solid =
            seed % 7 == 6 ? random_type1_solid(seed, options) : random_voxel_solid(seed, options);
        expect_closed(solid);
        EXPECT_LE(reach(solid), std::int64_t{1} << 20);
        EXPECT_EQ(volume6(shuffle(solid, seed)), volume6(solid));
    }
    EXPECT_EQ(to_off(random_voxel_solid(17)), to_off(random_voxel_solid(17)));
}

TEST(TestSolids, ConvexOnesHaveNoReflexEdge) {
    for (std::uint64_t seed = 0; seed < 20; ++seed) {
        const TestSolid solid = random_convex_solid(seed, 14);
        expect_closed(solid);
        for (const Triangle& t : solid.triangles)
            for (const Vec3i& p : solid.points)
                EXPECT_LE(orient3d(solid.points[t[0]], solid.points[t[1]], solid.points[t[2]], p),
                          0);
    }
}

}  // namespace
}  // namespace tetra::testing
