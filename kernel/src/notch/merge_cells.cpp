// SPDX-License-Identifier: LGPL-2.1-or-later
// Merging over a hash of facets, one pass with a queue.
#include "merge_cells.h"

#include <algorithm>
#include <deque>
#include <numeric>
#include <unordered_map>

namespace tetra::notch {
namespace {

class Merger {
  public:
    Merger(PointTable& points, HalfEdges& edges) : points_(points), edges_(edges) {}

    std::vector<int> run(const std::vector<int>& cells) {
        label_.assign(static_cast<std::size_t>(edges_.size()), -1);
        parent_.resize(cells.size());
        std::iota(parent_.begin(), parent_.end(), 0);
        for (std::size_t c = 0; c < cells.size(); ++c) register_cell(cells[c], static_cast<int>(c));
        while (!queue_.empty()) {
            const int h = queue_.front();
            queue_.pop_front();
            try_facet(h);
        }
        return survivors(cells.size());
    }

  private:
    int find(int c) {
        while (parent_[c] != c) c = parent_[c] = parent_[parent_[c]];
        return c;
    }

    void register_cell(int seed, int cell) {
        std::vector<int> order{seed};
        label_[seed] = cell;
        for (std::size_t i = 0; i < order.size(); ++i)
            for (const int n : {edges_[order[i]].next, edges_[order[i]].twin})
                if (label_[n] < 0) {
                    label_[n] = cell;
                    order.push_back(n);
                }
        seen_.resize(label_.size(), 0);
        for (const int h : order) {
            if (seen_[h]) continue;
            for (int i = h; !seen_[i]; i = edges_[i].next) seen_[i] = 1;
            register_facet(h);
        }
    }

    // Independent of where the cycle starts and of its direction.
    std::uint64_t hash(int h) const {
        std::uint64_t sum = 0;
        int i = h;
        do {
            std::uint64_t x = static_cast<std::uint64_t>(edges_[i].org) * 0x9e3779b97f4a7c15u;
            x ^= x >> 29;
            sum += x * 0xbf58476d1ce4e5b9u;
            i = edges_[i].next;
        } while (i != h);
        return sum * 31 + static_cast<std::uint64_t>(plane_of(edges_[h].key));
    }

    void register_facet(int h) {
        facets_[hash(h)].push_back(h);
        queue_.push_back(h);
    }

    // The half-edge of the other cell's equal facet that runs against h, or -1.
    int partner(int h) {
        const auto place = facets_.find(hash(h));
        if (place == facets_.end()) return -1;
        std::vector<int>& list = place->second;
        std::erase_if(list, [&](int f) { return !edges_.alive(f); });
        for (int f : list) {
            if (edges_[f].key != opposite_key(edges_[h].key)) continue;
            const int first = f;
            do {
                if (edges_.dest(f) == edges_[h].org && edges_[f].org == edges_.dest(h) &&
                    same_cycle(h, f))
                    return f;
                f = edges_[f].next;
            } while (f != first);
        }
        return -1;
    }

    bool same_cycle(int h, int f) const {
        int i = h, j = f;
        do {
            if (edges_[i].org != edges_.dest(j)) return false;
            i = edges_[i].next;
            j = edges_[j].prev;
        } while (i != h && j != f);
        return i == h && j == f;
    }

    void try_facet(int h) {
        if (!edges_.alive(h)) return;
        const int f = partner(h);
        if (f < 0 || find(label_[h]) == find(label_[f])) return;
        int i = h, j = f;
        do {
            if (!stays_convex(i, j)) return;
            i = edges_[i].next;
            j = edges_[j].prev;
        } while (i != h);
        join(h, f);
    }

    // Edge u -> w of the common facet in cell a, and its reverse in cell b.
    bool stays_convex(int i, int j) {
        const int a = edges_[edges_[i].twin].key, b = edges_[edges_[j].twin].key;
        if (a == b) return true;
        if (plane_of(a) == plane_of(b)) return false;
        // All of b's neighbouring facet lies inside a's plane when one vertex off the edge does.
        const int u = edges_[i].org, w = edges_.dest(i);
        int v = edges_[j].twin;
        do {
            v = edges_[v].next;
            const int p = edges_[v].org;
            if (p == u || p == w) continue;
            const int s = points_.side(p, plane_of(a)) * key_sign(a);
            if (s != 0) return s < 0;
        } while (v != edges_[j].twin);
        return false;
    }

    void join(int h, int f) {
        parent_[find(label_[f])] = find(label_[h]);
        std::vector<std::pair<int, int>> pairs;
        int i = h, j = f;
        do {
            pairs.push_back({i, j});
            i = edges_[i].next;
            j = edges_[j].prev;
        } while (i != h);
        std::vector<int> seams, touched;
        for (const auto& [p, q] : pairs) {
            const int a = edges_[p].twin, b = edges_[q].twin;
            edges_.pair(a, b);
            seams.push_back(a);
        }
        for (const auto& [p, q] : pairs) {
            edges_.remove(p);
            edges_.remove(q);
        }
        for (const int s : seams) {
            touched.push_back(s);
            touched.push_back(edges_[s].twin);
        }
        for (const int s : seams)
            if (edges_.alive(s) && edges_[s].key == edges_[edges_[s].twin].key)
                edges_.dissolve(s, touched);
        for (std::size_t k = 0; k < touched.size(); ++k) {
            const int t = touched[k];
            if (!edges_.alive(t)) continue;
            const int before = edges_[t].prev;
            if (edges_.straighten(t)) touched.push_back(before);
        }
        for (const int t : touched)
            if (edges_.alive(t)) {
                refresh(t);
                refresh(edges_[t].twin);
            }
    }

    void refresh(int h) {
        // A facet may be filed twice; stale entries no longer match their hash and do no harm.
        register_facet(h);
    }

    std::vector<int> survivors(std::size_t count) {
        std::vector<int> cells(count, -1);
        for (int h = 0; h < static_cast<int>(label_.size()); ++h)
            if (label_[h] >= 0 && edges_.alive(h)) {
                int& c = cells[static_cast<std::size_t>(find(label_[h]))];
                if (c < 0) c = h;
            }
        std::erase(cells, -1);
        return cells;
    }

    PointTable& points_;
    HalfEdges& edges_;
    std::vector<int> label_, parent_;
    std::vector<char> seen_;
    std::deque<int> queue_;
    std::unordered_map<std::uint64_t, std::vector<int>> facets_;
};

}  // namespace

std::vector<int> merge_cells(PointTable& points, HalfEdges& edges, const std::vector<int>& cells) {
    return Merger(points, edges).run(cells);
}

}  // namespace tetra::notch
