// SPDX-License-Identifier: LGPL-2.1-or-later
// Merged fence cells are convex, fill their solid and are as few as they should be.
#include "tetra/assemble/cells_of_fences.h"

#include <gtest/gtest.h>

#include <map>

#include "random_solids.h"

namespace tetra::testing {
namespace {

using Mod = std::uint64_t;
using Residue = std::array<Mod, 3>;

struct Run {
    GridSolid grid;
    std::vector<Vec3d> vertices;
    FencedCells fenced;
};

Run run(const TestSolid& solid, bool merge = true) {
    Run r;
    r.grid = grid_solid(solid);
    r.grid.grid.bits = 26;
    for (const Vec3i& p : r.grid.points)
        r.vertices.push_back(
            {static_cast<double>(p[0]), static_cast<double>(p[1]), static_cast<double>(p[2])});
    Progress progress;
    r.fenced = *cells_of_fences(r.grid, r.vertices, merge, std::nullopt, progress);
    return r;
}

std::size_t count(const TestSolid& solid) { return run(solid).fenced.cells.cell_solid.size(); }

Mod minus(Mod a, Mod b) { return (a + kHashPrime - b) % kHashPrime; }

Mod det(const Residue& a, const Residue& b, const Residue& c) {
    Mod sum = 0;
    for (std::size_t k = 0; k < 3; ++k) {
        const std::size_t u = (k + 1) % 3, v = (k + 2) % 3;
        const Mod minor = minus(multiply_mod(b[u], c[v]), multiply_mod(b[v], c[u]));
        sum = (sum + multiply_mod(a[k], minor)) % kHashPrime;
    }
    return sum;
}

// A cell is closed when every directed side has its reverse; its facets' points as one cycle each.
bool closed(const ConvexCells& cells, std::size_t cell) {
    std::map<std::pair<int, int>, int> sides;
    for (auto f = static_cast<std::size_t>(cells.cell_offsets[cell]);
         f < static_cast<std::size_t>(cells.cell_offsets[cell + 1]); ++f) {
        const auto first = static_cast<std::size_t>(cells.facet_offsets[f]);
        const auto last = static_cast<std::size_t>(cells.facet_offsets[f + 1]);
        for (std::size_t i = first; i < last; ++i)
            ++sides[{cells.facet_vertices[i], cells.facet_vertices[i + 1 < last ? i + 1 : first]}];
    }
    for (const auto& [side, n] : sides)
        if (n != 1 || !sides.contains({side.second, side.first})) return false;
    return true;
}

// Convexity is proved inside; here the volume modulo a prime, closedness and the input points.
void check(const TestSolid& solid) {
    const Run r = run(solid);
    const ConvexCells& cells = r.fenced.cells;
    std::vector<Residue> residue;
    for (const HPoint& p : cells.exact) residue.push_back(residues(p));
    Mod volume = 0;
    for (std::size_t f = 0; f + 1 < cells.facet_offsets.size(); ++f) {
        const auto first = static_cast<std::size_t>(cells.facet_offsets[f]);
        const auto last = static_cast<std::size_t>(cells.facet_offsets[f + 1]);
        const auto at = [&](std::size_t i) {
            return residue[static_cast<std::size_t>(cells.facet_vertices[i])];
        };
        for (std::size_t i = first + 2; i < last; ++i)
            volume = (volume + det(at(first), at(i - 1), at(i))) % kHashPrime;
    }
    EXPECT_EQ(volume, volume6(solid).mod(kHashPrime));
    for (std::size_t c = 0; c < cells.cell_solid.size(); ++c) EXPECT_TRUE(closed(cells, c)) << c;
    for (std::size_t p = 0; p < cells.points.size(); ++p) {
        const int v = cells.point_source[p];
        if (v < 0) continue;
        EXPECT_EQ(cells.points[p], r.vertices[static_cast<std::size_t>(v)]);
    }
}

TEST(CellsOfFences, NamedSolids) {
    for (const NamedSolid& named : named_solids()) {
        SCOPED_TRACE(named.name);
        check(named.solid);
        check(map(named.solid, {{{5, 1, -2}, {-1, 4, 3}, {2, -3, 6}}}));
    }
}

TEST(CellsOfFences, RandomSolids) {
    for (std::uint64_t seed = 0; seed < 60; ++seed) {
        SCOPED_TRACE(seed);
        check(small_random_solid(seed));
    }
}

// Fences cut a convex solid along its edges; merging has to undo all of it.
TEST(CellsOfFences, ConvexSolids) {
    EXPECT_EQ(count(cube()), 1u);
    EXPECT_EQ(count(octahedron()), 1u);
}

TEST(CellsOfFences, MergingOnlyRemovesCells) {
    for (std::uint64_t seed = 0; seed < 20; ++seed) {
        const TestSolid solid = random_convex_solid(seed, 12);
        EXPECT_LE(count(solid), run(solid, false).fenced.cells.cell_solid.size());
    }
}

TEST(CellsOfFences, CancelsWhenAsked) {
    Progress stop([](const std::string&, double) { return false; });
    const GridSolid grid = grid_solid(chazelle(4));
    const std::vector<Vec3d> vertices(grid.points.size(), Vec3d{0, 0, 0});
    EXPECT_THROW(cells_of_fences(grid, vertices, true, std::nullopt, stop), Cancelled);
}

}  // namespace
}  // namespace tetra::testing
