// SPDX-License-Identifier: LGPL-2.1-or-later
// Cells from fences are convex, closed and fill the solid once.
#include "tetra/fence/cells_from_fences.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>
#include <span>

#include "random_solids.h"

namespace tetra::testing {
namespace {

using Mod = std::uint64_t;

Mod minus(Mod a, Mod b) { return (a + kHashPrime - b) % kHashPrime; }

Mod det(const std::array<Mod, 3>& a, const std::array<Mod, 3>& b, const std::array<Mod, 3>& c) {
    Mod sum = 0;
    for (std::size_t k = 0; k < 3; ++k) {
        const std::size_t u = (k + 1) % 3, v = (k + 2) % 3;
        sum =
            (sum + multiply_mod(a[k], minus(multiply_mod(b[u], c[v]), multiply_mod(b[v], c[u])))) %
            kHashPrime;
    }
    return sum;
}

FenceInput fence_input(const TestSolid& solid) {
    FenceInput input;
    input.points = solid.points;
    input.triangles = solid.triangles;
    return input;
}

std::span<const int> facet(const FenceCells& cells, std::int64_t f) {
    const auto k = static_cast<std::size_t>(f);
    return {cells.facet_points.data() + cells.facet_offsets[k],
            static_cast<std::size_t>(cells.facet_offsets[k + 1] - cells.facet_offsets[k])};
}

// Empty when the cell is closed, has one facet per plane and lies inside all its planes.
std::string cell_fault(const FenceCells& cells, std::size_t cell) {
    std::map<std::pair<int, int>, int> sides;
    std::set<int> points;
    const std::int64_t first = cells.cell_offsets[cell], last = cells.cell_offsets[cell + 1];
    for (std::int64_t f = first; f < last; ++f) {
        const auto cycle = facet(cells, f);
        if (cycle.size() < 3) return "a facet of two points";
        for (std::size_t i = 0; i < cycle.size(); ++i) {
            ++sides[{cycle[i], cycle[(i + 1) % cycle.size()]}];
            points.insert(cycle[i]);
        }
        for (std::int64_t g = first; g < f; ++g)
            if (cells.facet_planes[static_cast<std::size_t>(f)] ==
                cells.facet_planes[static_cast<std::size_t>(g)])
                return "two facets in one plane";
    }
    for (const auto& [side, count] : sides)
        if (count != 1 || !sides.contains({side.second, side.first})) return "not closed";
    if (static_cast<long>(points.size()) - static_cast<long>(sides.size() / 2) + (last - first) !=
        2)
        return "not a sphere";
    for (std::int64_t f = first; f < last; ++f) {
        std::size_t on = 0;
        for (const int p : points) {
            const int side = side_of_plane(cells.facet_planes[static_cast<std::size_t>(f)],
                                           cells.points[static_cast<std::size_t>(p)]);
            if (side > 0) return "not convex";
            on += side == 0;
        }
        if (on != facet(cells, f).size()) return "corners in a plane that are not in its facet";
    }
    return {};
}

FenceCells checked(const TestSolid& solid) {
    Progress progress;
    FenceCells cells = cells_from_fences(fence_input(solid), progress);
    std::vector<std::array<Mod, 3>> residue;
    for (const HPoint& p : cells.points) residue.push_back(residues(p));
    Mod volume = 0;
    for (std::size_t c = 0; c + 1 < cells.cell_offsets.size(); ++c) {
        const std::string fault = cell_fault(cells, c);
        EXPECT_EQ(fault, "") << "cell " << c;
        if (!fault.empty()) return cells;
        for (std::int64_t f = cells.cell_offsets[c]; f < cells.cell_offsets[c + 1]; ++f) {
            const auto cycle = facet(cells, f);
            for (std::size_t i = 2; i < cycle.size(); ++i)
                volume = (volume + det(residue[static_cast<std::size_t>(cycle[0])],
                                       residue[static_cast<std::size_t>(cycle[i - 1])],
                                       residue[static_cast<std::size_t>(cycle[i])])) %
                         kHashPrime;
        }
    }
    EXPECT_EQ(volume, volume6(solid).mod(kHashPrime));
    auto sorted = residue;
    std::sort(sorted.begin(), sorted.end());
    EXPECT_EQ(std::adjacent_find(sorted.begin(), sorted.end()), sorted.end());
    return cells;
}

std::size_t count(const FenceCells& cells) { return cells.cell_solid.size(); }

TEST(CellsFromFences, ConvexSolidSeenAlongAnExtrusionIsOneCell) {
    EXPECT_EQ(count(checked(cube())), 1u);
}

TEST(CellsFromFences, NamedSolids) {
    for (const NamedSolid& named : named_solids()) {
        SCOPED_TRACE(named.name);
        checked(named.solid);
        checked(map(named.solid, {{{0, 1, 0}, {0, 0, 1}, {1, 0, 0}}}));
        checked(map(named.solid, {{{5, 1, -2}, {-1, 4, 3}, {2, -3, 6}}}));
    }
}

// One chord per reflex corner of the plan: a plate with square holes in a row.
TEST(CellsFromFences, PlateWithHoles) {
    const FenceCells cells = checked(plate_with_holes(1, 2));
    EXPECT_EQ(cells.bases, 1);
    EXPECT_LE(count(cells), 8u);
}

TEST(CellsFromFences, RandomVoxelSolids) {
    for (std::uint64_t seed = 0; seed < 200; ++seed) {
        SCOPED_TRACE(seed);
        VoxelOptions options;
        options.cavities = seed % 5 == 0;
        checked(random_voxel_solid(seed, options));
    }
}

TEST(CellsFromFences, VertexStandingOnAFacet) {
    for (std::uint64_t seed = 0; seed < 20; ++seed) {
        SCOPED_TRACE(seed);
        checked(random_type1_solid(seed));
    }
}

}  // namespace
}  // namespace tetra::testing
