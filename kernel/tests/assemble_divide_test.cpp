// SPDX-License-Identifier: LGPL-2.1-or-later
// Divided tetrahedra fill their place, and two neighbours agree on their common face.
#include "../src/assemble/divide_tets.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "tetra/assemble/double_predicates.h"
#include "tetra/errors.h"

namespace tetra::testing {
namespace {

using Tet = std::array<int, 4>;

double volume6(const std::vector<Vec3d>& p, const Tet& t) {
    const auto at = [&](int i) {
        return p[static_cast<std::size_t>(t[static_cast<std::size_t>(i)])];
    };
    return det3_of_points(at(0), at(1), at(2), at(3));
}

// Triangles that one tetrahedron has and no other: ascending ids.
std::vector<Triangle> outside(const std::vector<Tet>& tets) {
    std::vector<Triangle> all, once;
    for (const Tet& t : tets)
        for (std::size_t i = 0; i < 4; ++i) {
            Triangle f{t[(i + 1) % 4], t[(i + 2) % 4], t[(i + 3) % 4]};
            std::sort(f.begin(), f.end());
            all.push_back(f);
        }
    std::sort(all.begin(), all.end());
    for (std::size_t i = 0, j = 0; i < all.size(); i = j) {
        while (j < all.size() && all[j] == all[i]) ++j;
        if (j - i == 1) once.push_back(all[i]);
        EXPECT_LE(j - i, 2u);
    }
    return once;
}

struct Case {
    std::vector<Vec3d> points{{0, 0, 0}, {8, 0, 0}, {0, 8, 0}, {0, 0, 8}, {8, 8, 8}};
    Division division;

    int on_edge(int u, int v, double share) {
        const Vec3d &a = points[static_cast<std::size_t>(u)],
                    &b = points[static_cast<std::size_t>(v)];
        Vec3d p{};
        for (std::size_t k = 0; k < 3; ++k) p[k] = a[k] + share * (b[k] - a[k]);
        points.push_back(p);
        division.on_edge[{u, v}].push_back(static_cast<int>(points.size()) - 1);
        return static_cast<int>(points.size()) - 1;
    }
};

TEST(DivideTets, OneEdgeIsHalvedFromACorner) {
    Case c;
    c.on_edge(0, 1, 0.25);
    c.on_edge(0, 1, 0.5);
    const std::vector<Tet> parts = divided({0, 1, 2, 3}, c.division, c.points);
    EXPECT_EQ(parts.size(), 3u);
    EXPECT_EQ(c.points.size(), 7u) << "no point of its own";
}

TEST(DivideTets, NeighboursAgree) {
    Case c;
    for (const auto& [u, v] : {std::pair{1, 2}, {2, 3}, {1, 3}, {0, 1}, {3, 4}})
        for (const double share : {0.25, 0.5}) c.on_edge(u, v, share);
    const Tet one{0, 1, 2, 3}, two{1, 2, 3, 4};
    std::vector<Tet> parts = divided(one, c.division, c.points);
    const double first = volume6(c.points, one), second = std::abs(volume6(c.points, two));
    const Tet turned = volume6(c.points, two) > 0 ? two : Tet{2, 1, 3, 4};
    const std::vector<Tet> more = divided(turned, c.division, c.points);
    parts.insert(parts.end(), more.begin(), more.end());
    double sum = 0;
    for (const Tet& t : parts) {
        EXPECT_GT(volume6(c.points, t), 0);
        sum += volume6(c.points, t);
    }
    EXPECT_DOUBLE_EQ(sum, first + second);
    for (const Triangle& t : c.division.parts_of({1, 2, 3})) {
        Triangle f = t;
        std::sort(f.begin(), f.end());
        const std::vector<Triangle> free = outside(parts);
        EXPECT_FALSE(std::binary_search(free.begin(), free.end(), f))
            << "the common face is inside";
    }
}

TEST(DivideTets, AFaceIsDividedAsGiven) {
    Case c;
    c.points.push_back({2, 2, 0});
    const int inner = static_cast<int>(c.points.size()) - 1;
    c.division.faces[{0, 1, 2}] = {{0, 2, inner}, {2, 1, inner}, {1, 0, inner}};
    const std::vector<Tet> parts = divided({0, 1, 2, 3}, c.division, c.points);
    EXPECT_EQ(parts.size(), 3u);
    EXPECT_EQ(outside(parts).size(), 6u);
}

TEST(DivideTets, RefusesToInvert) {
    Case c;
    c.on_edge(0, 1, 0.5);
    c.points.back() = {4, 30, 0};
    EXPECT_THROW(divided({0, 1, 2, 3}, c.division, c.points), VerificationFailed);
}

}  // namespace
}  // namespace tetra::testing
