// SPDX-License-Identifier: LGPL-2.1-or-later
// Random voxel solids: unions of grid cells under integer maps and small moves of their vertices.
#include "random_solids.h"

#include <algorithm>
#include <array>
#include <map>
#include <numeric>

namespace tetra::testing {
namespace {

struct Cells {
    int nx = 0, ny = 0, nz = 0;
    std::vector<char> full;
    Cells(int x, int y, int z) : nx(x), ny(y), nz(z), full(static_cast<std::size_t>(x * y * z)) {}
    std::size_t index(int x, int y, int z) const {
        return static_cast<std::size_t>((z * ny + y) * nx + x);
    }
    bool at(int x, int y, int z) const {
        return x >= 0 && y >= 0 && z >= 0 && x < nx && y < ny && z < nz && full[index(x, y, z)];
    }
    int corner(int x, int y, int z) const { return (z * (ny + 1) + y) * (nx + 1) + x; }
};

// Corners of the face of a cell towards +k or -k, counter-clockwise seen from outside.
std::array<Vec3i, 4> face_corners(int axis, bool positive) {
    const int u = (axis + 1) % 3, v = (axis + 2) % 3;
    std::array<Vec3i, 4> corners{};
    const int du[4] = {0, 1, 1, 0}, dv[4] = {0, 0, 1, 1};
    for (int i = 0; i < 4; ++i) {
        const int j = positive ? i : 3 - i;
        corners[static_cast<std::size_t>(i)][axis] = positive ? 1 : 0;
        corners[static_cast<std::size_t>(i)][u] = du[j];
        corners[static_cast<std::size_t>(i)][v] = dv[j];
    }
    return corners;
}

// Points are grid corners in cell units; a coin decides the diagonal of each quad.
TestSolid boundary(const Cells& cells, Random* coin) {
    TestSolid solid;
    for (int z = 0; z <= cells.nz; ++z)
        for (int y = 0; y <= cells.ny; ++y)
            for (int x = 0; x <= cells.nx; ++x) solid.points.push_back({x, y, z});
    for (int z = 0; z < cells.nz; ++z)
        for (int y = 0; y < cells.ny; ++y)
            for (int x = 0; x < cells.nx; ++x) {
                if (!cells.at(x, y, z)) continue;
                for (int face = 0; face < 6; ++face) {
                    const int axis = face / 2;
                    const bool positive = face % 2;
                    std::array<int, 3> next{x, y, z};
                    next[static_cast<std::size_t>(axis)] += positive ? 1 : -1;
                    if (cells.at(next[0], next[1], next[2])) continue;
                    std::array<int, 4> q{};
                    const auto corners = face_corners(axis, positive);
                    for (std::size_t i = 0; i < 4; ++i)
                        q[i] = cells.corner(x + static_cast<int>(corners[i][0]),
                                            y + static_cast<int>(corners[i][1]),
                                            z + static_cast<int>(corners[i][2]));
                    if (coin && coin->chance(1, 2)) std::rotate(q.begin(), q.begin() + 1, q.end());
                    solid.triangles.push_back({q[0], q[1], q[2]});
                    solid.triangles.push_back({q[0], q[2], q[3]});
                }
            }
    return solid;
}

TestSolid drop_unused(const TestSolid& solid) {
    std::vector<int> renamed(solid.points.size(), -1);
    for (const Triangle& t : solid.triangles)
        for (int v : t) renamed[static_cast<std::size_t>(v)] = 0;
    TestSolid result;
    for (std::size_t i = 0; i < renamed.size(); ++i)
        if (renamed[i] == 0) {
            renamed[i] = static_cast<int>(result.points.size());
            result.points.push_back(solid.points[i]);
        }
    for (const Triangle& t : solid.triangles)
        result.triangles.push_back({renamed[static_cast<std::size_t>(t[0])],
                                    renamed[static_cast<std::size_t>(t[1])],
                                    renamed[static_cast<std::size_t>(t[2])]});
    return result;
}

Cells random_cells(Random& random, const VoxelOptions& options) {
    const int margin = options.cavities ? 2 : 0;
    const auto size = [&] { return random.between(options.min_size, options.max_size) + margin; };
    Cells cells(size(), size(), size());
    const int density = random.between(1, 5);  // of 6
    const bool checkered = random.chance(1, 5);
    for (;;) {
        for (int z = 0; z < cells.nz; ++z)
            for (int y = 0; y < cells.ny; ++y)
                for (int x = 0; x < cells.nx; ++x) {
                    const bool crust =
                        options.cavities && (x == 0 || y == 0 || z == 0 || x == cells.nx - 1 ||
                                             y == cells.ny - 1 || z == cells.nz - 1);
                    const bool odd = checkered && (x + y + z) % 2;
                    cells.full[cells.index(x, y, z)] =
                        crust || (random.chance(density, 6) && !(odd && random.chance(4, 5)));
                }
        if (std::any_of(cells.full.begin(), cells.full.end(), [](char c) { return c; }))
            return cells;
    }
}

std::int64_t determinant(const Matrix3& m) {
    return m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) -
           m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0]) +
           m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0]);
}

