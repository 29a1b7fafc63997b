// SPDX-License-Identifier: LGPL-2.1-or-later
// Integer points with counted predicates, polyomino regions, and an independent judge of meshes.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdlib>
#include <map>
#include <random>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "tetra/polygon/region.h"

namespace tetra::testing {

using Point = std::array<std::int64_t, 2>;

class IntegerPoints : public PointOracle {
  public:
    explicit IntegerPoints(std::vector<Point> points) : points_(std::move(points)) {}

    int compare(PointId i, PointId j) const override {
        ++compare_calls;
        const Point& p = points_[i];
        const Point& q = points_[j];
        return p < q ? -1 : (q < p ? 1 : 0);
    }

    int orient(PointId i, PointId j, PointId k) const override {
        ++orient_calls;
        const std::int64_t area = twice_area({i, j, k});
        return area > 0 ? 1 : (area < 0 ? -1 : 0);
    }

    std::int64_t twice_area(const PlanarTriangle& t) const {
        const Point& a = points_[t[0]];
        const Point& b = points_[t[1]];
        const Point& c = points_[t[2]];
        return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
    }

    std::int64_t twice_area(const std::vector<DirectedEdge>& boundary) const {
        std::int64_t sum = 0;
        for (const DirectedEdge& e : boundary) {
            sum += points_[e.from][0] * points_[e.to][1] - points_[e.from][1] * points_[e.to][0];
        }
        return sum;
    }

    const std::vector<Point>& points() const { return points_; }

    mutable long compare_calls = 0;
    mutable long orient_calls = 0;

  private:
    std::vector<Point> points_;
};

/// What a mesh of a region must have; empty when it does, else the first thing wrong.
///
/// Positive triangles whose sides cancel but for the boundary, each side once, cover every point
/// as often as the boundary winds around it. A vertex inside a side would leave its edges open.
inline std::string flaw_of(const std::vector<PlanarTriangle>& triangles,
                           const std::vector<DirectedEdge>& boundary, const IntegerPoints& points) {
    std::map<std::pair<int, int>, int> sides;
    std::int64_t area = 0;
    for (const PlanarTriangle& t : triangles) {
        if (points.twice_area(t) <= 0) return "flat or inverted triangle";
        area += points.twice_area(t);
        for (int k = 0; k < 3; ++k) {
            if (++sides[{t[k], t[(k + 1) % 3]}] > 1) return "a side occurs twice";
        }
    }
    if (area != points.twice_area(boundary)) return "wrong area";
    std::set<std::pair<int, int>> outer;
    for (const DirectedEdge& e : boundary) {
        if (!outer.insert({e.from, e.to}).second) return "boundary edge given twice";
        if (sides.count({e.from, e.to}) == 0) return "boundary edge missing";
    }
    for (const auto& [side, count] : sides) {
        const bool has_other = sides.count({side.second, side.first}) != 0;
        if (outer.count(side) == 0 && !has_other) return "open inner side";
        if (outer.count(side) != 0 && has_other && outer.count({side.second, side.first}) == 0) {
            return "triangle outside of the boundary";
        }
    }
    return {};
}

/// Triangles that share sides, counted as components.
inline int components_of(const std::vector<PlanarTriangle>& triangles) {
    std::map<std::pair<int, int>, int> at;
    std::vector<int> parent(triangles.size());
    for (std::size_t t = 0; t < triangles.size(); ++t) {
        parent[t] = static_cast<int>(t);
        for (int k = 0; k < 3; ++k) {
            at[{triangles[t][k], triangles[t][(k + 1) % 3]}] = static_cast<int>(t);
        }
    }
    const auto root = [&](int t) {
        while (parent[t] != t) t = parent[t] = parent[parent[t]];
        return t;
    };
    int count = static_cast<int>(triangles.size());
    for (const auto& [side, t] : at) {
        const auto other = at.find({side.second, side.first});
        if (other != at.end() && root(t) != root(other->second)) {
            parent[root(t)] = root(other->second);
            --count;
        }
    }
    return count;
}

/// A region of unit cells on a grid of width x height; all grid points are numbered row by row.
struct Polyomino {
    int width = 0;
    int height = 0;
    std::vector<char> filled;

