// SPDX-License-Identifier: LGPL-2.1-or-later
// Notch cutting on named, random and lower-bound solids: exact volumes, counts, the papers' bounds.
#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "random_solids.h"
#include "tetra/exact/hpoint.h"
#include "tetra/notch/convex_cells.h"

namespace tetra {
namespace {

using testing::TestSolid;

ConvexCells decompose(const TestSolid& solid, const CellsOptions& options = {}) {
    GridSolid grid = testing::grid_solid(solid);
    grid.grid.bits = 26;
    std::vector<Vec3d> vertices;
    for (const Vec3i& p : grid.points)
        vertices.push_back(
            {static_cast<double>(p[0]), static_cast<double>(p[1]), static_cast<double>(p[2])});
    Progress progress;
    return convex_cells(grid, vertices, options, progress);
}

CellsOptions exact_planes() {
    CellsOptions options;
    options.flatness = 0;
    return options;
}

std::size_t count(const ConvexCells& cells) { return cells.cell_solid.size(); }

// Six times the cells' volume as doubles; small solids on small grids lose nothing that matters.
double six_volumes(const TestSolid& solid) { return testing::volume6(solid).to_double(); }

TEST(notch_cells, named_solids_have_their_pieces_and_their_volume) {
    for (const testing::NamedSolid& named : testing::named_solids()) {
        const ConvexCells cells = decompose(named.solid, exact_planes());
        EXPECT_TRUE(cells.stats.exact) << named.name;
        EXPECT_NEAR(6 * cells.stats.volume, six_volumes(named.solid),
                    1e-12 * six_volumes(named.solid))
            << named.name;
        if (named.cells > 0) {
            EXPECT_EQ(count(cells), static_cast<std::size_t>(named.cells)) << named.name;
        }
    }
}

TEST(notch_cells, a_convex_solid_is_one_cell) {
    for (std::uint64_t seed = 0; seed < 40; ++seed)
        EXPECT_EQ(count(decompose(testing::random_convex_solid(seed, 12), exact_planes())), 1u);
}

TEST(notch_cells, lower_bound_family_meets_the_bounds) {
    for (int n = 2; n <= 8; ++n) {
        const TestSolid solid = testing::chazelle(n);
        EXPECT_EQ(count(decompose(solid)), static_cast<std::size_t>((n + 2) * (n + 2)));
        CellsOptions plain = exact_planes();
        plain.rule = NotchRule::plain;
        plain.merge = false;
        const ConvexCells cells = decompose(solid, plain);
        const int r = cells.stats.notches;
        EXPECT_EQ(r, 2 * n + 2);
        EXPECT_LE(count(cells), static_cast<std::size_t>((r * r + r) / 2 + 1));
    }
}

// Every rule, extent and kind of contact; the kernel's own check proves convexity and volume.
TEST(notch_cells, random_solids_with_contacts) {
    for (std::uint64_t seed = 0; seed < 60; ++seed) {
        testing::VoxelOptions voxels;
        voxels.max_size = 3;
        voxels.cavities = seed % 5 == 0;
        const TestSolid solid = seed % 7 == 0 ? testing::random_type1_solid(seed, voxels)
                                              : testing::random_voxel_solid(seed, voxels);
        CellsOptions options = exact_planes();
        options.seed = seed;
        options.rule = seed % 3 == 0   ? NotchRule::random
                       : seed % 3 == 1 ? NotchRule::cover
                                       : NotchRule::plain;
        options.extent = seed % 4 == 0 ? CutExtent::whole_plane : CutExtent::random;
        const ConvexCells cells = decompose(solid, options);
        EXPECT_TRUE(cells.stats.exact) << seed;
        EXPECT_GE(count(cells), 1u) << seed;
    }
}

TEST(notch_cells, plain_cutting_keeps_the_bound_on_random_solids) {
    for (std::uint64_t seed = 100; seed < 130; ++seed) {
        testing::VoxelOptions voxels;
        voxels.max_size = 2;
        CellsOptions plain = exact_planes();
        plain.rule = NotchRule::plain;
        plain.merge = false;
        const ConvexCells cells = decompose(testing::random_voxel_solid(seed, voxels), plain);
        const double r = cells.stats.notches;
        // A solid whose parts only touch starts as several pieces: at most one more per contact.
        EXPECT_LE(static_cast<double>(count(cells)), r * r / 2 + r / 2 + 8) << seed;
    }
}

TEST(notch_cells, result_does_not_depend_on_the_order_of_the_input) {
    testing::VoxelOptions voxels;
    voxels.max_size = 3;
    for (std::uint64_t seed = 7; seed < 12; ++seed) {
        const TestSolid solid = testing::random_voxel_solid(seed, voxels);
        const ConvexCells a = decompose(solid), b = decompose(testing::shuffle(solid, seed));
        EXPECT_EQ(a.points, b.points) << seed;
        EXPECT_EQ(a.facet_vertices, b.facet_vertices) << seed;
        EXPECT_EQ(a.cell_offsets, b.cell_offsets) << seed;
    }
}

TEST(notch_cells, cancels_when_asked) {
    Progress stop([](const std::string&, double) { return false; });
    GridSolid grid = testing::grid_solid(testing::chazelle(4));
    std::vector<Vec3d> vertices(grid.points.size(), Vec3d{0, 0, 0});
    EXPECT_THROW(convex_cells(grid, vertices, {}, stop), Cancelled);
}

}  // namespace
}  // namespace tetra
