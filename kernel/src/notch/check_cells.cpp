// SPDX-License-Identifier: LGPL-2.1-or-later
// Exact convexity of every cell and the volume identity modulo a prime.
#include "check_cells.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "volume_residue.h"

namespace tetra::notch {
namespace {

class Checker {
  public:
    Checker(const Grid& grid, Decomposition& result)
        : grid_(grid), r_(result), farthest_off_(std::ldexp(1.0, grid.bits - 23)) {}

    std::vector<Fault> run() {
        seen_.assign(static_cast<std::size_t>(r_.edges.size()), 0);
        std::vector<Fault> faults;
        for (const int seed : r_.cells) {
            gather(seed);
            std::optional<Fault> fault = check_cell();
            if (!fault && !r_.placed.empty()) fault = check_places();
            if (fault) faults.push_back(std::move(*fault));
            if (r_.exact) surface_.insert(surface_.end(), cell_.begin(), cell_.end());
        }
        if (r_.exact && faults.empty() &&
            volume_residue(r_.points, r_.edges, surface_) != r_.volume)
            faults.push_back({"volumes do not add up", {}});
        return faults;
    }

    std::vector<Fault> run_on_places() {
        seen_.assign(static_cast<std::size_t>(r_.edges.size()), 0);
        std::vector<Fault> faults;
        for (const int seed : r_.cells) {
            gather(seed);
            if (std::optional<Fault> fault = check_places()) faults.push_back(std::move(*fault));
        }
        return faults;
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

    std::optional<Fault> check_cell() {
        std::vector<int> planes;
        for (const int f : facets_) planes.push_back(plane_of(r_.edges[f].key));
        std::sort(planes.begin(), planes.end());
        const auto twice = std::adjacent_find(planes.begin(), planes.end());
        if (twice != planes.end()) return Fault{"two facets of a cell on one plane", {*twice}};
        for (const int h : cell_) {
            const HalfEdge& e = r_.edges[h];
            if (r_.edges[e.twin].twin != h || r_.edges[e.next].prev != h)
                return Fault{"a cell is not closed", {}};
            if (e.notch >= 0) return Fault{"a cell kept a notch", {}};
        }
        if (has_edge_twice()) return Fault{"a cell has an edge twice", planes};
        // Euler's formula of a sphere: V - E + F = 2.
        if (static_cast<long>(vertices_.size()) - static_cast<long>(cell_.size() / 2) +
                static_cast<long>(facets_.size()) !=
            2)
            return Fault{"a cell is not a sphere", planes};
        for (const int f : facets_) {
            const int plane = plane_of(r_.edges[f].key), sign = key_sign(r_.edges[f].key);
            for (const int v : vertices_) {
                if (sign * r_.points.distance(v, plane) < -kClassReach) continue;
                if (sign * r_.points.distance(v, plane) > kClassReach ||
                    (r_.exact && r_.points.side(v, plane) * sign > 0))
                    return Fault{"a cell is not convex", with(plane, r_.points.on(v))};
            }
        }
        return std::nullopt;
    }

    bool has_edge_twice() {
        edges_.clear();
        for (const int h : cell_) edges_.push_back({r_.edges[h].org, r_.edges.dest(h)});
        std::sort(edges_.begin(), edges_.end());
        return std::adjacent_find(edges_.begin(), edges_.end()) != edges_.end();
    }

    // A cell whose vertices lie at most d outside of some planes, one for each facet, and those of
    // the facet at most d off its plane, has no vertex deeper than 2 d in its hull and lacks at
    // most 2 d times the hull's area of the hull's volume.
    std::optional<Fault> check_places() {
        places_.clear();
        for (const int v : vertices_) places_.push_back(on_grid(v));
        for (const int f : facets_) {
            const int plane = plane_of(r_.edges[f].key);
            const int v = vertex_off(f, r_.placed_planes[plane]);
            if (v >= 0 && vertex_off(f, r_.points.unit_plane(plane)) >= 0)
                return Fault{"a cell is not convex where its points lie",
                             with(plane, r_.points.on(v))};
        }
        return std::nullopt;
    }

    // A vertex that lies too far outside of a plane for facet f, or is f's and too far inside.
    int vertex_off(int f, const UnitPlane& plane) const {
        const int sign = key_sign(r_.edges[f].key);
        for (std::size_t i = 0; i < vertices_.size(); ++i)
            if (sign * height(plane, places_[i]) > farthest_off_) return vertices_[i];
        int h = f;
        do {
            const int v = r_.edges[h].org;
            if (sign * height(plane, on_grid(v)) < -farthest_off_) return v;
            h = r_.edges[h].next;
        } while (h != f);
        return -1;
    }

    Vec3d on_grid(int point) const {
        Vec3d place = r_.placed[point];
        for (int k = 0; k < 3; ++k) place[k] = (place[k] - grid_.origin[k]) / grid_.step;
        return place;
    }

    static std::vector<int> with(int plane, std::vector<int> planes) {
        planes.push_back(plane);
        return planes;
    }

    const Grid& grid_;
    Decomposition& r_;
    double farthest_off_;  // in steps; the grid's diagonal is at least 2^bits of them
    std::vector<Vec3d> places_;
    std::vector<std::pair<int, int>> edges_;
    std::vector<char> seen_;
    std::vector<int> cell_, facets_, vertices_, surface_;
};

}  // namespace

std::vector<Fault> find_faults(const Grid& grid, Decomposition& result) {
    return Checker(grid, result).run();
}

std::vector<Fault> find_misplaced(const Grid& grid, Decomposition& result) {
    return Checker(grid, result).run_on_places();
}

}  // namespace tetra::notch
