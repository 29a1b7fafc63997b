// SPDX-License-Identifier: LGPL-2.1-or-later
// Exact convexity of every cell and the volume identity modulo a prime.
#include "check_cells.h"

#include <algorithm>

namespace tetra::notch {
namespace {

class Checker {
public:
    Checker(const GridSolid& solid, Decomposition& result, bool exact)
        : solid_(solid), r_(result), exact_(exact) {}

    Fault run() {
        seen_.assign(static_cast<std::size_t>(r_.edges.size()), 0);
        for (const int seed : r_.cells) {
            gather(seed);
            if (Fault fault = check_cell(); !fault.reason.empty()) return fault;
            if (exact_) add_volume();
        }
        if (exact_ && total_ != solid_volume()) return {"volumes do not add up", {}};
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
                    (exact_ && r_.points.side(v, plane) * sign > 0))
                    return {"a cell is not convex", with(plane, r_.points.on(v))};
            }
        }
        return {};
    }

    static std::vector<int> with(int plane, std::vector<int> planes) {
        planes.push_back(plane);
        return planes;
    }

    std::array<std::uint64_t, 3> residue(int v) {
        if (residues_.size() < static_cast<std::size_t>(r_.points.points())) {
            residues_.resize(static_cast<std::size_t>(r_.points.points()));
            known_.resize(residues_.size(), 0);
        }
        if (!known_[v]) {
            residues_[v] = residues(r_.points.exact(v));
            known_[v] = 1;
        }
        return residues_[v];
    }

    static std::uint64_t minus(std::uint64_t a, std::uint64_t b) {
        return a >= b ? a - b : a + kHashPrime - b;
    }
    static std::uint64_t plus(std::uint64_t a, std::uint64_t b) {
        const std::uint64_t s = a + b;
        return s >= kHashPrime ? s - kHashPrime : s;
    }

    // Six times the signed volume of (origin, a, b, c).
    std::uint64_t determinant(int a, int b, int c) {
        const auto p = residue(a), q = residue(b), r = residue(c);
        std::uint64_t sum = 0;
        for (int k = 0; k < 3; ++k) {
            const int u = (k + 1) % 3, v = (k + 2) % 3;
            sum = plus(sum, multiply_mod(p[k], minus(multiply_mod(q[u], r[v]),
                                                     multiply_mod(q[v], r[u]))));
        }
        return sum;
    }

    void add_volume() {
        for (const int f : facets_) {
            const int first = r_.edges[f].org;
            for (int i = r_.edges[f].next; r_.edges[i].next != f; i = r_.edges[i].next)
                total_ = plus(total_, determinant(first, r_.edges[i].org, r_.edges.dest(i)));
        }
    }

    std::uint64_t solid_volume() {
        std::uint64_t sum = 0;
        for (const Triangle& t : solid_.triangles) sum = plus(sum, determinant(t[0], t[1], t[2]));
        return sum;
    }

    const GridSolid& solid_;
    Decomposition& r_;
    bool exact_;
    std::vector<char> seen_, known_;
    std::vector<int> cell_, facets_, vertices_;
    std::vector<std::array<std::uint64_t, 3>> residues_;
    std::uint64_t total_ = 0;
};

}  // namespace

Fault find_fault(const GridSolid& solid, Decomposition& result, bool exact) {
    return Checker(solid, result, exact).run();
}

}  // namespace tetra::notch
