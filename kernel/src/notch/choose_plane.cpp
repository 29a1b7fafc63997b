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
    int carried;  // notch edges of the piece that are assigned to it
};

// Planes of the piece's notches, most carried first.
std::vector<Candidate> candidates_of(const std::vector<int>& planes_of_edges,
                                     const std::vector<int>& excluded) {
    std::vector<int> planes = planes_of_edges;
    std::sort(planes.begin(), planes.end());
    std::vector<Candidate> list;
    for (std::size_t i = 0, j; i < planes.size(); i = j) {
        for (j = i; j < planes.size() && planes[j] == planes[i];) ++j;
        if (std::find(excluded.begin(), excluded.end(), planes[i]) == excluded.end())
            list.push_back({planes[i], static_cast<int>(j - i)});
    }
    std::stable_sort(list.begin(), list.end(), [](const Candidate& a, const Candidate& b) {
        return a.carried > b.carried;
    });
    return list;
}

// Ends of the notch edges of a piece, one array per coordinate for the vector units.
struct EdgeEnds {
    std::array<std::vector<double>, 6> at;
    std::size_t size() const { return at[0].size(); }
    void add(const Vec3d& u, const Vec3d& v) {
        for (int k = 0; k < 3; ++k) {
            at[k].push_back(u[k]);
            at[k + 3].push_back(v[k]);
        }
    }
};

// How many edges a plane crosses, given up once that is `limit` or more.
int count_crossed(const EdgeEnds& ends, const std::array<double, 4>& n, double reach, int limit) {
    int crossed = 0;
    for (std::size_t from = 0; from < ends.size() && crossed < limit; from += 128) {
        const std::size_t to = std::min(from + 128, ends.size());
        int here = 0;
        for (std::size_t i = from; i < to; ++i) {
            const double u = n[0] * ends.at[0][i] + n[1] * ends.at[1][i] + n[2] * ends.at[2][i];
            const double v = n[0] * ends.at[3][i] + n[1] * ends.at[4][i] + n[2] * ends.at[5][i];
            const double low = std::min(u, v) + n[3], high = std::max(u, v) + n[3];
            here += low < -reach && high > reach;
        }
        crossed += here;
    }
    return crossed;
}

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

int choose_plane(PointTable& points, const HalfEdges& edges, const Piece& piece,
                 const std::vector<Notch>& notches, Rule rule, double reach,
                 const std::vector<int>& excluded, std::uint64_t& state) {
    EdgeEnds ends;
    std::vector<int> planes;
    int lowest = -1;
    for (const int h : piece.edges) {
        const int n = edges[h].notch;
        if (n < 0 || h > edges[h].twin) continue;
        if (rule == Rule::cover) ends.add(points.approx(edges[h].org), points.approx(edges.dest(h)));
        planes.push_back(notches[n].assigned);
        if (lowest < 0 || n < lowest) lowest = n;
    }
    const std::vector<Candidate> list = candidates_of(planes, excluded);
    if (list.empty()) return -1;
    if (rule == Rule::random) return list[next_random(state) % list.size()].plane;
    if (rule == Rule::plain && excluded.empty()) return notches[lowest].assigned;
    int best = -1, fewest = static_cast<int>(planes.size()) + 1;
    for (const Candidate& c : list) {
        const int crossed = count_crossed(ends, points.unit_plane(c.plane), reach, fewest);
        if (crossed >= fewest) continue;
        best = c.plane;
        fewest = crossed;
        if (fewest == 0) break;
    }
    return best;
}

}  // namespace tetra::notch
