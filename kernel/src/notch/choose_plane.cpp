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
                                     const std::vector<int>& excluded, std::vector<int>& count) {
    std::vector<Candidate> list;
    for (const int p : planes_of_edges)
        if (count[p]++ == 0 && std::find(excluded.begin(), excluded.end(), p) == excluded.end())
            list.push_back({p, 0});
    for (Candidate& c : list) c.carried = count[c.plane];
    for (const int p : planes_of_edges) count[p] = 0;
    std::sort(list.begin(), list.end(), [](const Candidate& a, const Candidate& b) {
        return a.carried != b.carried ? a.carried > b.carried : a.plane < b.plane;
    });
    return list;
}

constexpr std::size_t kBlock = 64, kChoiceBudget = 2'000'000;

// Ends of the notch edges of a piece, one array per coordinate and padded to whole blocks, so
// that the compiler can use its vector units.
struct EdgeEnds {
    std::array<std::vector<double>, 6> at;
    std::size_t size = 0;
    void reserve(std::size_t n) {
        for (std::vector<double>& a : at) a.assign((n + kBlock - 1) / kBlock * kBlock, 0);
    }
    void add(const Vec3d& u, const Vec3d& v) {
        for (int k = 0; k < 3; ++k) {
            at[k][size] = u[k];
            at[k + 3][size] = v[k];
        }
        ++size;
    }
};

// How many edges a plane crosses, given up once that is `limit` or more. Padding is one point
// twice, which no plane crosses.
int count_crossed(const EdgeEnds& ends, const std::array<double, 4>& n, double reach, int limit) {
    int crossed = 0;
    for (std::size_t from = 0; from < ends.size && crossed < limit; from += kBlock) {
        std::array<const double*, 6> p;
        for (int k = 0; k < 6; ++k) p[k] = ends.at[k].data() + from;
        std::array<double, kBlock> u, v;
        for (std::size_t i = 0; i < kBlock; ++i) {
            u[i] = n[0] * p[0][i] + n[1] * p[1][i] + n[2] * p[2][i] + n[3];
            v[i] = n[0] * p[3][i] + n[1] * p[4][i] + n[2] * p[5][i] + n[3];
        }
        for (std::size_t i = 0; i < kBlock; ++i)
            crossed += static_cast<int>(u[i] > reach) & static_cast<int>(v[i] < -reach);
        for (std::size_t i = 0; i < kBlock; ++i)
            crossed += static_cast<int>(u[i] < -reach) & static_cast<int>(v[i] > reach);
    }
    return crossed;
}

// The first of the candidates that cross fewest edges. Those whose known bound is no better than
// the best so far are not counted; the piece keeps what was learnt.
int fewest_crossed(const PointTable& points, const std::vector<Candidate>& list,
                   const EdgeEnds& ends, double reach, Piece& piece, std::vector<int>& bound) {
    bound.resize(static_cast<std::size_t>(points.planes()), 0);
    for (const auto& [plane, least] : piece.crossed_at_least) bound[plane] = least;
    piece.clear_planes.clear();
    int best = -1, fewest = static_cast<int>(ends.size) + 1;
    const auto count = [&](int plane) {
        // Counting beyond what decides here pays off as a bound for the parts.
        const int limit = std::max(fewest, 1) + static_cast<int>(ends.size / 8);
        const int crossed = count_crossed(ends, points.unit_plane(plane), reach, limit);
        bound[plane] = std::max(bound[plane], crossed);
        if (crossed == 0) piece.clear_planes.push_back(plane);
        if (crossed >= fewest) return;
        best = plane;
        fewest = crossed;
    };
    const Candidate* hopeful = &list.front();
    for (const Candidate& c : list)
        if (bound[c.plane] < bound[hopeful->plane]) hopeful = &c;
    count(hopeful->plane);
    // In a huge piece some hundred good candidates are as good as all.
    std::size_t budget = kChoiceBudget / ends.size + 64;
    for (const Candidate& c : list) {
        if (&c == hopeful || bound[c.plane] >= std::max(fewest, 1)) continue;
        if (budget-- == 0) break;
        count(c.plane);
    }
    piece.crossed_at_least.clear();
    for (const Candidate& c : list) piece.crossed_at_least.push_back({c.plane, bound[c.plane]});
    for (const Candidate& c : list) bound[c.plane] = 0;
    std::sort(piece.clear_planes.begin(), piece.clear_planes.end());
    return best;
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

int choose_plane(PointTable& points, const HalfEdges& edges, Piece& piece,
                 const std::vector<Notch>& notches, Rule rule, double reach,
                 const std::vector<int>& excluded, std::uint64_t& state, Workspace& work) {
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
    work.plane_count.resize(static_cast<std::size_t>(points.planes()), 0);
    piece.notch_edges = static_cast<int>(planes.size());
    const std::vector<Candidate> list = candidates_of(planes, excluded, work.plane_count);
    if (list.empty()) return -1;
    if (rule == Rule::random) return list[next_random(state) % list.size()].plane;
    if (rule == Rule::plain && excluded.empty()) return notches[lowest].assigned;
    for (const Candidate& c : list)
        if (std::binary_search(piece.clear_planes.begin(), piece.clear_planes.end(), c.plane))
            return c.plane;
    EdgeEnds ends;
    ends.reserve(carried.size());
    for (const int h : carried) ends.add(points.approx(edges[h].org), points.approx(edges.dest(h)));
    return fewest_crossed(points, list, ends, reach, piece, work.plane_bound);
}

void inherit_bounds(const Piece& parent, const HalfEdges& edges, int split, Piece& part) {
    part.clear_planes = parent.clear_planes;
    int here = 0;
    for (const int h : part.edges) here += edges[h].notch >= 0 && h < edges[h].twin;
    // Every edge that is not in the part as it was may have been crossed.
    const int lost = parent.notch_edges - here + split;
    for (const auto& [plane, least] : parent.crossed_at_least)
        if (least > lost) part.crossed_at_least.push_back({plane, least - lost});
}

}  // namespace tetra::notch
