// SPDX-License-Identifier: LGPL-2.1-or-later
// Overlaid convex cells become an exact conforming mesh, before and after compaction.
#include "../src/assemble/cell_tets.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "fence_check.h"
#include "random_solids.h"
#include "tetra/errors.h"
#include "tetra/fence/pull_off.h"

namespace tetra::testing {
namespace {

struct Raw {
    ExactMesh mesh;
    CellTetCounts counts;
};

Raw raw_mesh(const TestSolid& solid, const std::vector<int>& faces = {}, bool merge = true) {
    Progress progress;
    GridSolid grid = grid_solid(solid);
    grid.grid.bits = 26;
    const std::vector<int> owners = facet_owners(grid.points, grid.triangles, faces, {});
    CellsStats stats;
    CellsOptions options;
    options.merge = merge;
    const Polyhedra cells = exact_cells(grid, options, stats, progress);
    Raw raw;
    raw.mesh = tets_of_cells(grid, owners, {cells}, {0}, raw.counts, progress);
    return raw;
}

// Positive, face to face, exact volume and skin, carriers, every input point: judged as fences are.
std::string fault_of(const TestSolid& solid, const Raw& raw) {
    FenceInput input;
    input.points = solid.points;
    input.triangles = solid.triangles;
    input.owner.assign(solid.triangles.size(), 0);
    FenceResult result;
    result.mesh = raw.mesh;
    for (std::size_t p = 0; p < raw.mesh.points.size(); ++p) {
        Carrier& c = result.mesh.carriers[p];
        result.point_source.push_back(c.kind == CarrierKind::vertex ? c.first : -1);
        if (c.kind != CarrierKind::facet) continue;
        // Any triangle of the facet will do here; the judge wants the very one.
        const Triangle& t = solid.triangles[static_cast<std::size_t>(c.first)];
        const auto at = [&](int v) { return solid.points[static_cast<std::size_t>(v)]; };
        if (side_of_plane(plane_through(at(t[0]), at(t[1]), at(t[2])), raw.mesh.points[p]) != 0)
            return "point off its facet";
        c = {};
    }
    return fence_fault(input, result);
}

void check(const TestSolid& solid) {
    EXPECT_EQ(fault_of(solid, raw_mesh(solid)), "");
    EXPECT_EQ(fault_of(solid, raw_mesh(solid, {}, false)), "");
}

TEST(CellTets, NamedSolids) {
    for (const NamedSolid& named : named_solids()) {
        SCOPED_TRACE(named.name);
        check(named.solid);
        check(map(named.solid, {{{5, 1, -2}, {-1, 4, 3}, {2, -3, 6}}}));
    }
}

TEST(CellTets, RandomSolids) {
    for (std::uint64_t seed = 0; seed < 80; ++seed) {
        SCOPED_TRACE(seed);
        check(small_random_solid(seed));
    }
}

TEST(CellTets, ConvexSolidsAreConesFromAVertex) {
    for (const TestSolid& solid : {cube(), octahedron(), random_convex_solid(3, 40)}) {
        const Raw raw = raw_mesh(solid);
        EXPECT_EQ(raw.counts.cells, 1);
        EXPECT_EQ(raw.counts.cone_cells, 0);
        EXPECT_EQ(raw.mesh.points.size(), solid.points.size());
        EXPECT_LE(raw.mesh.tets.size(), solid.triangles.size() - 3);
    }
}

// Borders of faces inside one plane are edges of the skin, cut where cells end.
TEST(CellTets, FacesKeepTheirBorders) {
    const TestSolid solid = plate_with_holes(2, 3);
    std::vector<int> faces;
    for (std::size_t t = 0; t < solid.triangles.size(); ++t) faces.push_back(static_cast<int>(t));
    const Raw raw = raw_mesh(solid, faces);
    EXPECT_EQ(fault_of(solid, raw), "");
    std::vector<int> sources = raw.mesh.skin_source;
    std::sort(sources.begin(), sources.end());
    sources.erase(std::unique(sources.begin(), sources.end()), sources.end());
    EXPECT_EQ(sources.size(), solid.triangles.size());
}

// Two cubes of different size, one standing on the other: the contact has one triangulation.
TEST(CellTets, SolidsInContactShareTriangles) {
    TestSolid small = cube(2);
    for (Vec3i& p : small.points) {
        p[0] += 1;
        p[2] += 4;
    }
    const TestSolid both = weld(join(cube(4), small));
    GridSolid grid = grid_solid(both);
    grid.grid.bits = 26;
    for (std::size_t t = 12; t < grid.solid.size(); ++t) grid.solid[t] = 1;
    Progress progress;
    const std::vector<int> owners = facet_owners(grid.points, grid.triangles, {}, grid.solid);
    std::vector<Polyhedra> cells;
    for (const int s : {0, 1}) {
        GridSolid part = grid;
        part.triangles.assign(grid.triangles.begin() + 12 * s,
                              grid.triangles.begin() + 12 * (s + 1));
        part.triangle_source.resize(12);
        part.solid.assign(12, s);
        CellsStats stats;
        cells.push_back(exact_cells(part, {}, stats, progress));
    }
    CellTetCounts counts;
    const ExactMesh mesh = tets_of_cells(grid, owners, cells, {0, 1}, counts, progress);
    std::vector<Triangle> skin = mesh.skin;
    int shared = 0;
    for (Triangle& t : skin) std::sort(t.begin(), t.end());
    std::sort(skin.begin(), skin.end());
    for (std::size_t i = 1; i < skin.size(); ++i) shared += skin[i] == skin[i - 1];
    EXPECT_EQ(shared, 2) << "the small cube's bottom";
}

TEST(CellTets, CancelsWhenAsked) {
    Progress stop([](const std::string&, double) { return false; });
    GridSolid grid = grid_solid(chazelle(4));
    CellsStats stats;
    EXPECT_THROW(exact_cells(grid, {}, stats, stop), Cancelled);
}

}  // namespace
}  // namespace tetra::testing
