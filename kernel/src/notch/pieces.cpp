// SPDX-License-Identifier: LGPL-2.1-or-later
// Flood fill over half-edges, then grouping by holes and cavities.
#include "pieces.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace tetra::notch {
namespace {

struct Box {
    Vec3d lo{1e300, 1e300, 1e300}, hi{-1e300, -1e300, -1e300};
    void add(const Vec3d& p) {
        for (int k = 0; k < 3; ++k) {
            lo[k] = std::min(lo[k], p[k]);
            hi[k] = std::max(hi[k], p[k]);
        }
    }
    bool holds(const Box& b, double slack) const {
        for (int k = 0; k < 3; ++k)
            if (b.lo[k] < lo[k] - slack || b.hi[k] > hi[k] + slack) return false;
        return true;
    }
};

struct Cycle {
    int surface;
    int key;
    double area;
    Box box;
};

struct Surface {
    double volume = 0, area = 0;
    Box box;
    bool has_holes = false;
    std::size_t begin = 0;
};

class Splitter {
  public:
    Splitter(const PointTable& points, const HalfEdges& edges, const std::vector<int>& all,
             Workspace& work)
        : points_(points), edges_(edges), all_(all), work_(work) {}

    std::vector<Piece> run(bool simple) {
        flood();
        if (simple || surfaces_.size() == 1) return one_each(simple);
        measure();
        parent_.resize(surfaces_.size());
        std::iota(parent_.begin(), parent_.end(), 0);
        join_holes();
        join_cavities();
        return collect();
    }

  private:
    bool labelled(int h) const { return work_.label_stamp[h] == work_.stamp; }
    void set_label(int h, int surface) {
        work_.label_stamp[h] = work_.stamp;
        work_.label[h] = surface;
    }

    std::vector<Piece> one_each(bool simple) const {
        std::vector<Piece> pieces(surfaces_.size());
        for (std::size_t i = 0; i < pieces.size(); ++i) {
            const auto from = order_.begin() + static_cast<std::ptrdiff_t>(surfaces_[i].begin);
            const auto to =
                i + 1 < pieces.size()
                    ? order_.begin() + static_cast<std::ptrdiff_t>(surfaces_[i + 1].begin)
                    : order_.end();
            pieces[i].edges.assign(from, to);
            pieces[i].simple = simple;
        }
        return pieces;
    }

    // Surfaces lie one after the other in order_.
    void flood() {
        const auto size = static_cast<std::size_t>(edges_.size());
        if (work_.label.size() < size) {
            work_.label.resize(size);
            work_.label_stamp.resize(size);
            work_.cycle_stamp.resize(size);
        }
        ++work_.stamp;
        order_.reserve(all_.size());
        for (const int seed : all_) {
            if (labelled(seed)) continue;
            const int s = static_cast<int>(surfaces_.size());
            surfaces_.emplace_back();
            std::size_t head = surfaces_.back().begin = order_.size();
            set_label(seed, s);
            order_.push_back(seed);
            for (; head < order_.size(); ++head) {
                const HalfEdge& e = edges_[order_[head]];
                for (const int n : {e.next, e.twin})
                    if (!labelled(n)) {
                        set_label(n, s);
                        order_.push_back(n);
                    }
            }
        }
    }

    void measure() {
        for (const int h : order_) {
            if (work_.cycle_stamp[h] == work_.stamp) continue;
            Cycle c{work_.label[h], edges_[h].key, 0, {}};
            Vec3d sum{0, 0, 0};
            const Vec3d& o = points_.approx(edges_[h].org);
            for (int i = h; work_.cycle_stamp[i] != work_.stamp; i = edges_[i].next) {
                work_.cycle_stamp[i] = work_.stamp;
                const Vec3d &p = points_.approx(edges_[i].org), &q = points_.approx(edges_.dest(i));
                const Vec3d a{p[0] - o[0], p[1] - o[1], p[2] - o[2]};
                const Vec3d b{q[0] - o[0], q[1] - o[1], q[2] - o[2]};
                for (int k = 0; k < 3; ++k) {
                    const int u = (k + 1) % 3, v = (k + 2) % 3;
                    sum[k] += a[u] * b[v] - a[v] * b[u];
                }
                c.box.add(p);
            }
            const std::array<double, 4>& n = points_.unit_plane(plane_of(c.key));
            c.area = key_sign(c.key) * (sum[0] * n[0] + sum[1] * n[1] + sum[2] * n[2]) / 2;
            Surface& s = surfaces_[c.surface];
            s.volume -= key_sign(c.key) * n[3] * c.area / 3;
            s.area += std::fabs(c.area);
            s.box.add(c.box.lo);
            s.box.add(c.box.hi);
            cycles_.push_back(c);
        }
    }

