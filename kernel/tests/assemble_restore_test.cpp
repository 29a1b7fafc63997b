// SPDX-License-Identifier: LGPL-2.1-or-later
// Restoring the caller's coordinates: all moves, flips for creased quads, the peel, and its limits.
#include "tetra/assemble/restore.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "assemble_compact_support.h"
#include "tetra/assemble/compact.h"
#include "tetra/assemble/double_predicates.h"
#include "tetra/assemble/verify_mesh.h"
#include "tetra/errors.h"
#include "tetra/exact/predicates.h"

namespace tetra {
namespace {

using testing_support::random_voxels;
using testing_support::Refined;
using testing_support::refined_voxels;
using testing_support::RefinedOptions;

std::size_t at(int i) { return static_cast<std::size_t>(i); }

double noise(std::uint64_t& state) {
    state = state * 6364136223846793005u + 1442695040888963407u;
    return static_cast<double>(state >> 11) * 0x1p-53 - 0.5;
}

// Places of the grid points in the caller's unit, off by up to `steps` grid steps.
std::vector<Vec3d> disturbed(GridSolid& solid, double steps, std::uint64_t seed) {
    solid.grid = {20, 0x1p-10, {3.25, -7.5, 100}};
    std::vector<Vec3d> out;
    for (const Vec3i& p : solid.points) {
        Vec3d v = unsnap(solid.grid, {static_cast<double>(p[0]), static_cast<double>(p[1]),
                                      static_cast<double>(p[2])});
        for (double& x : v) x += 2 * steps * noise(seed) * solid.grid.step;
        out.push_back(v);
    }
    return out;
}

void expect_verified(const ExactMesh& mesh, const GridSolid& solid,
                     const std::vector<Vec3d>& vertices, const Restored& restored) {
    std::vector<int> source;
    std::vector<int> required(vertices.size());
    for (std::size_t v = 0; v < required.size(); ++v) required[v] = static_cast<int>(v);
    for (const Carrier& c : mesh.carriers)
        source.push_back(c.kind == CarrierKind::vertex ? solid.point_source[at(c.first)] : -1);
    Progress progress;
    const MeshCheck check = verify_mesh(
        {restored.points, mesh.tets, mesh.tet_solid, mesh.skin, mesh.skin_source, source},
        {vertices, solid.triangles, restored.facet_of_triangle, required},
        {1e-9, 0, solid.grid.step}, progress);
    EXPECT_EQ(check.vertices_moved, restored.stats.vertices_on_grid);
}

TEST(Restore, AllVerticesComeBackBitForBit) {
    for (std::uint64_t seed = 0; seed < 20; ++seed) {
        RefinedOptions o;
        o.parts = 2;
        o.spacing = 401;
        o.map = {{{3, 1, -2}, {-1, 4, 1}, {2, -1, 5}}};
        Refined r = refined_voxels(random_voxels(seed, 3, 50), o);
        const std::vector<Vec3d> vertices = disturbed(r.solid, 0.5, seed);
        Progress progress;
        if (seed % 2) compact(r.mesh, r.solid, {}, {}, progress);
        const Restored restored = restore(r.mesh, r.solid, vertices, {}, {}, progress);
        EXPECT_EQ(restored.stats.vertices_on_grid, 0);
        EXPECT_EQ(restored.stats.steiner_on_grid, 0);
        EXPECT_EQ(restored.stats.input_vertices, static_cast<int>(vertices.size()));
        for (std::size_t p = 0; p < r.mesh.carriers.size(); ++p)
            if (r.mesh.carriers[p].kind == CarrierKind::vertex) {
                EXPECT_EQ(restored.points[p], vertices[at(r.mesh.carriers[p].first)]);
            }
        expect_verified(r.mesh, r.solid, vertices, restored);
    }
}

// A mesh of grid points alone, its skin taken from the tetrahedra; every skin triangle is one of
// the solid's, in order.
Refined mesh_of(const std::vector<Vec3i>& points, const std::vector<std::array<int, 4>>& tets) {
    Refined r;
    r.solid.grid = {20, 0x1p-10, {0, 0, 0}};
    for (std::size_t p = 0; p < points.size(); ++p) {
        r.solid.points.push_back(points[p]);
        r.solid.point_source.push_back(static_cast<int>(p));
        r.mesh.points.push_back(hpoint(points[p]));
        r.mesh.carriers.push_back({CarrierKind::vertex, static_cast<int>(p), -1});
    }
    std::vector<Triangle> sides;
    for (std::array<int, 4> t : tets) {
        if (orient3d(points[at(t[0])], points[at(t[1])], points[at(t[2])], points[at(t[3])]) < 0)
            std::swap(t[2], t[3]);
        r.mesh.tets.push_back(t);
        r.mesh.tet_solid.push_back(0);
        for (const auto& f : {Triangle{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}})
            sides.push_back({t[at(f[0])], t[at(f[1])], t[at(f[2])]});
    }
    for (const Triangle& s : sides) {
        bool inner = false;
        for (const Triangle& o : sides)
            for (std::size_t k = 0; k < 3; ++k)
                inner = inner || (o[k] == s[0] && o[(k + 1) % 3] == s[2] && o[(k + 2) % 3] == s[1]);
        if (inner) continue;
        r.mesh.skin_source.push_back(static_cast<int>(r.solid.triangles.size()));
        r.solid.triangle_source.push_back(r.mesh.skin_source.back());
        r.solid.solid.push_back(0);
        r.mesh.skin.push_back(s);
        r.solid.triangles.push_back(s);
    }
    return r;
}

// The square 0 1 2 3 is flat for the caller; on the grid 1 and 3 lie a step lower.
const std::vector<Vec3i> kCreased{{0, 0, 1},    {1000, 0, 0},     {1000, 1000, 1},
                                  {0, 1000, 0}, {400, 600, -900}, {400, 600, 900}};

std::vector<Vec3d> flat_places(const Refined& r) {
    std::vector<Vec3d> v;
    for (const Vec3i& p : r.solid.points)
        v.push_back(
            unsnap(r.solid.grid, {static_cast<double>(p[0]), static_cast<double>(p[1]),
                                  p[2] == 1 || p[2] == 0 ? 0.5 : static_cast<double>(p[2])}));
    return v;
}

TEST(Restore, AFlatInnerTetrahedronIsFlippedAway) {
    Refined r =
        mesh_of(kCreased, {{0, 1, 2, 3}, {5, 0, 1, 2}, {5, 0, 2, 3}, {4, 0, 1, 3}, {4, 1, 2, 3}});
    ASSERT_EQ(testing_support::flaw_of(r.mesh, r.solid), "");
    const std::vector<Vec3d> vertices = flat_places(r);
    Progress progress;
    const Restored restored = restore(r.mesh, r.solid, vertices, {}, {}, progress);
    EXPECT_EQ(restored.stats.vertices_on_grid, 0);
    EXPECT_EQ(restored.stats.slivers, 0);
    EXPECT_GT(restored.stats.flips, 0);
    EXPECT_EQ(restored.stats.peeled, 0);
    expect_verified(r.mesh, r.solid, vertices, restored);
}

// Under the square eight tetrahedra fan round the edge 1-3: too many for an edge flip.
Refined square_on_fan() {
    std::vector<Vec3i> points(kCreased.begin(), kCreased.begin() + 4);
    std::vector<std::array<int, 4>> tets{{0, 1, 2, 3}};
    int last = 0;
    for (int k = 1; k <= 7; ++k) {
        const double angle = k * std::acos(-1.0) / 8;
        const auto along = static_cast<std::int64_t>(500 - 500 * std::cos(angle));
        points.push_back({along, along, static_cast<std::int64_t>(-700 * std::sin(angle))});
        tets.push_back({1, 3, last, k + 3});
        last = k + 3;
    }
    tets.push_back({1, 3, last, 2});
    return mesh_of(points, tets);
}

TEST(Restore, AFlatSkinTetrahedronOfOneFaceIsPeeled) {
    Refined r = square_on_fan();
    ASSERT_EQ(testing_support::flaw_of(r.mesh, r.solid), "");
    const std::vector<Vec3d> vertices = flat_places(r);
    Progress progress;
    const Restored restored = restore(r.mesh, r.solid, vertices, {}, {}, progress);
    EXPECT_EQ(restored.stats.vertices_on_grid, 0);
    EXPECT_EQ(restored.stats.peeled, 1);
    EXPECT_EQ(r.mesh.tets.size(), 8u);
    expect_verified(r.mesh, r.solid, vertices, restored);
}

TEST(Restore, BetweenTwoFacesNothingIsPeeled) {
    Refined r = square_on_fan();
    std::vector<int> faces;
    for (std::size_t k = 0; k < r.solid.triangles.size(); ++k) faces.push_back(static_cast<int>(k));
    const std::vector<Vec3d> vertices = flat_places(r);
    Progress progress;
    const Restored restored = restore(r.mesh, r.solid, vertices, faces, {}, progress);
    EXPECT_EQ(restored.stats.peeled, 0);
    EXPECT_EQ(restored.stats.vertices_on_grid, 0);
    EXPECT_GT(restored.stats.walks, 0);
    EXPECT_EQ(r.mesh.skin.size(), r.solid.triangles.size());
    for (std::size_t k = 0; k < r.mesh.skin.size(); ++k) {
        std::set<int> corners(r.mesh.skin[k].begin(), r.mesh.skin[k].end());
        const Triangle& source = r.solid.triangles[at(r.mesh.skin_source[k])];
        EXPECT_EQ(corners, std::set<int>(source.begin(), source.end()));
    }
    expect_verified(r.mesh, r.solid, vertices, restored);
}

TEST(Restore, QualityFlipsRaiseTheWorst) {
    // Three long tetrahedra round the edge 5-4 that two better ones can replace.
    Refined r = mesh_of({{0, 0, 0}, {100, 0, 0}, {40, 80, 0}, {46, 30, 4}, {46, 30, -4}},
                        {{3, 4, 0, 1}, {3, 4, 1, 2}, {3, 4, 2, 0}});
    const std::vector<Vec3d> vertices = disturbed(r.solid, 0, 1);
    RestoreOptions options;
    options.quality_below = 0.5;
    Progress progress;
    const Restored restored = restore(r.mesh, r.solid, vertices, {}, options, progress);
    EXPECT_EQ(restored.stats.vertices_on_grid, 0);
    expect_verified(r.mesh, r.solid, vertices, restored);
}

}  // namespace
}  // namespace tetra
