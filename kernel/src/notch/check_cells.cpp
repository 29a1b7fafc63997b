// SPDX-License-Identifier: LGPL-2.1-or-later
// Exact convexity of every cell and the volume identity modulo a prime.
#include "check_cells.h"

#include <algorithm>

#include "volume_residue.h"

namespace tetra::notch {
namespace {

class Checker {
  public:
    explicit Checker(Decomposition& result) : r_(result) {}

    Fault run() {
        seen_.assign(static_cast<std::size_t>(r_.edges.size()), 0);
        for (const int seed : r_.cells) {
            gather(seed);
            if (Fault fault = check_cell(); !fault.reason.empty()) return fault;
            if (r_.exact) surface_.insert(surface_.end(), cell_.begin(), cell_.end());
        }
        if (r_.exact && volume_residue(r_.points, r_.edges, surface_) != r_.volume)
            return {"volumes do not add up", {}};
        return {};
    }

  private:
    void gather(int seed) {
        cell_.assign(1, seed);
        seen_[seed] = 1;
        for (std::size_t i = 0; i < cell_.size(); ++i)
            for (const int n : {r_.edges[cell_[i]].next, r_.edges[cell_[i]].twin})
                if (!seen_[n]) {
                    seen_[n] = 1;
                    cell_.push_back(n);
                }
        facets_.clear();
        vertices_.clear();
        for (const int h : cell_) {
            vertices_.push_back(r_.edges[h].org);
            if (seen_[h] == 2) continue;
            facets_.push_back(h);
            for (int i = h; seen_[i] != 2; i = r_.edges[i].next) seen_[i] = 2;
        }
        std::sort(vertices_.begin(), vertices_.end());
        vertices_.erase(std::unique(vertices_.begin(), vertices_.end()), vertices_.end());
    }

    Fault check_cell() {
        std::vector<int> planes;
        for (const int f : facets_) planes.push_back(plane_of(r_.edges[f].key));
        std::sort(planes.begin(), planes.end());
        const auto twice = std::adjacent_find(planes.begin(), planes.end());
        if (twice != planes.end()) return {"two facets of a cell on one plane", {*twice}};
        for (const int h : cell_) {
            const HalfEdge& e = r_.edges[h];
            if (r_.edges[e.twin].twin != h || r_.edges[e.next].prev != h)
                return {"a cell is not closed", {}};
            if (e.notch >= 0) return {"a cell kept a notch", {}};
        }
        // Euler's formula of a sphere: V - E + F = 2.
        if (static_cast<long>(vertices_.size()) - static_cast<long>(cell_.size() / 2) +
                static_cast<long>(facets_.size()) !=
            2)
            return {"a cell is not a sphere", planes};
        for (const int f : facets_) {
            const int plane = plane_of(r_.edges[f].key), sign = key_sign(r_.edges[f].key);
            for (const int v : vertices_) {
                if (sign * r_.points.distance(v, plane) < -kClassReach) continue;
                if (sign * r_.points.distance(v, plane) > kClassReach ||
                    (r_.exact && r_.points.side(v, plane) * sign > 0))
                    return {"a cell is not convex", with(plane, r_.points.on(v))};
            }
        }
        return {};
    }

    static std::vector<int> with(int plane, std::vector<int> planes) {
        planes.push_back(plane);
        return planes;
    }

    Decomposition& r_;
    std::vector<char> seen_;
    std::vector<int> cell_, facets_, vertices_, surface_;
};

}  // namespace

Fault find_fault(Decomposition& result) { return Checker(result).run(); }

}  // namespace tetra::notch