Matrix3 unimodular(Random& random) {
    Matrix3 m{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
    for (int i = random.between(1, 3); i > 0; --i) {
        const auto row = static_cast<std::size_t>(random.between(0, 2));
        const auto other = (row + static_cast<std::size_t>(random.between(1, 2))) % 3;
        const int factor = random.chance(1, 2) ? 1 : -1;
        for (std::size_t k = 0; k < 3; ++k) m[row][k] += factor * m[other][k];
    }
    return m;
}

Matrix3 general(Random& random) {
    for (;;) {
        Matrix3 m;
        for (Vec3i& row : m)
            for (std::int64_t& entry : row) entry = random.between(-3, 3);
        if (determinant(m) != 0) return m;
    }
}

// Grid lines of one axis: cumulated steps.
std::vector<std::int64_t> places(int cells, std::int64_t step, bool even, Random& random) {
    std::vector<std::int64_t> result{0};
    for (int i = 0; i < cells; ++i)
        result.push_back(result.back() +
                         (even ? step : 1 + random.between(0, static_cast<int>(step) - 1)));
    return result;
}

void spread(TestSolid& solid, const Cells& cells, std::int64_t step, bool even, Random& random) {
    const auto x = places(cells.nx, step, even, random);
    const auto y = places(cells.ny, step, even, random);
    const auto z = places(cells.nz, step, even, random);
    for (Vec3i& p : solid.points)
        p = {x[static_cast<std::size_t>(p[0])], y[static_cast<std::size_t>(p[1])],
             z[static_cast<std::size_t>(p[2])]};
}

// A tenth of a cell is small enough for every triangle to keep clear of all it did not touch:
// directions turn by less than 0.35, and separate triangles at a vertex are at least 45 degrees
// apart.
void jitter(TestSolid& solid, std::int64_t reach, VoxelMap kind, Random& random) {
    const int r = static_cast<int>(reach);
    for (Vec3i& p : solid.points) {
        if (kind == VoxelMap::jitter_sparse && !random.chance(1, 4)) continue;
        for (std::size_t k = kind == VoxelMap::jitter_z ? 2 : 0; k < 3; ++k)
            p[k] += random.between(-r, r);
    }
}

}  // namespace

std::uint64_t Random::next() {
    std::uint64_t z = (state_ += 0x9e3779b97f4a7c15u);
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return z ^ (z >> 31);
}

int Random::between(int first, int last) {
    return first + static_cast<int>(next() % static_cast<std::uint64_t>(last - first + 1));
}

