// SPDX-License-Identifier: LGPL-2.1-or-later
// Generators with exact signs only, and the exact check of a pull-off.
#include "pull_off_support.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <numbers>

#include "tetra/exact/predicates.h"
#include "tetra/solid/edges.h"

namespace tetra::testing {
namespace {

int orient(const std::vector<Vec3i>& p, const Triangle& t, int d) {
    return orient3d(p[static_cast<std::size_t>(t[0])], p[static_cast<std::size_t>(t[1])],
                    p[static_cast<std::size_t>(t[2])], p[static_cast<std::size_t>(d)]);
}

Int128 volume6_of(const std::vector<Vec3i>& p, const std::vector<Triangle>& triangles) {
    Int128 sum = 0;
    for (const Triangle& t : triangles)
        sum += det3_of_points({0, 0, 0}, p[static_cast<std::size_t>(t[0])],
                              p[static_cast<std::size_t>(t[1])], p[static_cast<std::size_t>(t[2])]);
    return sum;
}

}  // namespace

TestSolid hull_of(const std::vector<Vec3i>& points) {
    TestSolid solid{points, {}};
    const int count = static_cast<int>(points.size());
    int third = 2, fourth = -1;
    while (collinear(points[0], points[1], points[static_cast<std::size_t>(third)])) ++third;
    for (int i = third + 1; fourth < 0; ++i)
        if (orient(points, {0, 1, third}, i) != 0) fourth = i;
    Triangle base{0, 1, third};
    if (orient(points, base, fourth) > 0) base = {0, third, 1};
    solid.triangles = {
        base, {base[1], base[0], fourth}, {base[2], base[1], fourth}, {base[0], base[2], fourth}};
    for (int p = 2; p < count; ++p) {
        if (p == third || p == fourth) continue;
        std::vector<Triangle> kept;
        std::map<std::pair<int, int>, bool> open;
        for (const Triangle& t : solid.triangles) {
            if (orient(points, t, p) <= 0) {
                kept.push_back(t);
                continue;
            }
            for (std::size_t k = 0; k < 3; ++k)
                if (!open.erase({t[(k + 1) % 3], t[k]})) open[{t[k], t[(k + 1) % 3]}] = true;
        }
        for (const auto& [edge, seen] : open) kept.push_back({edge.first, edge.second, p});
        solid.triangles = kept;
    }
    return weld(solid);
}

std::vector<Vec3i> random_sphere_points(std::uint64_t seed, int count, double radius) {
    Random random(seed);
    std::vector<Vec3i> points;
    while (static_cast<int>(points.size()) < count) {
        double v[3], square = 0;
        for (double& c : v) {
            c = random.between(-1000000, 1000000) / 1e6;
            square += c * c;
        }
        if (square > 1 || square < 0.1) continue;
        const double scale = radius / std::sqrt(square);
        points.push_back(
            {std::llround(v[0] * scale), std::llround(v[1] * scale), std::llround(v[2] * scale)});
    }
    return points;
}

TestSolid uv_sphere(int meridians, int parallels, double radius) {
    TestSolid solid;
    const auto place = [&](int i, int j) {
        const double a = 2 * std::numbers::pi * i / meridians;
        const double b = std::numbers::pi * j / parallels;
        solid.points.push_back({std::llround(radius * std::sin(b) * std::cos(a)),
                                std::llround(radius * std::sin(b) * std::sin(a)),
                                std::llround(radius * std::cos(b))});
    };
    place(0, 0);
    for (int j = 1; j < parallels; ++j)
        for (int i = 0; i < meridians; ++i) place(i, j);
    place(0, parallels);
    const auto id = [&](int i, int j) { return 1 + (j - 1) * meridians + i % meridians; };
    const int south = static_cast<int>(solid.points.size()) - 1;
    for (int i = 0; i < meridians; ++i) {
        solid.triangles.push_back({0, id(i, 1), id(i + 1, 1)});
        for (int j = 1; j + 1 < parallels; ++j) {
            solid.triangles.push_back({id(i, j), id(i, j + 1), id(i + 1, j + 1)});
            solid.triangles.push_back({id(i, j), id(i + 1, j + 1), id(i + 1, j)});
        }
        solid.triangles.push_back({id(i, parallels - 1), south, id(i + 1, parallels - 1)});
    }
    return solid;
}

TestSolid prism(int sides, double radius, std::int64_t height) {
    TestSolid solid;
    for (int layer = 0; layer < 2; ++layer)
        for (int i = 0; i < sides; ++i) {
            const double a = 2 * std::numbers::pi * i / sides;
            solid.points.push_back({std::llround(radius * std::cos(a)),
                                    std::llround(radius * std::sin(a)), layer * height});
        }
    for (int i = 0; i < sides; ++i) {
        const int j = (i + 1) % sides;
        solid.triangles.push_back({i, j, sides + j});
        solid.triangles.push_back({i, sides + j, sides + i});
        if (i > 0 && j > 0) {
            solid.triangles.push_back({0, j, i});
            solid.triangles.push_back({sides, sides + i, sides + j});
        }
    }
    return solid;
}

TestSolid moment_curve_hull(int count) {
    std::vector<Vec3i> points;
    for (std::int64_t t = 0; t < count; ++t) points.push_back({t, t * t, t * t * t});
    return hull_of(points);
}

TestSolid gridded_cube(int cells, std::int64_t step) {
    TestSolid solid;
    for (std::size_t axis = 0; axis < 3; ++axis)
        for (int side = 0; side < 2; ++side)
            for (int i = 0; i < cells; ++i)
                for (int j = 0; j < cells; ++j) {
                    const int first = static_cast<int>(solid.points.size());
                    for (const auto& [di, dj] : {std::pair{0, 0}, {1, 0}, {1, 1}, {0, 1}}) {
                        Vec3i p;
                        p[axis] = side * cells * step;
                        p[(axis + 1) % 3] = (i + di) * step;
                        p[(axis + 2) % 3] = (j + dj) * step;
                        solid.points.push_back(p);
                    }
                    if (side) {
                        solid.triangles.push_back({first, first + 1, first + 2});
                        solid.triangles.push_back({first, first + 2, first + 3});
                    } else {
                        solid.triangles.push_back({first, first + 2, first + 1});
                        solid.triangles.push_back({first, first + 3, first + 2});
                    }
                }
    return weld(solid);
}

TestSolid dented(TestSolid solid, int vertex, int numerator) {
    for (std::int64_t& c : solid.points[static_cast<std::size_t>(vertex)]) c -= c * numerator / 16;
    return solid;
}

TestSolid mirrored(TestSolid solid) {
    for (Triangle& t : solid.triangles) std::swap(t[1], t[2]);
    return solid;
}

int reflex_edges(const TestSolid& solid) {
    const EdgeTable edges = build_edges(solid.triangles, {});
    int count = 0;
    for (std::size_t e = 0; e < edges.edges.size(); ++e) {
        const auto sides = edges.of(e);
        if (sides.size() == 2 &&
            orient(solid.points, solid.triangles[static_cast<std::size_t>(sides[0] / 3)],
                   apex_of(solid.triangles, sides[1])) > 0)
            ++count;
    }
    return count;
}

PullOff pull(const TestSolid& solid, const PullOptions& options) {
    Progress progress;
    return pull_off(solid.points, solid.triangles,
                    facet_owners(solid.points, solid.triangles, {}, {}), options, progress);
}

void expect_sound(const TestSolid& solid, const PullOff& result) {
    Int128 volume = volume6_of(solid.points, result.triangles);
    for (const Cup& cup : result.cups) {
        EXPECT_EQ(cup.dome.size() + 2, cup.crown.size());
        EXPECT_EQ(cup.lateral_owner.size(), cup.crown.size());
        for (const Triangle& t : cup.dome) {
            EXPECT_GT(orient(solid.points, t, cup.apex), 0);
            volume += det3_of_points(solid.points[static_cast<std::size_t>(t[0])],
                                     solid.points[static_cast<std::size_t>(t[1])],
                                     solid.points[static_cast<std::size_t>(t[2])],
                                     solid.points[static_cast<std::size_t>(cup.apex)]);
        }
    }
    EXPECT_TRUE(volume == volume6_of(solid.points, solid.triangles));
    EXPECT_TRUE(is_closed(result.triangles, {}));
    EXPECT_EQ(result.triangles.size(), result.owners.size());
    for (const Triangle& t : result.triangles)
        EXPECT_FALSE(collinear(solid.points[static_cast<std::size_t>(t[0])],
                               solid.points[static_cast<std::size_t>(t[1])],
                               solid.points[static_cast<std::size_t>(t[2])]));
    EXPECT_EQ(static_cast<int>(result.cups.size()), result.statistics.removed);
    EXPECT_EQ(result.statistics.without_dome, 0);
}

int cup_tets(const PullOff& result) {
    int count = 0;
    for (const Cup& cup : result.cups) count += static_cast<int>(cup.dome.size());
    return count;
}

}  // namespace tetra::testing
