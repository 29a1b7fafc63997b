// SPDX-License-Identifier: LGPL-2.1-or-later
// Conforming contacts: the surface stays the same set, contacts end up on shared edges.
#include <gtest/gtest.h>

#include <set>

#include "random_solids.h"
#include "tetra/errors.h"
#include "tetra/solid/conform_contacts.h"
#include "tetra/solid/sheets.h"
#include "tetra/solid/validate.h"

namespace tetra::testing {
namespace {

TestSolid solid_of(const GridSolid& grid) { return {grid.points, grid.triangles}; }

void expect_conforming(const TestSolid& solid, int type2_edges) {
    const GridSolid result = conform_contacts(grid_solid(solid));
    EXPECT_EQ(result.points, solid.points);
    EXPECT_EQ(volume6(solid_of(result)), volume6(solid));
    EXPECT_EQ(result.triangle_source.size(), result.triangles.size());
    Progress quiet;
    EXPECT_TRUE(find_defects(result, quiet).empty());
    EXPECT_EQ(pair_half_edges(result.points, result.triangles, result.solid).type2_edges,
              type2_edges);
    EXPECT_EQ(conform_contacts(result).triangles, result.triangles);
}

// A box of 12 x 12 x 4 with a roof whose ridge points down and lies on its upper face.
TestSolid ridge_on_plate(Vec3i from, Vec3i to) {
    TestSolid roof;
    const auto plus = [](Vec3i a, Vec3i b) { return Vec3i{a[0] + b[0], a[1] + b[1], a[2] + b[2]}; };
    roof.points = {from,
                   to,
                   plus(from, {-1, 1, 6}),
                   plus(to, {-1, 1, 6}),
                   plus(from, {1, -1, 6}),
                   plus(to, {1, -1, 6})};
    roof.triangles = {{0, 1, 3}, {0, 3, 2}, {0, 5, 1}, {0, 4, 5},
                      {0, 2, 4}, {1, 5, 3}, {2, 3, 5}, {2, 5, 4}};
    for (Triangle& t : roof.triangles)
        if (volume6(roof).sign() < 0) std::swap(t[1], t[2]);
    return weld(join(map(cube(1), {{{12, 0, 0}, {0, 12, 0}, {0, 0, 4}}}), roof));
}

TEST(ConformContacts, LeavesSolidsWithoutThemAlone) {
    for (const NamedSolid& named : named_solids()) {
        const GridSolid grid = grid_solid(named.solid);
        EXPECT_EQ(conform_contacts(grid).triangles, grid.triangles) << named.name;
    }
    for (std::uint64_t seed = 0; seed < 50; ++seed) {
        const GridSolid grid = grid_solid(random_voxel_solid(seed));
        EXPECT_EQ(conform_contacts(grid).triangles, grid.triangles) << seed;
    }
}

TEST(ConformContacts, EdgeInsideAFace) {
    expect_conforming(ridge_on_plate({3, 2, 4}, {9, 10, 4}), 1);
    expect_conforming(ridge_on_plate({2, 3, 4}, {10, 8, 4}), 1);
    expect_conforming(ridge_on_plate({3, 3, 4}, {9, 9, 4}), 1);
}

TEST(ConformContacts, EdgeFromCornerIntoAFace) {
    expect_conforming(ridge_on_plate({0, 0, 4}, {7, 8, 4}), 1);
    expect_conforming(ridge_on_plate({0, 12, 4}, {5, 5, 4}), 1);
}

TEST(ConformContacts, VertexInsideAnEdge) {
    // The upper box stands with one edge on the middle of the lower one's edge.
    const TestSolid lower = map(cube(1), {{{12, 0, 0}, {0, 12, 0}, {0, 0, 4}}});
    const TestSolid upper = map(cube(1), {{{4, 0, 0}, {0, 6, 0}, {0, 0, 4}}}, {4, 12, 4});
    expect_conforming(weld(join(lower, upper)), 1);
}

TEST(ConformContacts, EdgeAcrossADiagonal) {
    TestSolid solid;  // found by tools/fuzz_cells.py: edge 2-3 lies on the face 0, 3, 6, 2
    solid.points = {{0, 0, 2}, {4, 0, 0}, {4, 1, 0}, {4, 1, 2}, {7, 2, 0}, {8, 1, 0}, {8, 2, 1}};
    solid.triangles = {{0, 2, 1}, {5, 2, 4}, {4, 6, 5}, {3, 5, 6}, {1, 2, 3},
                       {0, 1, 3}, {2, 5, 3}, {2, 0, 6}, {4, 2, 6}, {3, 6, 0}};
    expect_conforming(solid, 1);
}

TEST(ConformContacts, FacesInContactAreGlued) {
    TestSolid solid;  // found by tools/fuzz_cells.py: triangles 3, 1, 2 and 4, 2, 1 overlap
    solid.points = {{0, 0, 0}, {1, 1, 3}, {2, 0, 1}, {2, 0, 2}, {2, 0, 3}, {2, 1, 0}};
    solid.triangles = {{0, 5, 2}, {5, 3, 2}, {5, 0, 1}, {0, 4, 1},
                       {5, 1, 3}, {0, 2, 4}, {1, 2, 3}, {4, 2, 1}};
    const GridSolid result = conform_contacts(grid_solid(solid));
    EXPECT_EQ(volume6(solid_of(result)), volume6(solid));
    Progress quiet;
    EXPECT_TRUE(find_defects(result, quiet).empty());
    EXPECT_LT(result.triangles.size(), solid.triangles.size() + 2);
    EXPECT_EQ(pair_half_edges(result.points, result.triangles, result.solid).type2_edges, 0);
}

TEST(ConformContacts, CrossingEdgesAreRefused) {
    TestSolid tent;
    tent.points = {{0, -4, 0}, {8, -4, 0}, {8, 4, 0}, {0, 4, 0}, {0, 0, 4}, {8, 0, 4}};
    tent.triangles = {{0, 2, 1}, {0, 3, 2}, {0, 1, 5}, {0, 5, 4},
                      {2, 3, 4}, {2, 4, 5}, {3, 0, 4}, {1, 2, 5}};
    const TestSolid above = map(tent, {{{0, 1, 0}, {1, 0, 0}, {0, 0, -1}}}, {4, -4, 8});
    try {
        conform_contacts(grid_solid(join(tent, above)));
        FAIL() << "the ridges cross";
    } catch (const InvalidSolid& error) {
        ASSERT_EQ(error.defects.size(), 1u);
        EXPECT_EQ(error.defects[0].kind, "edge_contact");
        const std::set<int> ids(error.defects[0].vertices.begin(), error.defects[0].vertices.end());
        EXPECT_EQ(ids, (std::set<int>{4, 5, 10, 11}));
    }
}

}  // namespace
}  // namespace tetra::testing
