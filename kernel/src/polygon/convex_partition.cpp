// SPDX-License-Identifier: LGPL-2.1-or-later
// Hertel-Mehlhorn on the sides of the triangles, linked into growing polygons.
//
// The edges are tried in the order of their worth. An edge is worth one point at each end where
// it alone can cut a reflex angle into two that are at most straight: if such edges stay until
// the others are gone, one edge is enough there.

#include "tetra/polygon/convex_partition.h"

#include <algorithm>

#include "half_edges.h"

namespace tetra {

namespace {

class Merger {
  public:
    Merger(std::span<const PlanarTriangle> triangles, std::span<const DirectedEdge> fixed,
           const PointOracle& oracle)
        : triangles_(triangles), oracle_(oracle), opposite_(opposite_sides(triangles, fixed)) {
        for (int side = 0; side < static_cast<int>(opposite_.size()); ++side) {
            next_.push_back(next_side(side));
            previous_.push_back(previous_side(side));
        }
        dropped_.assign(opposite_.size(), 0);
    }

    void run() {
        const std::vector<char> worth = worth_of_edges();
        for (const int wanted : {0, 1, 2}) {
            for (int side = 0; side < static_cast<int>(opposite_.size()); ++side) {
                if (side < opposite_[side] && worth[side] == wanted &&
                    is_needless(side, opposite_[side]) && is_needless(opposite_[side], side)) {
                    drop(side, opposite_[side]);
                }
            }
        }
    }

    std::vector<std::vector<PointId>> polygons() {
        std::vector<std::vector<PointId>> out;
        std::vector<char> seen = dropped_;
        for (int side = 0; side < static_cast<int>(next_.size()); ++side) {
            if (seen[side] != 0) {
                continue;
            }
            out.emplace_back();
            for (int at = side; seen[at] == 0; at = next_[at]) {
                seen[at] = 1;
                out.back().push_back(start_of(at));
            }
        }
        return out;
    }

  private:
    PointId start_of(int side) const { return triangles_[side / 3][side % 3]; }
    PointId end_of(int side) const { return start_of(next_side(side)); }

    /// Per edge, stored at the lower of its sides.
    std::vector<char> worth_of_edges() const {
        std::vector<char> worth(opposite_.size(), 0);
        std::vector<int> around;
        for (int first = 0; first < static_cast<int>(opposite_.size()); ++first) {
            if (opposite_[first] >= 0) {
                continue;
            }
            // All sides that leave the start of this boundary side, counter-clockwise.
            around.assign(1, first);
            int last = previous_side(first);
            while (opposite_[last] >= 0) {
                around.push_back(opposite_[last]);
                last = previous_side(opposite_[last]);
            }
            add_worth(around, start_of(last), worth);
        }
        return worth;
    }

    /// \param last the other neighbour on the boundary.
    void add_worth(const std::vector<int>& around, PointId last, std::vector<char>& worth) const {
        const PointId at = start_of(around.front());
        const PointId first = end_of(around.front());
        if (around.size() == 1 || (first != last && oracle_.orient(at, first, last) >= 0)) {
            return;
        }
        for (std::size_t k = 1; k < around.size(); ++k) {
            const PointId end = end_of(around[k]);
            if (oracle_.orient(at, first, end) >= 0 && oracle_.orient(at, end, last) >= 0) {
                ++worth[std::min(around[k], opposite_[around[k]])];
            }
        }
    }

    /// Whether the angle at the start of the side stays at most straight without it. A full angle
    /// shows as the same neighbour on both sides: there the edge is the last but one at its point.
    bool is_needless(int side, int other) const {
        const PointId before = start_of(previous_[side]);
        const PointId at = start_of(side);
        const PointId after = start_of(next_[next_[other]]);
        return before != after && oracle_.orient(before, at, after) >= 0;
    }

    void drop(int side, int other) {
        dropped_[side] = 1;
        dropped_[other] = 1;
        join(previous_[side], next_[other]);
        join(previous_[other], next_[side]);
    }

    void join(int first, int second) {
        next_[first] = second;
        previous_[second] = first;
    }

    std::span<const PlanarTriangle> triangles_;
    const PointOracle& oracle_;
    std::vector<int> opposite_;
    std::vector<int> next_;
    std::vector<int> previous_;
    std::vector<char> dropped_;
};

}  // namespace

std::vector<std::vector<PointId>> convex_partition(std::span<const PlanarTriangle> triangles,
                                                   std::span<const DirectedEdge> fixed,
                                                   const PointOracle& oracle) {
    Merger merger(triangles, fixed, oracle);
    merger.run();
    return merger.polygons();
}

}  // namespace tetra
