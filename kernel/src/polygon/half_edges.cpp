// SPDX-License-Identifier: LGPL-2.1-or-later
// Pairing of sides by one sort.

#include "half_edges.h"

#include <algorithm>
#include <string>
#include <tuple>

namespace tetra {

namespace {

constexpr int fixed_mark = -1;

/// Sides of the same two points are neighbours in the order, a mark of a fixed edge first.
struct Entry {
    PointId low;
    PointId high;
    int side;

    bool same_points(const Entry& other) const { return low == other.low && high == other.high; }
    bool operator<(const Entry& other) const {
        return std::tie(low, high, side) < std::tie(other.low, other.high, other.side);
    }
};

[[noreturn]] void fail(const Entry& a) {
    throw InvalidRegion("triangles overlap beside the edge of points " + std::to_string(a.low) +
                            " and " + std::to_string(a.high),
                        {}, {a.low, a.high});
}

}  // namespace

std::vector<int> opposite_sides(std::span<const PlanarTriangle> triangles,
                                std::span<const DirectedEdge> fixed) {
    std::vector<Entry> entries;
    entries.reserve(3 * triangles.size() + fixed.size());
    const auto add = [&](PointId from, PointId to, int side) {
        entries.push_back({std::min(from, to), std::max(from, to), side});
    };
    for (int side = 0; side < static_cast<int>(3 * triangles.size()); ++side) {
        const PlanarTriangle& t = triangles[side / 3];
        add(t[side % 3], t[next_side(side) % 3], side);
    }
    for (const DirectedEdge& edge : fixed) {
        add(edge.from, edge.to, fixed_mark);
    }
    std::sort(entries.begin(), entries.end());

    std::vector<int> opposite(3 * triangles.size(), -1);
    for (std::size_t first = 0, last = 0; first < entries.size(); first = last) {
        while (last < entries.size() && entries[last].same_points(entries[first])) {
            ++last;
        }
        const auto sides = std::span(entries).subspan(first, last - first);
        const auto real = static_cast<std::size_t>(
            std::count_if(sides.begin(), sides.end(), [](const Entry& e) { return e.side >= 0; }));
        if (real < 2) {
            continue;
        }
        const int a = sides[sides.size() - 2].side;
        const int b = sides[sides.size() - 1].side;
        if (real > 2 || triangles[a / 3][a % 3] == triangles[b / 3][b % 3]) {
            fail(sides.front());
        }
        if (real == sides.size()) {
            opposite[a] = b;
            opposite[b] = a;
        }
    }
    return opposite;
}

}  // namespace tetra