TestSolid random_voxel_solid(std::uint64_t seed, const VoxelOptions& options) {
    Random random(seed);
    const Cells cells = random_cells(random, options);
    const VoxelMap kind =
        options.map == VoxelMap::any ? static_cast<VoxelMap>(random.between(1, 8)) : options.map;
    const bool jittered = kind >= VoxelMap::jitter_z;
    const bool linear =
        kind == VoxelMap::sheared || kind == VoxelMap::mapped || kind == VoxelMap::jitter_mapped;
    TestSolid solid = drop_unused(boundary(cells, random.chance(1, 2) ? &random : nullptr));
    // Six cells and a map of row sum up to nine need less than six bits; moves less than one.
    const int room = options.max_bits - (linear ? 7 : 4);
    const int bits = room <= 2 || random.chance(2, 3) ? 2 : random.between(2, room);
    const std::int64_t reach = jittered ? random.between(1, 1 << (bits > 4 ? bits - 4 : 0)) : 0;
    const std::int64_t step = std::max<std::int64_t>(std::int64_t{1} << bits, 10 * reach);
    spread(solid, cells, step, kind != VoxelMap::uneven, random);
    if (jittered) jitter(solid, reach, kind, random);
    if (kind == VoxelMap::sheared) return map(solid, unimodular(random));
    if (linear) return map(solid, general(random));
    return solid;
}

TestSolid random_type1_solid(std::uint64_t seed, const VoxelOptions& options) {
    Random random(seed);
    VoxelOptions small = options;
    small.max_bits = 10;
    small.map = VoxelMap::aligned;
    const TestSolid below =
        map(random_voxel_solid(random.next(), small), {{{32, 0, 0}, {0, 32, 0}, {0, 0, 32}}});
    // The lowest point of the upper solid is unique: z is ordered lexicographically by (z, y, x).
    small.map = random.chance(1, 2) ? VoxelMap::jitter : VoxelMap::uneven;
    small.max_bits = 7;
    const TestSolid upper = random_voxel_solid(random.next(), small);
    std::int64_t reach = 1;
    for (const Vec3i& p : upper.points)
        for (std::int64_t c : p) reach = std::max(reach, 2 * std::abs(c) + 1);
    const TestSolid above = map(upper, {{{1, 0, 0}, {0, 1, 0}, {1, reach, reach * reach}}});
    const auto lower = [](const Vec3i& p, const Vec3i& q) { return p[2] < q[2]; };
    const Vec3i foot = *std::min_element(above.points.begin(), above.points.end(), lower);
    std::int64_t top = below.points.front()[2];
    for (const Vec3i& p : below.points) top = std::max(top, p[2]);
    for (const Triangle& t : below.triangles) {
        const Vec3i& a = below.points[static_cast<std::size_t>(t[0])];
        const Vec3i& b = below.points[static_cast<std::size_t>(t[1])];
        const Vec3i& c = below.points[static_cast<std::size_t>(t[2])];
        if (a[2] != top || b[2] != top || c[2] != top || random.chance(1, 2)) continue;
        // (2a + b + c) / 4 is a grid point: all coordinates of the lower solid are multiples of 32.
        const Vec3i spot{(2 * a[0] + b[0] + c[0]) / 4, (2 * a[1] + b[1] + c[1]) / 4, top};
        return join(below, map(above, {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}},
                               {spot[0] - foot[0], spot[1] - foot[1], spot[2] - foot[2]}));
    }
    return random_type1_solid(seed + 0x5851f42d4c957f2du, options);
}

TestSolid small_random_solid(std::uint64_t seed) {
    VoxelOptions options;
    options.max_size = 3;
    options.cavities = seed % 5 == 0;
    return seed % 7 == 0 ? random_type1_solid(seed, options) : random_voxel_solid(seed, options);
}

TestSolid voxel_solid(const std::vector<std::vector<std::string>>& layers, std::int64_t step) {
    Cells cells(static_cast<int>(layers[0][0].size()), static_cast<int>(layers[0].size()),
                static_cast<int>(layers.size()));
    for (int z = 0; z < cells.nz; ++z)
        for (int y = 0; y < cells.ny; ++y)
            for (int x = 0; x < cells.nx; ++x)
                cells.full[cells.index(x, y, z)] =
                    layers[static_cast<std::size_t>(z)][static_cast<std::size_t>(y)]
                          [static_cast<std::size_t>(x)] == '#';
    return map(drop_unused(boundary(cells, nullptr)), {{{step, 0, 0}, {0, step, 0}, {0, 0, step}}});
}

