// SPDX-License-Identifier: LGPL-2.1-or-later
// Named small solids of the tests, random convex ones, and Chazelle's lower-bound family.
#include <algorithm>
#include <cstdlib>

#include "random_solids.h"
#include "tetra/exact/predicates.h"

namespace tetra::testing {
namespace {

using Point2 = std::array<std::int64_t, 2>;
using Loop = std::vector<int>;

std::int64_t turn(const Point2& a, const Point2& b, const Point2& c) {
    return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}

// Ear clipping of a simple counter-clockwise polygon; quadratic and more, for tests only.
std::vector<Triangle> clip_ears(const std::vector<Point2>& polygon) {
    Loop left(polygon.size());
    for (std::size_t i = 0; i < left.size(); ++i) left[i] = static_cast<int>(i);
    const auto at = [&](int v) { return polygon[static_cast<std::size_t>(v)]; };
    std::vector<Triangle> triangles;
    while (left.size() > 2) {
        bool clipped = false;
        for (std::size_t i = 0; i < left.size() && !clipped; ++i) {
            const int a = left[(i + left.size() - 1) % left.size()], b = left[i],
                      c = left[(i + 1) % left.size()];
            if (turn(at(a), at(b), at(c)) <= 0) continue;
            clipped = std::none_of(left.begin(), left.end(), [&](int v) {
                return v != a && v != b && v != c && turn(at(a), at(b), at(v)) >= 0 &&
                       turn(at(b), at(c), at(v)) >= 0 && turn(at(c), at(a), at(v)) >= 0;
            });
            if (!clipped) continue;
            triangles.push_back({a, b, c});
            left.erase(left.begin() + static_cast<std::ptrdiff_t>(i));
        }
        if (!clipped) std::abort();
    }
    return triangles;
}

// A planar face given by its corners in either sense; its outward normal has the given sign in
// the coordinate `axis`, along which it is projected.
void add_face(TestSolid& solid, std::vector<Vec3i> corners, std::size_t axis, int sign) {
    std::vector<Point2> flat;
    for (const Vec3i& p : corners) flat.push_back({p[(axis + 1) % 3], p[(axis + 2) % 3]});
    std::int64_t area = 0;
    for (std::size_t i = 0; i < flat.size(); ++i) {
        const Point2 &p = flat[i], &q = flat[(i + 1) % flat.size()];
        area += p[0] * q[1] - p[1] * q[0];
    }
    if (area < 0) {
        std::reverse(flat.begin(), flat.end());
        std::reverse(corners.begin(), corners.end());
    }
    const int shift = static_cast<int>(solid.points.size());
    solid.points.insert(solid.points.end(), corners.begin(), corners.end());
    for (const Triangle& t : clip_ears(flat)) {
        const Triangle u = sign > 0 ? t : Triangle{t[0], t[2], t[1]};
        solid.triangles.push_back({u[0] + shift, u[1] + shift, u[2] + shift});
    }
}

// The upright prism over a counter-clockwise polygon.
TestSolid prism(const std::vector<Point2>& polygon, std::int64_t low, std::int64_t high) {
    TestSolid solid;
    for (const std::int64_t z : {low, high}) {
        std::vector<Vec3i> cap;
        for (const Point2& p : polygon) cap.push_back({p[0], p[1], z});
        add_face(solid, cap, 2, z == low ? -1 : 1);
    }
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const Point2 &p = polygon[i], &q = polygon[(i + 1) % polygon.size()];
        const std::vector<Vec3i> wall{
            {p[0], p[1], low}, {q[0], q[1], low}, {q[0], q[1], high}, {p[0], p[1], high}};
        if (p[1] == q[1])
            add_face(solid, wall, 1, q[0] > p[0] ? -1 : 1);
        else
            add_face(solid, wall, 0, q[1] > p[1] ? 1 : -1);
    }
    return weld(solid);
}

TestSolid stairs(int steps) {
    std::vector<Point2> outline{{0, 0}, {4 * steps, 0}};
    for (int i = steps; i > 0; --i) {
        outline.push_back({4 * i, 4 * (steps - i + 1)});
        if (i > 1) outline.push_back({4 * (i - 1), 4 * (steps - i + 1)});
    }
    outline.push_back({0, 4 * steps});
    return prism(outline, 0, 4);
}

TestSolid pyramid_on_plate() {
    TestSolid pyramid;
    pyramid.points = {{3, 7, 4}, {1, 5, 12}, {5, 5, 12}, {5, 9, 12}, {1, 9, 12}};
    pyramid.triangles = {{0, 2, 1}, {0, 3, 2}, {0, 4, 3}, {0, 1, 4}, {1, 2, 3}, {1, 3, 4}};
    return join(prism({{0, 0}, {12, 0}, {12, 12}, {0, 12}}, 0, 4), pyramid);
}

TestSolid spike_cup() {
    TestSolid solid;
    solid.points = {{-10, -10, 0}, {10, -10, 0}, {10, 10, 0}, {-10, 10, 0}, {0, 0, 20}, {1, 0, 8}};
    for (int i = 0; i < 4; ++i) {
        solid.triangles.push_back({i, (i + 1) % 4, 4});
        solid.triangles.push_back({(i + 1) % 4, i, 5});
    }
    return solid;
}

bool hull_of(const std::vector<Vec3i>& points, TestSolid& solid) {
    const int n = static_cast<int>(points.size());
    const auto at = [&](int v) -> const Vec3i& { return points[static_cast<std::size_t>(v)]; };
    solid.points = points;
    for (int a = 0; a < n; ++a)
        for (int b = a + 1; b < n; ++b)
            for (int c = b + 1; c < n; ++c) {
                int above = 0, below = 0;
                for (int d = 0; d < n && !(above && below); ++d) {
                    if (d == a || d == b || d == c) continue;
                    const int sign = orient3d(at(a), at(b), at(c), at(d));
                    above += sign >= 0;
                    below += sign <= 0;
                }
                if (above && below) continue;
                solid.triangles.push_back(above ? Triangle{a, c, b} : Triangle{a, b, c});
            }
    // Euler's formula fails when four hull points lie in one plane and facets were skipped.
    solid = weld(solid);
    return solid.triangles.size() == 2 * solid.points.size() - 4;
}

}  // namespace

