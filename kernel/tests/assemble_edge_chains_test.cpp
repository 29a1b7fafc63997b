// SPDX-License-Identifier: LGPL-2.1-or-later
// Points on a common edge come in order, whichever part of it and whichever way they are asked for.
#include "../src/assemble/edge_chains.h"

#include <gtest/gtest.h>

namespace tetra::testing {
namespace {

using Ids = std::vector<int>;

// 0 1 3 5 4 2 9 lie on one line in this order.
const std::vector<Vec3d> kPoints{{0, 0, 0}, {1, 0, 0}, {7, 0, 0}, {4, 0, 0}, {6, 0, 0},
                                 {5, 0, 0}, {0, 3, 0}, {5, 1, 0}, {4, 2, 0}, {9, 0, 0}};

TEST(EdgeChains, PointsOfPartsJoinTheWholeEdge) {
    EdgeChains chains;
    EXPECT_TRUE(chains.add(9, 0, 5, kPoints));
    EXPECT_TRUE(chains.add(5, 0, 1, kPoints));
    EXPECT_TRUE(chains.add(5, 9, 2, kPoints));
    EXPECT_TRUE(chains.add(5, 2, 4, kPoints)) << "between two inner points";
    EXPECT_FALSE(chains.add(0, 9, 4, kPoints)) << "known already";
    ASSERT_EQ(chains.chains().size(), 1u);
    EXPECT_EQ(chains.chains().at({0, 9}), (Ids{0, 1, 5, 4, 2, 9}));
    EXPECT_EQ(chains.between(0, 9), (Ids{1, 5, 4, 2}));
    EXPECT_EQ(chains.between(9, 0), (Ids{1, 5, 4, 2})) << "from the lower id on";
    EXPECT_EQ(chains.between(2, 1), (Ids{5, 4}));
    EXPECT_EQ(chains.between(5, 2), (Ids{4}));
    EXPECT_TRUE(chains.between(5, 4).empty());
}

TEST(EdgeChains, PartsBetweenTwoEdgesAreEdgesOfTheirOwn) {
    EdgeChains chains;
    chains.add(0, 9, 5, kPoints);
    chains.add(0, 6, 7, kPoints);
    EXPECT_TRUE(chains.between(5, 7).empty());
    chains.add(5, 7, 8, kPoints);
    EXPECT_EQ(chains.between(7, 5), (Ids{8}));
    EXPECT_EQ(chains.between(0, 9), (Ids{5}));
    EXPECT_TRUE(chains.between(1, 2).empty()) << "of no divided edge";
}

}  // namespace
}  // namespace tetra::testing
