// SPDX-License-Identifier: LGPL-2.1-or-later
// A point put into a cavity leaves an exact mesh of the same solid and loses no vertex.
#include <gtest/gtest.h>

#include "../src/assemble/insert_point.h"
#include "assemble_compact_support.h"

namespace tetra {
namespace {

using testing_support::flaw_of;
using testing_support::random_voxels;
using testing_support::Refined;
using testing_support::refined_voxels;

std::size_t vertices_of(const ExactMesh& mesh) {
    std::size_t count = 0;
    for (const Carrier& c : mesh.carriers) count += c.kind == CarrierKind::vertex;
    return count;
}

TEST(InsertPoint, AnyTetrahedronCanBeReplaced) {
    for (std::uint64_t seed = 0; seed < 6; ++seed) {
        const Refined r = refined_voxels(random_voxels(seed, 3, 50), {.parts = 1});
        ASSERT_EQ(flaw_of(r.mesh, r.solid), "");
        Rng rng{seed};
        for (int t = 0; t < static_cast<int>(r.mesh.tets.size()); t += 7) {
            TetComplex complex(r.mesh, r.solid.grid, facet_classes(r.solid, {}));
            const Tet gone = complex.tet(t);
            const Insertion done = insert_point(complex, {t}, rng, [](const Tet&) { return true; });
            ASSERT_GE(done.point, 0);
            EXPECT_TRUE(done.vanished.empty());
            ExactMesh mesh = r.mesh;
            complex.write_back(mesh, nullptr);
            EXPECT_EQ(flaw_of(mesh, r.solid), "");
            EXPECT_EQ(vertices_of(mesh), vertices_of(r.mesh));
            for (int k = 0; k < complex.id_count(); ++k) {
                EXPECT_FALSE(complex.alive(k) && complex.tet(k) == gone);
            }
        }
    }
}

TEST(InsertPoint, NothingChangesWhereNoConeIsSound) {
    const Refined r = refined_voxels(testing_support::box_voxels(2, 1, 1), {.parts = 1});
    TetComplex complex(r.mesh, r.solid.grid, facet_classes(r.solid, {}));
    const int points = complex.point_count(), ids = complex.id_count();
    Rng rng;
    EXPECT_LT(insert_point(complex, {0}, rng, [](const Tet&) { return false; }).point, 0);
    EXPECT_EQ(complex.point_count(), points);
    EXPECT_EQ(complex.id_count(), ids);
}

}  // namespace
}  // namespace tetra
