// SPDX-License-Identifier: LGPL-2.1-or-later
// The driver of convex cells: which method it takes, and that the choice never costs cells.
#include <gtest/gtest.h>

#include "random_solids.h"
#include "tetra/assemble/decompose_cells.h"
#include "tetra/errors.h"

namespace tetra::testing {
namespace {

CellsOutcome run(const TestSolid& solid, CellsMethod method, const CellsOptions& options = {}) {
    GridSolid grid = grid_solid(solid);
    grid.grid.bits = 26;
    std::vector<Vec3d> vertices;
    for (const Vec3i& p : grid.points)
        vertices.push_back(
            {static_cast<double>(p[0]), static_cast<double>(p[1]), static_cast<double>(p[2])});
    Progress progress;
    return decompose_cells(grid, vertices, method, options, progress);
}

TEST(DecomposeCells, TakesTheMethodAskedFor) {
    const CellsOutcome cut = run(chazelle(4), CellsMethod::bajaj_dey);
    EXPECT_EQ(cut.method, CellsMethod::bajaj_dey);
    EXPECT_EQ(cut.by_bajaj_dey, 36);
    EXPECT_EQ(cut.by_fences, -1);
    const CellsOutcome fenced = run(chazelle(4), CellsMethod::fences);
    EXPECT_EQ(fenced.method, CellsMethod::fences);
    EXPECT_EQ(fenced.by_bajaj_dey, -1);
    EXPECT_EQ(fenced.by_fences, static_cast<int>(fenced.cells.cell_solid.size()));
    EXPECT_EQ(fenced.directions.size(), 1u);
}

TEST(DecomposeCells, AutomaticSaysWhyFencesWereLeftOut) {
    EXPECT_EQ(run(cube(), CellsMethod::automatic).note, "no notch to resolve");
    CellsOptions plain;
    plain.rule = NotchRule::plain;
    EXPECT_EQ(run(chazelle(3), CellsMethod::automatic, plain).note,
              "the plain method was asked for");
}

TEST(DecomposeCells, AutomaticNeverHasMoreCellsThanNotchCutting) {
    int tried = 0;
    for (std::uint64_t seed = 0; seed < 40; ++seed) {
        SCOPED_TRACE(seed);
        VoxelOptions voxels;
        voxels.max_size = 3;
        const TestSolid solid = random_voxel_solid(seed, voxels);
        const CellsOutcome cut = run(solid, CellsMethod::bajaj_dey);
        const CellsOutcome chosen = run(solid, CellsMethod::automatic);
        EXPECT_EQ(chosen.by_bajaj_dey, cut.by_bajaj_dey);
        EXPECT_LE(chosen.cells.cell_solid.size(), cut.cells.cell_solid.size());
        EXPECT_NEAR(chosen.cells.stats.volume, cut.cells.stats.volume,
                    1e-12 * cut.cells.stats.volume);
        tried += chosen.by_fences >= 0;
    }
    EXPECT_GT(tried, 0) << "some solid has to be worth the fences";
}

}  // namespace
}  // namespace tetra::testing
