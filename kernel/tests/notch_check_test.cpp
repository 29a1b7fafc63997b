// SPDX-License-Identifier: LGPL-2.1-or-later
// The kernel's check of its cells tells points that are placed too far from where they belong.
#include <gtest/gtest.h>

#include "../src/notch/check_cells.h"
#include "../src/notch/place_points.h"
#include "random_solids.h"

namespace tetra::notch {
namespace {

struct Checked {
    GridSolid solid;
    Decomposition result{26};
};

// A solid of cells with its points placed on the caller's coordinates, which are the grid's.
Checked cells_of(const testing::TestSolid& solid) {
    Checked checked;
    checked.solid = testing::grid_solid(solid);
    checked.solid.grid.bits = 26;
    std::vector<Vec3d> vertices;
    for (const Vec3i& p : checked.solid.points)
        vertices.push_back(
            {static_cast<double>(p[0]), static_cast<double>(p[1]), static_cast<double>(p[2])});
    Progress progress;
    checked.result = decompose(checked.solid, {}, 0, {}, 0, progress);
    place_points(checked.solid, vertices, checked.result);
    return checked;
}

TEST(notch_check, cells_as_they_are_made_have_no_fault) {
    for (const testing::NamedSolid& named : testing::named_solids()) {
        Checked c = cells_of(named.solid);
        EXPECT_TRUE(find_faults(c.solid.grid, c.result).empty()) << named.name;
    }
}

TEST(notch_check, a_point_may_lie_eight_steps_off_its_planes_and_no_more) {
    for (const double way : {-1.0, 1.0}) {
        Checked c = cells_of(testing::named_solids().front().solid);
        const int point = c.result.edges[c.result.cells.front()].org;
        const double place = c.result.placed[point][0];
        c.result.placed[point][0] = place + way * 8;
        EXPECT_TRUE(find_faults(c.solid.grid, c.result).empty());
        c.result.placed[point][0] = place + way * 8.5;
        EXPECT_FALSE(find_faults(c.solid.grid, c.result).empty());
    }
}

}  // namespace
}  // namespace tetra::notch
