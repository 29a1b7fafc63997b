// SPDX-License-Identifier: LGPL-2.1-or-later
// Radial order at an edge, and the pairing of half-edges into twins.
#include "tetra/solid/sheets.h"

#include <algorithm>
#include <cassert>

#include "tetra/exact/predicates.h"
#include "tetra/solid/edges.h"

namespace tetra {
namespace {

// For coplanar u, v, a, b: on the same side of the line u-v?
bool same_side(const Vec3i& u, const Vec3i& v, const Vec3i& a, const Vec3i& b) {
    for (const auto& [i, j] : {std::pair{0, 1}, {1, 2}, {2, 0}})
        if (const int side = orient2d(u, v, a, i, j); side != 0)
            return side == orient2d(u, v, b, i, j);
    assert(false);
    return false;
}

// 0: start's half-plane, 1: the half turn after it, 2: opposite to it, 3: the other half turn.
int sector(const Vec3i& u, const Vec3i& v, const Vec3i& start, const Vec3i& a) {
    const int side = orient3d(u, v, start, a);
    if (side != 0) return side > 0 ? 1 : 3;
    return same_side(u, v, start, a) ? 0 : 2;
}

// Counter-clockwise around low -> high a backward half-edge begins solid, a forward one ends it.
struct Spoke {
    int half_edge;
    bool forward;
    const Vec3i* apex;
};

void match_brackets(const std::vector<Spoke>& spokes, std::vector<int>& twin) {
    std::vector<int> open;
    std::size_t left = spokes.size();
    for (std::size_t i = 0; left > 0; i = (i + 1) % spokes.size()) {
        const Spoke& s = spokes[i];
        if (twin[static_cast<std::size_t>(s.half_edge)] >= 0) continue;
        if (!s.forward) {
            if (open.empty() || std::find(open.begin(), open.end(), s.half_edge) == open.end())
                open.push_back(s.half_edge);
        } else if (!open.empty()) {
            twin[static_cast<std::size_t>(s.half_edge)] = open.back();
            twin[static_cast<std::size_t>(open.back())] = s.half_edge;
            open.pop_back();
            left -= 2;
        }
    }
}

}  // namespace

int compare_around(const Vec3i& u, const Vec3i& v, const Vec3i& start, const Vec3i& a,
                   const Vec3i& b) {
    const int sa = sector(u, v, start, a), sb = sector(u, v, start, b);
    if (sa != sb) return sa < sb ? -1 : 1;
    if (sa == 0 || sa == 2) return 0;
    return -orient3d(u, v, a, b);
}

Sheets pair_half_edges(std::span<const Vec3i> points, std::span<const Triangle> triangles,
                       std::span<const int> solid) {
    const auto point = [&](int v) -> const Vec3i& { return points[static_cast<std::size_t>(v)]; };
    const EdgeTable table = build_edges(triangles, solid);
    Sheets sheets;
    sheets.twin.assign(3 * triangles.size(), -1);
    std::vector<Spoke> spokes;
    for (std::size_t e = 0; e < table.edges.size(); ++e) {
        const std::span<const int> half_edges = table.of(e);
        if (half_edges.size() == 2) {
            sheets.twin[static_cast<std::size_t>(half_edges[0])] = half_edges[1];
            sheets.twin[static_cast<std::size_t>(half_edges[1])] = half_edges[0];
            continue;
        }
        ++sheets.type2_edges;
        const Vec3i &u = point(table.edges[e].low), &v = point(table.edges[e].high);
        spokes.clear();
        for (const int h : half_edges)
            spokes.push_back(
                {h, tail_of(triangles, h) == table.edges[e].low, &point(apex_of(triangles, h))});
        const Vec3i& start = *spokes.front().apex;
        std::sort(spokes.begin(), spokes.end(), [&](const Spoke& a, const Spoke& b) {
            const int order = compare_around(u, v, start, *a.apex, *b.apex);
            if (order != 0) return order < 0;
            if (a.forward != b.forward) return a.forward;  // solid ends before other solid begins
            return a.half_edge < b.half_edge;
        });
        match_brackets(spokes, sheets.twin);
    }
    return sheets;
}

}  // namespace tetra