TestSolid random_convex_solid(std::uint64_t seed, int points) {
    Random random(seed);
    for (;;) {
        std::vector<Vec3i> cloud;
        for (int i = 0; i < points; ++i)
            cloud.push_back(
                {random.between(-99, 99), random.between(-99, 99), random.between(-99, 99)});
        TestSolid solid;
        if (hull_of(cloud, solid)) return solid;
    }
}

TestSolid cube(std::int64_t size) {
    return prism({{0, 0}, {size, 0}, {size, size}, {0, size}}, 0, size);
}

TestSolid octahedron(std::int64_t size) {
    TestSolid solid;
    solid.points = {{size, 0, 0},  {0, size, 0}, {-size, 0, 0},
                    {0, -size, 0}, {0, 0, size}, {0, 0, -size}};
    for (int i = 0; i < 4; ++i) {
        solid.triangles.push_back({i, (i + 1) % 4, 4});
        solid.triangles.push_back({(i + 1) % 4, i, 5});
    }
    return solid;
}

TestSolid schoenhardt() {
    TestSolid solid;
    solid.points = {{1000, 0, 0},     {-500, 866, 0},    {-500, -866, 0},
                    {866, 500, 1000}, {-866, 500, 1000}, {0, -1000, 1000}};
    solid.triangles = {{0, 2, 1}, {3, 4, 5}};
    for (int i = 0; i < 3; ++i) {
        const int j = (i + 1) % 3;
        solid.triangles.push_back({i, j, j + 3});
        solid.triangles.push_back({i, j + 3, i + 3});
    }
    return solid;
}

