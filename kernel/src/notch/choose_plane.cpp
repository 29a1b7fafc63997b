// SPDX-License-Identifier: LGPL-2.1-or-later
// The cover of the notch graph and the ranking of planes within a piece.
#include "choose_plane.h"

#include <algorithm>
#include <map>
#include <set>

namespace tetra::notch {
namespace {

struct Candidate {
    int plane;
    int crossed = 0;
    int resolved = 0;
};

void cover(std::vector<Notch>& notches, std::uint64_t seed) {
    std::map<int, std::vector<int>> of_plane;
    for (int i = 0; i < static_cast<int>(notches.size()); ++i) {
        of_plane[notches[i].plane_a].push_back(i);
        of_plane[notches[i].plane_b].push_back(i);
    }
    // Most uncovered notches first; ties by a (seeded) rank of the plane.
    std::map<int, std::uint64_t> rank;
    std::uint64_t state = seed;
    for (const auto& [plane, list] : of_plane)
        rank[plane] = seed ? next_random(state) : static_cast<std::uint64_t>(plane);
    std::map<int, int> open;
    std::set<std::tuple<int, std::uint64_t, int>> queue;
    for (const auto& [plane, list] : of_plane) {
        open[plane] = static_cast<int>(list.size());
        queue.insert({-open[plane], rank[plane], plane});
    }
    const auto lower = [&](int plane) {
        queue.erase({-open[plane], rank[plane], plane});
        --open[plane];
        queue.insert({-open[plane], rank[plane], plane});
    };
    while (!queue.empty()) {
        const int plane = std::get<2>(*queue.begin());
        if (open[plane] == 0) break;
        for (const int i : of_plane[plane]) {
            Notch& n = notches[i];
            if (n.assigned >= 0) continue;
            n.assigned = plane;
            lower(n.plane_a);
            lower(n.plane_b);
        }
    }
}

}  // namespace

std::uint64_t next_random(std::uint64_t& state) {
    state += 0x9e3779b97f4a7c15u;
    std::uint64_t z = state;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return z ^ (z >> 31);
}

void assign_notches(std::vector<Notch>& notches, Rule rule, std::uint64_t seed) {
    if (rule == Rule::cover) {
        cover(notches, seed);
        return;
    }
    std::uint64_t state = seed;
    for (Notch& n : notches)
        n.assigned = rule == Rule::random && (next_random(state) & 1) ? n.plane_b : n.plane_a;
}

std::vector<int> ranked_planes(PointTable& points, const HalfEdges& edges, const Piece& piece,
                               const std::vector<Notch>& notches, Rule rule,
                               std::uint64_t& state) {
    std::vector<int> carried;  // half-edges of notches
    std::vector<int> planes;
    int lowest = -1;
    for (const int h : piece.edges) {
        const int n = edges[h].notch;
        if (n < 0 || h > edges[h].twin) continue;
        carried.push_back(h);
        planes.push_back(notches[n].assigned);
        if (lowest < 0 || n < lowest) lowest = n;
    }
    std::sort(planes.begin(), planes.end());
    planes.erase(std::unique(planes.begin(), planes.end()), planes.end());
    if (planes.empty()) return planes;
    if (rule == Rule::plain) {
        std::stable_partition(planes.begin(), planes.end(),
                              [&](int p) { return p == notches[lowest].assigned; });
        return planes;
    }
    if (rule == Rule::random) {
        for (std::size_t i = planes.size(); i > 1; --i)
            std::swap(planes[i - 1], planes[next_random(state) % i]);
        return planes;
    }
    std::vector<Candidate> ranked;
    for (const int p : planes) {
        Candidate c{p};
        for (const int h : carried) {
            const int a = points.side(edges[h].org, p), b = points.side(edges.dest(h), p);
            c.crossed += a * b < 0;
            c.resolved += a == 0 && b == 0;
        }
        ranked.push_back(c);
    }
    std::stable_sort(ranked.begin(), ranked.end(), [](const Candidate& a, const Candidate& b) {
        return a.crossed != b.crossed ? a.crossed < b.crossed : a.resolved > b.resolved;
    });
    for (std::size_t i = 0; i < planes.size(); ++i) planes[i] = ranked[i].plane;
    return planes;
}

}  // namespace tetra::notch
