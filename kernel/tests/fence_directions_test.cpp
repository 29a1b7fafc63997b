// SPDX-License-Identifier: LGPL-2.1-or-later
// Directions are laid on z exactly, and the one along which a solid is prismatic wins.
#include "tetra/fence/directions.h"

#include <gtest/gtest.h>

#include <stdexcept>

#include "fence_check.h"
#include "random_solids.h"
#include "tetra/errors.h"

namespace tetra::testing {
namespace {

using Rows = std::array<Vec3i, 3>;

Rows product(const Rows& a, const Rows& b) {
    Rows r{};
    for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t j = 0; j < 3; ++j)
            for (std::size_t k = 0; k < 3; ++k) r[i][j] += a[i][k] * b[k][j];
    return r;
}

constexpr Rows kIdentity{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};

void expect_unimodular(const FenceDirection& d) {
    EXPECT_EQ(product(d.matrix, d.inverse), kIdentity) << d.name;
    EXPECT_EQ(product(d.inverse, d.matrix), kIdentity) << d.name;
    for (std::size_t k = 0; k < 3; ++k) {
        std::int64_t image = 0, growth = 0;
        for (std::size_t c = 0; c < 3; ++c) {
            image += d.matrix[k][c] * d.direction[c];
            growth += std::abs(d.matrix[k][c]);
        }
        EXPECT_EQ(image, k == 2 ? 1 : 0) << d.name;
        EXPECT_LE(growth, d.growth) << d.name;
    }
    const auto& m = d.matrix;
    EXPECT_EQ(m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) -
                  m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0]) +
                  m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0]),
              1);
}

TEST(FenceDirections, EveryDirectionIsLaidOnZ) {
    for (std::int64_t x = -7; x <= 7; ++x)
        for (std::int64_t y = -7; y <= 7; ++y)
            for (std::int64_t z = -7; z <= 7; ++z) {
                if (x == 0 && y == 0 && z == 0) continue;
                const FenceDirection d = lay_on_z({x, y, z});
                expect_unimodular(d);
                EXPECT_LE(d.growth, 16) << d.name;
            }
    EXPECT_THROW(lay_on_z({0, 0, 0}), std::invalid_argument);
}

TEST(FenceDirections, NearestIntegers) {
    EXPECT_EQ(nearest_integer_direction({0, 0, 2.5}, 7), (Vec3i{0, 0, 1}));
    EXPECT_EQ(nearest_integer_direction({-1, 1, 1e-6}, 7), (Vec3i{-1, 1, 0}));
    EXPECT_EQ(nearest_integer_direction({3, 5, 0.01}, 7), (Vec3i{3, 5, 0}));
    EXPECT_THROW(nearest_integer_direction({0, 0, 0}, 7), std::invalid_argument);
}

// A plate whose holes run obliquely: only that direction shows it without crossings.
TEST(FenceDirections, ObliquePrismIsFound) {
    const TestSolid plate =
        map(plate_with_holes(2, 2), {{{1, 0, 2}, {0, 1, 1}, {0, 0, 1}}}, {0, 0, 0});
    Progress progress;
    DirectionOptions options;
    options.good = 0;  // rate them all
    const auto list = fence_directions(plate.points, plate.triangles, {}, options, progress);
    EXPECT_EQ(list.front().direction, (Vec3i{2, 1, 1}));
    for (const FenceDirection& d : list) {
        SCOPED_TRACE(d.name);
        expect_unimodular(d);
        FenceInput input;
        input.points = map(plate, {d.matrix[0], d.matrix[1], d.matrix[2]}).points;
        input.triangles = plate.triangles;
        const FenceResult result = fence_off(input, progress);
        EXPECT_EQ(fence_fault(input, result), "");
        EXPECT_GT(d.cost, 0);
        if (&d == &list.front()) {
            EXPECT_EQ(result.counts.steiner_points, 0);
        }
    }
}

TEST(FenceDirections, CheapAxisEndsTheSearch) {
    const TestSolid plate = plate_with_holes(2, 2);
    Progress progress;
    const auto list = fence_directions(plate.points, plate.triangles, {}, {}, progress);
    EXPECT_EQ(list.front().note, "axis");
    EXPECT_LE(list.front().cost, 2 * static_cast<double>(plate.triangles.size()));
    for (const FenceDirection& d : list) EXPECT_EQ(d.cost > 0, &d == &list.front()) << d.name;
}

TEST(FenceDirections, InvalidSolidIsTold) {
    const TestSolid crossing = join(cube(8), map(cube(8), kIdentity, {3, 3, 3}));
    Progress progress;
    EXPECT_THROW(fence_directions(crossing.points, crossing.triangles, {}, {}, progress),
                 InvalidSolid);
}

}  // namespace
}  // namespace tetra::testing
