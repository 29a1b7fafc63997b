// SPDX-License-Identifier: LGPL-2.1-or-later
// The cover of the notch graph and the ranking of planes within a piece.
#include "choose_plane.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <map>
#include <queue>

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

constexpr std::size_t kBlock = 64;

// Ends of the notch edges of a piece, one array per coordinate and padded to whole blocks, so
// that the compiler can use its vector units; floats do for a choice. Padding is no number: it is
// neither above nor below anything.
struct EdgeEnds {
    std::array<std::vector<float>, 6> at;
    std::size_t size = 0;
    void reserve(std::size_t n) {
        for (std::vector<float>& a : at)
            a.assign((n + kBlock - 1) / kBlock * kBlock, std::numeric_limits<float>::quiet_NaN());
    }
    void add(const Vec3d& u, const Vec3d& v) {
        for (int k = 0; k < 3; ++k) {
            at[k][size] = static_cast<float>(u[k]);
            at[k + 3][size] = static_cast<float>(v[k]);
        }
        ++size;
    }
};

// What floats may miss a plane by on a grid of 26 bits, in steps.
constexpr float kFloatReach = 32;

// Notch edges with a part above a plane, with a part below, and with both.
struct Tally {
    int above = 0, below = 0, crossed = 0;
};

Tally tally(const EdgeEnds& ends, const std::array<double, 4>& unit) {
    std::array<float, 4> n;
    for (int k = 0; k < 4; ++k) n[k] = static_cast<float>(unit[k]);
    Tally t;
    for (std::size_t from = 0; from < ends.size; from += kBlock) {
        std::array<const float*, 6> p;
        for (int k = 0; k < 6; ++k) p[k] = ends.at[k].data() + from;
        std::array<float, kBlock> u, v;
        for (std::size_t i = 0; i < kBlock; ++i) {
            u[i] = n[0] * p[0][i] + n[1] * p[1][i] + n[2] * p[2][i] + n[3];
            v[i] = n[0] * p[3][i] + n[1] * p[4][i] + n[2] * p[5][i] + n[3];
        }
        for (std::size_t i = 0; i < kBlock; ++i) {
            const int above =
                static_cast<int>(u[i] > kFloatReach) | static_cast<int>(v[i] > kFloatReach);
            const int below =
                static_cast<int>(u[i] < -kFloatReach) | static_cast<int>(v[i] < -kFloatReach);
            t.above += above;
            t.below += below;
            t.crossed += above & below;
        }
    }
    return t;
}

// m log2 m with a logarithm that is linear between powers of two: the same on every machine.
double entropy(int m) {
    if (m < 2) return 0;
    const int k = std::bit_width(static_cast<unsigned>(m)) - 1;
    const double part = std::ldexp(static_cast<double>(m), -k);
    return static_cast<double>(m) * (k + part - 1);
}

// Products of candidates and notch edges that are looked at for one choice.
constexpr std::size_t kChoiceBudget = 200'000;

// What a notch edge will be crossed by later on, in units of the mean share of notch edges that
// planes of the piece cross, per bit of entropy of what a cut leaves on either side.
constexpr double kLaterCrossings = 3;
constexpr double kHalvesAreQuicker = 1e-6;

// Pieces of more notch edges are cut through, not only where the plane carries a notch: they have
// to become small before their planes cross each other.
constexpr std::size_t kHugePiece = 1000;

// The plane that crosses few notch edges now and, since small pieces are crossed by few planes,
// leaves few on the larger side. One that crosses none is better than any that does.
int best_plane(const PointTable& points, const std::vector<Candidate>& list, const EdgeEnds& ends) {
    const std::size_t most = kChoiceBudget / ends.size + 64;
    const std::size_t stride = (list.size() + most - 1) / most;
    std::vector<Tally> tallies;
    double crossed = 0;
    for (std::size_t i = 0; i < list.size(); i += stride) {
        tallies.push_back(tally(ends, points.unit_plane(list[i].plane)));
        crossed += tallies.back().crossed;
    }
    const double share =
        crossed / (static_cast<double>(tallies.size()) * static_cast<double>(ends.size));
    int best = -1;
    bool clear = false;
    double least = 0;
    for (std::size_t i = 0; i < tallies.size(); ++i) {
        const Tally& t = tallies[i];
        if (clear && t.crossed > 0) continue;
        // With nothing crossed anywhere halves are still quicker than slices.
        const double later = kLaterCrossings * share + kHalvesAreQuicker;
        const double cost = t.crossed + later * (entropy(t.above) + entropy(t.below));
        if (best >= 0 && clear == (t.crossed == 0) && cost >= least) continue;
        best = list[i * stride].plane;
        clear = t.crossed == 0;
        least = cost;
    }
    return best;
}

// Of the planes open to it each step takes the one with most uncovered notches; ties by a
// (seeded) rank of the plane.
void cover(std::vector<Notch>& notches, std::uint64_t seed) {
    std::map<int, std::vector<int>> of_plane;
    for (int i = 0; i < static_cast<int>(notches.size()); ++i) {
        of_plane[notches[i].plane_a].push_back(i);
        of_plane[notches[i].plane_b].push_back(i);
    }
    struct Entry {
        int open;
        std::uint64_t rank;
        int plane;
        bool operator<(const Entry& b) const {  // the greatest comes first
            return open != b.open ? open < b.open
                                  : (rank != b.rank ? rank > b.rank : plane > b.plane);
        }
    };
    std::map<int, Entry> now;
    std::priority_queue<Entry> queue;
    std::uint64_t state = seed;
    for (const auto& [plane, list] : of_plane) {
        const auto rank = seed ? next_random(state) : static_cast<std::uint64_t>(plane);
        now[plane] = {static_cast<int>(list.size()), rank, plane};
        queue.push(now[plane]);
    }
    while (!queue.empty()) {
        const Entry top = queue.top();
        queue.pop();
        Entry& entry = now[top.plane];
        if (entry.open == 0) continue;
        if (top.open != entry.open) {  // was filed before some of its notches were covered
            queue.push(entry);
            continue;
        }
        for (const int i : of_plane[top.plane]) {
            Notch& n = notches[i];
            if (n.assigned >= 0) continue;
            n.assigned = top.plane;
            --now[n.plane_a].open;
            --now[n.plane_b].open;
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

Choice choose_plane(const PointTable& points, const HalfEdges& edges, const Piece& piece,
                    const std::vector<Notch>& notches, Rule rule, const std::vector<int>& excluded,
                    std::uint64_t& state, Workspace& work) {
    std::vector<int>& carried = work.notch_edges;
    std::vector<int>& planes = work.planes;
    carried.clear();
    planes.clear();
    int lowest = -1;
    for (const int h : piece.edges) {
        const int n = edges[h].notch;
        if (n < 0 || h > edges[h].twin) continue;
        carried.push_back(h);
        planes.push_back(notches[n].assigned);
        if (lowest < 0 || n < lowest) lowest = n;
    }
    work.plane_count.resize(static_cast<std::size_t>(points.planes()), 0);
    const std::vector<Candidate> list = candidates_of(planes, excluded, work.plane_count);
    if (list.empty()) return {};
    if (list.size() == 1) return {list.front().plane, false};
    if (rule == Rule::random) return {list[next_random(state) % list.size()].plane, false};
    if (rule == Rule::plain && excluded.empty()) return {notches[lowest].assigned, false};
    EdgeEnds ends;
    ends.reserve(carried.size());
    for (const int h : carried) ends.add(points.approx(edges[h].org), points.approx(edges.dest(h)));
    return {best_plane(points, list, ends), ends.size > kHugePiece};
}

}  // namespace tetra::notch