    bool at(int x, int y) const {
        return x >= 0 && y >= 0 && x < width && y < height && filled[y * width + x] != 0;
    }
    int id(int x, int y) const { return y * (width + 1) + x; }

    /// Grid points after an integer shear and turn that keeps straight angles.
    std::vector<Point> points(std::array<int, 4> map = {1, 0, 0, 1}) const {
        std::vector<Point> out;
        for (int y = 0; y <= height; ++y) {
            for (int x = 0; x <= width; ++x) {
                out.push_back({map[0] * x + map[1] * y, map[2] * x + map[3] * y});
            }
        }
        return out;
    }

    /// Unit edges with the cells on the left, for maps of positive determinant.
    std::vector<DirectedEdge> boundary() const {
        std::vector<DirectedEdge> out;
        for (int y = 0; y < height; ++y) {
            for (int x = 0; x < width; ++x) {
                if (!at(x, y)) continue;
                if (!at(x, y - 1)) out.push_back({id(x, y), id(x + 1, y)});
                if (!at(x + 1, y)) out.push_back({id(x + 1, y), id(x + 1, y + 1)});
                if (!at(x, y + 1)) out.push_back({id(x + 1, y + 1), id(x, y + 1)});
                if (!at(x - 1, y)) out.push_back({id(x, y + 1), id(x, y)});
            }
        }
        return out;
    }

    /// Grid points with four cells around.
    std::vector<PointId> inner_points() const {
        std::vector<PointId> out;
        for (int y = 1; y < height; ++y) {
            for (int x = 1; x < width; ++x) {
                if (at(x, y) && at(x - 1, y) && at(x, y - 1) && at(x - 1, y - 1)) {
                    out.push_back(id(x, y));
                }
            }
        }
        return out;
    }

    /// Euler characteristic of the interior: cells - inner edges + inner points.
    int euler() const {
        int sum = static_cast<int>(inner_points().size());
        for (int y = 0; y < height; ++y) {
            for (int x = 0; x < width; ++x) {
                if (!at(x, y)) continue;
                sum += 1 - (at(x + 1, y) ? 1 : 0) - (at(x, y + 1) ? 1 : 0);
            }
        }
        return sum;
    }
};

/// Boundary edges of loops as they come.
inline std::vector<DirectedEdge> edges_of(const std::vector<std::vector<PointId>>& loops) {
    std::vector<DirectedEdge> edges;
    for (const auto& loop : loops) {
        for (std::size_t k = 0; k < loop.size(); ++k) {
            edges.push_back({loop[k], loop[(k + 1) % loop.size()]});
        }
    }
    return edges;
}

/// A dev run sets TETRA_POLYGON_CASES; the slice of the unit test is small.
inline int case_count(int normal) {
    const char* wanted = std::getenv("TETRA_POLYGON_CASES");
    return wanted != nullptr ? std::atoi(wanted) : normal;
}

inline int draw(std::mt19937_64& random, int low, int high) {
    return low + static_cast<int>(random() % static_cast<std::uint64_t>(high - low + 1));
}

inline Polyomino random_polyomino(std::mt19937_64& random, int largest) {
    Polyomino p;
    p.width = draw(random, 1, largest);
    p.height = draw(random, 1, largest);
    const int density = draw(random, 10, 95);
    for (int k = 0; k < p.width * p.height; ++k) {
        p.filled.push_back(draw(random, 0, 99) < density ? 1 : 0);
    }
    return p;
}

/// Integer maps of positive determinant: identity, turns, shears, and a general one.
inline std::array<int, 4> integer_map(int k) {
    constexpr std::array<std::array<int, 4>, 8> maps{{{1, 0, 0, 1},
                                                      {0, -1, 1, 0},
                                                      {-1, 0, 0, -1},
                                                      {1, -1, 1, 1},
                                                      {1, 3, 0, 1},
                                                      {1, 0, -2, 1},
                                                      {3, 1, -2, 5},
                                                      {2, -7, 3, 1}}};
    return maps[static_cast<std::size_t>(k) % maps.size()];
}

}  // namespace tetra::testing