TestSolid plate_with_holes(int rows, int columns) {
    std::vector<std::string> layer;
    for (int y = 0; y < 2 * rows + 1; ++y) {
        std::string row(static_cast<std::size_t>(2 * columns + 1), '#');
        for (int x = 1; y % 2 && x < 2 * columns; x += 2) row[static_cast<std::size_t>(x)] = '.';
        layer.push_back(row);
    }
    return voxel_solid({layer});
}

TestSolid chazelle(int notches, int inverse_gap) {
    const std::int64_t n = notches, m = inverse_gap, k = 2 * n * n + n + 1;
    const std::int64_t lo = -k, hi = k * (n + 1), bottom = -2 * n * m, top = 2 * n * n * m + 1;
    // The mouth of the slits: bottom notches run along x, top notches along y.
    const auto mouth = [&](bool upper, bool far) {
        const std::int64_t fixed = far ? hi : lo, edge = upper ? top : bottom;
        std::vector<Vec3i> line;
        const auto add = [&](std::int64_t along, std::int64_t z) {
            line.push_back(upper ? Vec3i{along, fixed, z} : Vec3i{fixed, along, z});
        };
        add(lo, edge);
        for (std::int64_t i = 0; i <= n; ++i) {
            const std::int64_t slope = far ? n + 1 : -1, half = upper ? 2 * n * n : 2 * n;
            add(k * i, edge);
            add(k * i, m * i * slope + upper);
            add(k * i + half + (upper ? -i : i) * slope, edge);
        }
        add(hi, edge);
        return line;
    };
    TestSolid solid;
    for (const bool upper : {false, true}) {
        const std::size_t along = upper ? 0 : 1, across = 1 - along;
        const std::int64_t back = upper ? bottom : top;
        const auto near = mouth(upper, false), far = mouth(upper, true);
        for (const auto* line : {&near, &far}) {
            std::vector<Vec3i> face = *line;
            face.push_back(line->back());
            face.push_back(line->front());
            face.end()[-1][2] = face.end()[-2][2] = back;
            add_face(solid, face, across, line == &far ? 1 : -1);
        }
        for (std::size_t i = 0; i + 1 < near.size(); ++i) {
            const std::vector<Vec3i> quad{near[i], near[i + 1], far[i + 1], far[i]};
            if (i % 3 == 0)
                add_face(solid, quad, 2, upper ? 1 : -1);
            else
                add_face(solid, quad, along, i % 3 == 1 ? 1 : -1);
        }
    }
    return weld(solid);
}

std::vector<NamedSolid> named_solids() {
    const std::vector<std::string> all{"###", "###", "###"}, ring{"###", "#.#", "###"},
        posts{"#.#", "...", "#.#"};
    return {
        {"cube", cube(), 1},
        {"octahedron", octahedron(), 1},
        {"l_prism", prism({{0, 0}, {8, 0}, {8, 4}, {4, 4}, {4, 8}, {0, 8}}, 0, 4), 2},
        {"boss", voxel_solid({all, {"...", ".#.", "..."}}), 2},
        {"cavity", voxel_solid({all, ring, all}), 6},
        {"frame", voxel_solid({ring}), 4},
        {"three_way_frame", voxel_solid({ring, posts, ring}), 0},
        {"touching_edge", voxel_solid({{"#.", ".#"}}), 2},
        {"touching_vertex", voxel_solid({{"#.", ".."}, {"..", ".#"}}), 2},
        {"vertex_on_face", pyramid_on_plate(), 2},
        {"touching_cavities",
         voxel_solid({{"####", "####", "####", "####"},
                      {"####", "#.##", "####", "####"},
                      {"####", "####", "##.#", "####"},
                      {"####", "####", "####", "####"}}),
         0},
        {"stairs", stairs(5), 5},
        {"schoenhardt", schoenhardt(), 0},
        {"plate_with_holes", plate_with_holes(2, 3), 0},
        {"windows", map(plate_with_holes(1, 3), {{{1, 0, 0}, {0, 0, 1}, {0, 1, 0}}}), 0},
        {"spike_cup", spike_cup(), 0},
        {"chazelle_2", chazelle(2), 16},
    };
}

}  // namespace tetra::testing