TestSolid join(const TestSolid& first, const TestSolid& second) {
    TestSolid result = first;
    const int shift = static_cast<int>(first.points.size());
    result.points.insert(result.points.end(), second.points.begin(), second.points.end());
    for (const Triangle& t : second.triangles)
        result.triangles.push_back({t[0] + shift, t[1] + shift, t[2] + shift});
    return result;
}

TestSolid weld(const TestSolid& solid) {
    std::map<Vec3i, int> first;
    TestSolid result = solid;
    for (Triangle& t : result.triangles)
        for (int& v : t)
            v = first.try_emplace(solid.points[static_cast<std::size_t>(v)], v).first->second;
    return drop_unused(result);
}

TestSolid map(const TestSolid& solid, const Matrix3& matrix, const Vec3i& shift) {
    TestSolid result = solid;
    for (std::size_t i = 0; i < solid.points.size(); ++i)
        for (std::size_t k = 0; k < 3; ++k)
            result.points[i][k] = matrix[k][0] * solid.points[i][0] +
                                  matrix[k][1] * solid.points[i][1] +
                                  matrix[k][2] * solid.points[i][2] + shift[k];
    if (determinant(matrix) < 0)
        for (Triangle& t : result.triangles) std::swap(t[1], t[2]);
    return result;
}

TestSolid shuffle(const TestSolid& solid, std::uint64_t seed) {
    Random random(seed);
    std::vector<int> place(solid.points.size());
    std::iota(place.begin(), place.end(), 0);
    const auto mix = [&](auto& list) {
        for (std::size_t i = list.size(); i > 1; --i)
            std::swap(list[i - 1],
                      list[static_cast<std::size_t>(random.between(0, static_cast<int>(i) - 1))]);
    };
    mix(place);
    TestSolid result = solid;
    for (std::size_t i = 0; i < place.size(); ++i)
        result.points[static_cast<std::size_t>(place[i])] = solid.points[i];
    for (Triangle& t : result.triangles) {
        for (int& v : t) v = place[static_cast<std::size_t>(v)];
        std::rotate(t.begin(), t.begin() + random.between(0, 2), t.end());
    }
    mix(result.triangles);
    return result;
}

Int256 volume6(const TestSolid& solid) {
    Int256 sum;
    for (const Triangle& t : solid.triangles) {
        const Vec3i& a = solid.points[static_cast<std::size_t>(t[0])];
        const Vec3i& b = solid.points[static_cast<std::size_t>(t[1])];
        const Vec3i& c = solid.points[static_cast<std::size_t>(t[2])];
        for (std::size_t k = 0; k < 3; ++k) {
            const std::size_t u = (k + 1) % 3, v = (k + 2) % 3;
            const Int128 minor =
                static_cast<Int128>(b[u]) * c[v] - static_cast<Int128>(b[v]) * c[u];
            sum += Int256(minor) * Int256(a[k]);
        }
    }
    return sum;
}

GridSolid grid_solid(const TestSolid& solid) {
    GridSolid result;
    result.points = solid.points;
    result.triangles = solid.triangles;
    result.point_source.resize(solid.points.size());
    std::iota(result.point_source.begin(), result.point_source.end(), 0);
    result.triangle_source.resize(solid.triangles.size());
    std::iota(result.triangle_source.begin(), result.triangle_source.end(), 0);
    result.solid.assign(solid.triangles.size(), 0);
    return result;
}

std::string to_off(const TestSolid& solid) {
    std::string text = "OFF\n" + std::to_string(solid.points.size()) + " " +
                       std::to_string(solid.triangles.size()) + " 0\n";
    for (const Vec3i& p : solid.points)
        text +=
            std::to_string(p[0]) + " " + std::to_string(p[1]) + " " + std::to_string(p[2]) + "\n";
    for (const Triangle& t : solid.triangles)
        text += "3 " + std::to_string(t[0]) + " " + std::to_string(t[1]) + " " +
                std::to_string(t[2]) + "\n";
    return text;
}

}  // namespace tetra::testing
