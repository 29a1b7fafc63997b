// SPDX-License-Identifier: LGPL-2.1-or-later
// verify_mesh() accepts a right mesh and names what is wrong with each kind of broken one.
#include "tetra/assemble/verify_mesh.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "assemble_compact_support.h"
#include "tetra/assemble/restore.h"
#include "tetra/assemble/tet_quality.h"
#include "tetra/errors.h"

namespace tetra {
namespace {

struct Case {
    std::vector<Vec3d> points, vertices;
    std::vector<std::array<int, 4>> tets;
    std::vector<Triangle> skin, triangles;
    std::vector<int> skin_source, point_source, facets, required;
};

Case two_voxels() {
    testing_support::RefinedOptions o;
    testing_support::Refined r =
        testing_support::refined_voxels(testing_support::box_voxels(2, 1, 1), o);
    r.solid.grid = {20, 0.125, {0, 0, 0}};
    Case c;
    for (const Vec3i& p : r.solid.points)
        c.vertices.push_back(unsnap(
            r.solid.grid,
            {static_cast<double>(p[0]), static_cast<double>(p[1]), static_cast<double>(p[2])}));
    Progress progress;
    const Restored restored = restore(r.mesh, r.solid, c.vertices, {}, {}, progress);
    c.points = restored.points;
    c.tets = r.mesh.tets;
    c.skin = r.mesh.skin;
    c.skin_source = r.mesh.skin_source;
    c.triangles = r.solid.triangles;
    c.facets = restored.facet_of_triangle;
    for (std::size_t v = 0; v < c.vertices.size(); ++v) c.required.push_back(static_cast<int>(v));
    for (const Carrier& carrier : r.mesh.carriers)
        c.point_source.push_back(carrier.kind == CarrierKind::vertex ? carrier.first : -1);
    return c;
}

MeshCheck check(const Case& c) {
    Progress progress;
    return verify_mesh({c.points, c.tets, {}, c.skin, c.skin_source, c.point_source},
                       {c.vertices, c.triangles, c.facets, c.required}, {}, progress);
}

void expect_failure(const Case& c, const std::string& part) {
    try {
        check(c);
        ADD_FAILURE() << "passed, though: " << part;
    } catch (const VerificationFailed& e) {
        EXPECT_NE(std::string(e.what()).find(part), std::string::npos) << e.what();
    }
}

TEST(VerifyMesh, AcceptsARightMesh) {
    const Case c = two_voxels();
    const MeshCheck r = check(c);
    EXPECT_NEAR(r.volume, 2 * 0.5 * 0.5 * 0.5, 1e-14);
    EXPECT_EQ(r.vertices_moved, 0);
    EXPECT_LT(r.volume_error, 1e-14);
    EXPECT_EQ(r.steiner_distance, 0);
}

TEST(VerifyMesh, NamesWhatIsWrong) {
    Case c = two_voxels();
    std::swap(c.tets[5][0], c.tets[5][1]);
    expect_failure(c, "is inverted");

    c = two_voxels();
    c.tets.pop_back();
    expect_failure(c, "disagree");

    c = two_voxels();
    c.tets.push_back(c.tets.front());
    expect_failure(c, "triangle");

    c = two_voxels();
    std::swap(c.skin[3][0], c.skin[3][1]);
    expect_failure(c, "disagree");

    c = two_voxels();
    c.skin.pop_back();
    c.skin_source.pop_back();
    expect_failure(c, "disagree");

    c = two_voxels();
    c.points.push_back(c.points[0]);
    c.point_source.push_back(-1);
    expect_failure(c, "equal");

    c = two_voxels();
    c.point_source[0] = -1;
    if (two_voxels().point_source[0] >= 0) expect_failure(c, "lost");

    c = two_voxels();
    for (int& s : c.skin_source) s = c.skin_source[0];
    expect_failure(c, "facet");

    c = two_voxels();
    c.vertices[0][0] -= 0.25;
    expect_failure(c, "moved");

    c = two_voxels();
    c.tets[0][2] = 1000;
    expect_failure(c, "unknown");

    c = two_voxels();
    c.points[3][1] = std::numeric_limits<double>::quiet_NaN();
    expect_failure(c, "finite");
}

TEST(TetQuality, RegularAndFlat) {
    const std::vector<Vec3d> p{{1, 1, 1},   {1, -1, -1}, {-1, 1, -1},
                               {-1, -1, 1}, {1, 1, -1},  {1, -1, 1}};
    EXPECT_NEAR(mean_ratio(p[0], p[2], p[1], p[3]), -mean_ratio(p[0], p[1], p[2], p[3]), 1e-15);
    EXPECT_NEAR(std::abs(mean_ratio(p[0], p[1], p[2], p[3])), 1, 1e-14);
    const bool positive = mean_ratio(p[0], p[1], p[2], p[3]) > 0;
    const std::vector<std::array<int, 4>> t{positive ? std::array<int, 4>{0, 1, 2, 3}
                                                     : std::array<int, 4>{0, 2, 1, 3}};
    const TetQuality q = tet_quality(p, t);
    EXPECT_NEAR(q.min_dihedral, std::acos(1.0 / 3), 1e-12);
    EXPECT_NEAR(q.max_dihedral, std::acos(1.0 / 3), 1e-12);
    EXPECT_NEAR(q.min_height, 4 / std::sqrt(3.0), 1e-12);
    EXPECT_EQ(q.histogram[9], 1);
    EXPECT_EQ(mean_ratio(p[0], p[1], p[4], p[5]), 0);
}

}  // namespace
}  // namespace tetra
