// SPDX-License-Identifier: LGPL-2.1-or-later
// Cups put back on a fenced remainder: exact face-to-face partitions with the skin of the input.
#include <gtest/gtest.h>

#include "assemble_compact_support.h"
#include "pull_off_support.h"
#include "tetra/assemble/emit_cups.h"

namespace tetra::testing {
namespace {

struct Made {
    ExactMesh mesh;
    PullOff pulled;
};

Made make(const TestSolid& solid, const PullOptions& options) {
    Progress progress;
    const std::vector<int> owners = facet_owners(solid.points, solid.triangles, {}, {});
    Made made;
    made.pulled = pull_off(solid.points, solid.triangles, owners, options, progress);
    FenceResult fenced;
    if (!made.pulled.triangles.empty())
        fenced =
            fence_off({solid.points, made.pulled.triangles, made.pulled.owners, {}, {}}, progress);
    std::vector<int> owner_triangle(static_cast<std::size_t>(made.pulled.first_cup), -1);
    for (std::size_t t = 0; t < owners.size(); ++t)
        owner_triangle[static_cast<std::size_t>(owners[t])] = static_cast<int>(t);
    made.mesh = emit_cups(fenced, made.pulled, {solid.points, owner_triangle, 0});
    return made;
}

void expect_exact(const TestSolid& solid, const PullOptions& options = {}) {
    const Made made = make(solid, options);
    EXPECT_EQ(testing_support::flaw_of(made.mesh, grid_solid(solid)), "");
}

TEST(EmitCups, ConsumedSolids) {
    for (const TestSolid& solid :
         {cube(), octahedron(), prism(12, 1000, 700), gridded_cube(3, 7), moment_curve_hull(20),
          hull_of(random_sphere_points(4, 100, 500000)), uv_sphere(24, 12, 500000)}) {
        const Made made = make(solid, {});
        EXPECT_EQ(testing_support::flaw_of(made.mesh, grid_solid(solid)), "");
        for (const Carrier& c : made.mesh.carriers) EXPECT_EQ(c.kind, CarrierKind::vertex);
        EXPECT_EQ(static_cast<int>(made.mesh.tets.size()), cup_tets(made.pulled));
    }
}

TEST(EmitCups, NamedSolids) {
    for (const NamedSolid& named : named_solids())
        for (const int cap : {6, 25}) {
            SCOPED_TRACE(named.name);
            expect_exact(named.solid, {cap, PullMode::all});
            expect_exact(named.solid, {cap, PullMode::crossings});
        }
}

TEST(EmitCups, DentedHulls) {
    const TestSolid hull = hull_of(random_sphere_points(3, 80, 500000));
    for (const int depth : {1, 4, 8, 12})
        for (const int vertex : {5, 50}) expect_exact(dented(hull, vertex, depth));
}

TEST(EmitCups, RandomSolids) {
    for (std::uint64_t seed = 0; seed < 150; ++seed) {
        SCOPED_TRACE(seed);
        VoxelOptions voxels;
        voxels.cavities = seed % 5 == 0;
        expect_exact(random_voxel_solid(seed, voxels),
                     {seed % 2 ? 25 : 6, seed % 3 ? PullMode::all : PullMode::crossings});
    }
}

}  // namespace
}  // namespace tetra::testing
