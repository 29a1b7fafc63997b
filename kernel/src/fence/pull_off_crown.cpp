// SPDX-License-Identifier: LGPL-2.1-or-later
// The link of a vertex as a cycle, its flips, and the dome by interval recursion.
#include "pull_off_crown.h"

#include <algorithm>
#include <utility>

#include "tetra/exact/predicates.h"

namespace tetra {
namespace {

// The link of v as one cycle from the smallest id; empty when it is no single cycle.
const std::vector<LinkEdge>& link_cycle(const PullSurface& surface, int v, LinkBuffers& link) {
    auto& [edges, cycle] = link;
    edges.clear();
    cycle.clear();
    for (const int id : surface.star_of(v)) {
        const Triangle& t = surface.triangle(id);
        const std::size_t k = t[0] == v ? 0 : (t[1] == v ? 1 : 2);
        edges.push_back({t[(k + 1) % 3], t[(k + 2) % 3], surface.owner(id)});
    }
    const auto by_from = [](const LinkEdge& a, const LinkEdge& b) { return a.from < b.from; };
    std::sort(edges.begin(), edges.end(), by_from);
    for (std::size_t i = 0; i + 1 < edges.size(); ++i)
        if (edges[i].from == edges[i + 1].from) return cycle;
    if (edges.size() < 3) return cycle;
    LinkEdge next = edges.front();
    while (cycle.size() < edges.size()) {
        cycle.push_back(next);
        if (next.to == edges.front().from) break;
        const auto place =
            std::lower_bound(edges.begin(), edges.end(), LinkEdge{next.to, 0, 0}, by_from);
        if (place == edges.end() || place->from != next.to) break;
        next = *place;
    }
    if (cycle.size() != edges.size() || cycle.back().to != edges.front().from) cycle.clear();
    return cycle;
}

// For coplanar v, u, w, x: +1 when w lies strictly beyond segment ux as seen from v, 0 on it.
int beyond(const PullSurface& s, int v, int u, int w, int x) {
    static constexpr int kPairs[3][2] = {{0, 1}, {1, 2}, {2, 0}};
    for (const auto& pair : kPairs) {
        const int side = orient2d(s.point(v), s.point(u), s.point(w), pair[0], pair[1]);
        if (side == 0) continue;
        return side * orient2d(s.point(u), s.point(w), s.point(x), pair[0], pair[1]);
    }
    return 0;
}

// One sweep of flips along the ring; returns whether anything changed.
bool flip_sweep(const PullSurface& s, int v, Crown& crown) {
    bool changed = false;
    for (std::size_t i = 0; i < crown.ring.size() && crown.ring.size() > 3;) {
        const std::size_t n = crown.ring.size();
        const std::size_t before = (i + n - 1) % n, after = (i + 1) % n;
        const int u = crown.ring[before], w = crown.ring[i], x = crown.ring[after];
        if (orient3d(s.point(v), s.point(u), s.point(w), s.point(x)) != 0 ||
            beyond(s, v, u, w, x) <= 0) {
            ++i;
            continue;
        }
        if (crown.owner[before] != crown.owner[i]) {
            crown.kind = PulledKind::mixed_owners;
            return false;
        }
        crown.flips.push_back({u, w, x, crown.owner[i]});
        crown.ring.erase(crown.ring.begin() + static_cast<std::ptrdiff_t>(i));
        crown.owner.erase(crown.owner.begin() + static_cast<std::ptrdiff_t>(i));
        changed = true;
        if (i > 0) --i;
    }
    return changed;
}

class DomeSearch {
  public:
    DomeSearch(const PullSurface& surface, int v, const std::vector<int>& ring)
        : s_(surface),
          v_(v),
          ring_(ring),
          n_(static_cast<int>(ring.size())),
          choice_(ring.size() * ring.size(), kUnknown) {}

    std::vector<Triangle> run() {
        std::vector<Triangle> dome;
        if (solve(0, n_ - 1)) collect(0, n_ - 1, dome);
        return dome;
    }

  private:
    static constexpr int kUnknown = -2, kNone = -1;

    int& choice(int i, int j) { return choice_[static_cast<std::size_t>(i * n_ + j)]; }

    const Vec3i& at(int i) const { return s_.point(ring_[static_cast<std::size_t>(i)]); }

    // Positions whose triangle over base (i, j) has v on its outer side and no other crown point
    // of the interval there.
    std::vector<int> apexes(int i, int j) const {
        std::vector<int> possible, result;
        int best = -1;
        for (int m = i + 1; m < j; ++m) {
            if (orient3d(at(i), at(m), at(j), s_.point(v_)) <= 0) continue;
            possible.push_back(m);
            if (best < 0 || orient3d(at(i), at(best), at(j), at(m)) > 0) best = m;
        }
        if (best < 0) return result;
        for (int m = i + 1; m < j; ++m)
            if (m != best && orient3d(at(i), at(best), at(j), at(m)) > 0) return result;
        for (const int m : possible)
            if (m == best || orient3d(at(i), at(best), at(j), at(m)) == 0) result.push_back(m);
        return result;
    }

    // Ties are tried in turn: a wrong one can leave a flat triangle among collinear crown points.
    bool solve(int i, int j) {
        if (j - i < 2) return true;
        if (choice(i, j) != kUnknown) return choice(i, j) != kNone;
        choice(i, j) = kNone;
        for (const int m : apexes(i, j))
            if (solve(i, m) && solve(m, j)) {
                choice(i, j) = m;
                return true;
            }
        return false;
    }

    void collect(int i, int j, std::vector<Triangle>& dome) {
        if (j - i < 2) return;
        const int m = choice(i, j);
        dome.push_back({i, m, j});
        collect(i, m, dome);
        collect(m, j, dome);
    }

    const PullSurface& s_;
    int v_;
    const std::vector<int>& ring_;
    int n_;
    std::vector<int> choice_;
};

}  // namespace

Crown crown_of(const PullSurface& surface, int v, LinkBuffers& link) {
    Crown crown;
    const std::vector<LinkEdge>& cycle = link_cycle(surface, v, link);
    if (cycle.empty()) {
        crown.kind = PulledKind::nonmanifold;
        return crown;
    }
    int convex = 0;
    const std::size_t n = cycle.size();
    for (std::size_t i = 0; i < n; ++i) {
        const int side = orient3d(surface.point(v), surface.point(cycle[i].from),
                                  surface.point(cycle[i].to), surface.point(cycle[(i + 1) % n].to));
        if (side > 0) {
            crown.kind = PulledKind::reflex;
            return crown;
        }
        if (side < 0) ++convex;
    }
    if (convex < 3) {
        crown.kind = PulledKind::flat;
        return crown;
    }
    for (const LinkEdge& edge : cycle) {
        crown.ring.push_back(edge.from);
        crown.owner.push_back(edge.owner);
    }
    while (flip_sweep(surface, v, crown)) {
    }
    return crown;
}

std::vector<Triangle> dome_of(const PullSurface& surface, int v, const std::vector<int>& ring) {
    return DomeSearch(surface, v, ring).run();
}

}  // namespace tetra