    int find(int s) {
        while (parent_[s] != s) s = parent_[s] = parent_[parent_[s]];
        return s;
    }
    void unite(int a, int b) {
        a = find(a);
        b = find(b);
        if (a != b) parent_[std::max(a, b)] = std::min(a, b);
    }

    // A cycle that may run clockwise may be a hole of any facet of its key around it.
    void join_holes() {
        std::vector<int> holes;
        for (int c = 0; c < static_cast<int>(cycles_.size()); ++c)
            if (cycles_[c].area <= slack(cycles_[c].box)) {
                holes.push_back(c);
                surfaces_[cycles_[c].surface].has_holes = true;
            }
        if (holes.empty()) return;
        std::stable_sort(holes.begin(), holes.end(),
                         [&](int a, int b) { return cycles_[a].key < cycles_[b].key; });
        for (const Cycle& outer : cycles_) {
            if (outer.area <= 0) continue;
            auto hole = std::lower_bound(holes.begin(), holes.end(), outer.key,
                                         [&](int c, int key) { return cycles_[c].key < key; });
            for (; hole != holes.end() && cycles_[*hole].key == outer.key; ++hole)
                if (&cycles_[*hole] != &outer && outer.box.holds(cycles_[*hole].box, work_.reach))
                    unite(cycles_[*hole].surface, outer.surface);
        }
    }

    // No area or volume below what misplaced vertices can make is trusted to be positive.
    double slack(const Box& b) const {
        double size = 1;
        for (int k = 0; k < 3; ++k) size += b.hi[k] - b.lo[k];
        return size * work_.reach;
    }

    // A surface that may enclose negative volume may be a cavity of any surface around it.
    void join_cavities() {
        for (std::size_t i = 0; i < surfaces_.size(); ++i) {
            const Surface& inner = surfaces_[i];
            if (inner.volume > work_.reach * inner.area) continue;
            for (std::size_t j = 0; j < surfaces_.size(); ++j)
                if (i != j && surfaces_[j].box.holds(inner.box, work_.reach))
                    unite(static_cast<int>(i), static_cast<int>(j));
        }
    }

    std::vector<Piece> collect() {
        std::vector<int> number(surfaces_.size(), -1);
        std::vector<Piece> pieces;
        for (const int h : order_) {
            int& n = number[find(work_.label[h])];
            if (n < 0) {
                n = static_cast<int>(pieces.size());
                pieces.emplace_back();
            }
            pieces[n].edges.push_back(h);
        }
        std::vector<int> surfaces(pieces.size(), 0);
        for (std::size_t i = 0; i < surfaces_.size(); ++i) {
            const int n = number[find(static_cast<int>(i))];
            pieces[n].simple = ++surfaces[n] == 1 && !surfaces_[i].has_holes;
        }
        return pieces;
    }

    const PointTable& points_;
    const HalfEdges& edges_;
    const std::vector<int>& all_;
    Workspace& work_;
    std::vector<int> order_, parent_;
    std::vector<Surface> surfaces_;
    std::vector<Cycle> cycles_;
};

}  // namespace

std::vector<Piece> split_pieces(const PointTable& points, const HalfEdges& edges,
                                const std::vector<int>& all, bool simple, Workspace& work) {
    return Splitter(points, edges, all, work).run(simple);
}

}  // namespace tetra::notch
