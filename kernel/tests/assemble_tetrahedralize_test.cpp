// SPDX-License-Identifier: LGPL-2.1-or-later
// The whole way: every solid comes back verified, with the caller's vertices bit for bit.
#include "tetra/assemble/tetrahedralize.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "pull_off_support.h"
#include "tetra/errors.h"

namespace tetra::testing {
namespace {

// The solid in the caller's units, turned by an odd angle about an odd axis when asked.
TetInput input_of(const TestSolid& solid, bool turned = false) {
    TetInput input;
    const double c = std::cos(0.7), s = std::sin(0.7), d = std::cos(0.3), e = std::sin(0.3);
    for (const Vec3i& p : solid.points) {
        const double x = 0.37 * static_cast<double>(p[0]) + 11,
                     y = 0.37 * static_cast<double>(p[1]), z = 0.37 * static_cast<double>(p[2]) - 5;
        const double u = c * x - s * y, v = s * x + c * y;
        input.vertices.push_back(turned ? Vec3d{u, d * v - e * z, e * v + d * z} : Vec3d{x, y, z});
    }
    input.triangles = solid.triangles;
    return input;
}

TetResult run(const TetInput& input, const TetOptions& options = {}) {
    Progress progress;
    return tetrahedralize(input, options, progress);
}

// Every vertex is there; returns how many are not bit for bit where the caller has them. Those are
// within a grid step, and the report counts them.
int moved_vertices(const TetInput& input, const TetResult& result) {
    std::vector<char> seen(input.vertices.size(), 0);
    int moved = 0;
    for (std::size_t p = 0; p < result.points.size(); ++p) {
        const int v = result.point_source[p];
        if (v < 0) continue;
        seen[static_cast<std::size_t>(v)] = 1;
        const Vec3d& wanted = input.vertices[static_cast<std::size_t>(v)];
        moved += result.points[p] != wanted;
        for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(result.points[p][k], wanted[k], 1e-3);
    }
    for (const Triangle& t : input.triangles)
        for (const int v : t) EXPECT_TRUE(seen[static_cast<std::size_t>(v)]);
    int told = 0;
    for (const SolidReport& solid : result.report.solids) told += solid.restore.vertices_on_grid;
    EXPECT_EQ(moved, told);
    return moved;
}

void expect_all_vertices(const TetInput& input, const TetResult& result) {
    EXPECT_EQ(moved_vertices(input, result), 0);
}

int steiner_points(const TetResult& result) {
    return static_cast<int>(std::count(result.point_source.begin(), result.point_source.end(), -1));
}

TEST(Tetrahedralize, NamedSolids) {
    for (const NamedSolid& named : named_solids())
        for (const bool turned : {false, true}) {
            SCOPED_TRACE(named.name);
            const TetInput input = input_of(named.solid, turned);
            expect_all_vertices(input, run(input));
        }
}

TEST(Tetrahedralize, EveryOptionGivesAVerifiedMesh) {
    for (const TestSolid& solid : {schoenhardt(), plate_with_holes(2, 3), chazelle(3)}) {
        const TetInput input = input_of(solid);
        for (const PullPolicy pull : {PullPolicy::automatic, PullPolicy::on, PullPolicy::off})
            for (const CompactLevel level :
                 {CompactLevel::none, CompactLevel::standard, CompactLevel::max}) {
                TetOptions options;
                options.pull_off = pull;
                options.compact.level = level;
                expect_all_vertices(input, run(input, options));
            }
        for (const Vec3d direction : {Vec3d{1, 0, 0}, Vec3d{0, 1, 0}, Vec3d{0, 0, 1},
                                      Vec3d{1, 1, 0}, Vec3d{0.3, -0.2, 0.9}}) {
            TetOptions options;
            options.direction = direction;
            expect_all_vertices(input, run(input, options));
        }
        TetOptions options;
        options.grid_bits = 24;
        options.quality = true;
        expect_all_vertices(input, run(input, options));
    }
}

TEST(Tetrahedralize, ConvexSolidsNeedNoSteinerPoint) {
    for (const TestSolid& solid :
         {cube(), prism(100, 500000, 300000), hull_of(random_sphere_points(2, 300, 500000))}) {
        const TetInput input = input_of(solid);
        const TetResult result = run(input);
        EXPECT_EQ(steiner_points(result), 0);
        EXPECT_LE(result.tets.size(), 3 * input.vertices.size());
        EXPECT_EQ(result.report.solids.front().pulled, "all");
    }
}

TEST(Tetrahedralize, FewTetrahedraInGeneralPosition) {
    // PULLOFF: a hull of 150 points with one dented vertex, 458 combined, 3711 by fences alone.
    const TestSolid solid = dented(hull_of(random_sphere_points(3, 150, 500000)), 17, 4);
    TetOptions raw;
    raw.compact.level = CompactLevel::none;
    EXPECT_LE(run(input_of(solid), raw).tets.size(), 700u);
    raw.pull_off = PullPolicy::off;
    EXPECT_GE(run(input_of(solid), raw).tets.size(), 1400u);
}

TEST(Tetrahedralize, FacesKeepTheirEdge) {
    // A cube whose top carries two faces: the skin edge between them has to stay.
    TetInput input = input_of(cube());
    for (std::size_t t = 0; t < input.triangles.size(); ++t)
        input.face.push_back(static_cast<int>(t));
    const TetResult result = run(input);
    ASSERT_EQ(result.skin.size(), 12u);
    std::vector<int> sources = result.skin_source;
    std::sort(sources.begin(), sources.end());
    EXPECT_EQ(std::unique(sources.begin(), sources.end()), sources.end());
}

TEST(Tetrahedralize, SkinNamesTheTriangleUnderIt) {
    const TetInput input = input_of(gridded_cube(8, 16));
    const TetResult result = run(input);
    for (std::size_t s = 0; s < result.skin.size(); ++s) {
        Vec3d middle{0, 0, 0};
        for (const int p : result.skin[s])
            for (std::size_t k = 0; k < 3; ++k)
                middle[k] += result.points[static_cast<std::size_t>(p)][k] / 3;
        const Triangle& t = input.triangles[static_cast<std::size_t>(result.skin_source[s])];
        for (std::size_t k = 0; k < 3; ++k) {
            double lo = 1e9, hi = -1e9;
            for (const int v : t) {
                lo = std::min(lo, input.vertices[static_cast<std::size_t>(v)][k]);
                hi = std::max(hi, input.vertices[static_cast<std::size_t>(v)][k]);
            }
            EXPECT_GE(middle[k], lo - 1e-9);
            EXPECT_LE(middle[k], hi + 1e-9);
        }
    }
}

TEST(Tetrahedralize, SolidsShareNodes) {
    // Two cubes side by side, each with vertices of its own.
    TestSolid second = cube();
    for (Vec3i& p : second.points) p[0] += 4;
    TetInput input = input_of(join(cube(), second));
    for (std::size_t t = 0; t < input.triangles.size(); ++t)
        input.solid.push_back(t < input.triangles.size() / 2 ? 7 : 9);
    const TetResult result = run(input);
    EXPECT_EQ(result.points.size(), 12u);
    EXPECT_EQ(result.report.shared_points, 4);
    EXPECT_EQ(std::count(result.tet_solid.begin(), result.tet_solid.end(), 7) +
                  std::count(result.tet_solid.begin(), result.tet_solid.end(), 9),
              static_cast<std::ptrdiff_t>(result.tets.size()));
}

TEST(Tetrahedralize, RandomSolids) {
    int moved = 0;
    for (std::uint64_t seed = 0; seed < 60; ++seed) {
        SCOPED_TRACE(seed);
        VoxelOptions voxels;
        voxels.cavities = seed % 5 == 0;
        const TetInput input = input_of(random_voxel_solid(seed, voxels), seed % 2 == 1);
        moved += moved_vertices(input, run(input));
    }
    // Planes of the caller that the grid creased the other way can hold single vertices back.
    EXPECT_LE(moved, 3);
}

TEST(Tetrahedralize, EqualInputGivesEqualOutput) {
    const TetInput input = input_of(chazelle(3), true);
    const TetResult a = run(input), b = run(input);
    EXPECT_EQ(a.points, b.points);
    EXPECT_EQ(a.tets, b.tets);
    EXPECT_EQ(a.skin_source, b.skin_source);
}

TEST(Tetrahedralize, RefusesWhatIsNoSolid) {
    TetInput input = input_of(cube());
    input.triangles.pop_back();
    EXPECT_THROW(run(input), InvalidSolid);
    EXPECT_THROW(run({}), InvalidSolid);
    input = input_of(cube());
    input.triangles[0][0] = 99;
    EXPECT_THROW(run(input), InvalidSolid);
}

TEST(Tetrahedralize, StopsWhenAsked) {
    Progress progress([](const std::string&, double) { return false; });
    EXPECT_THROW(tetrahedralize(input_of(chazelle(8)), {}, progress), Cancelled);
}

}  // namespace
}  // namespace tetra::testing
