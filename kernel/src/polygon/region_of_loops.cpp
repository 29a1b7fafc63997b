// SPDX-License-Identifier: LGPL-2.1-or-later
// Shamos-Hoey sweep that proves loops free of crossings and directs their edges by parity.

#include <algorithm>
#include <string>
#include <utility>

#include "ordered_list.h"
#include "sweep_graph.h"
#include "tetra/polygon/region.h"

namespace tetra {

namespace {

constexpr int none = OrderedList::none;

std::vector<DirectedEdge> edges_of_loops(std::span<const std::vector<PointId>> loops) {
    std::vector<DirectedEdge> edges;
    for (std::size_t k = 0; k < loops.size(); ++k) {
        const std::vector<PointId>& loop = loops[k];
        if (loop.size() < 3) {
            throw InvalidRegion("loop " + std::to_string(k) + " has fewer than three corners", {},
                                loop);
        }
        for (std::size_t i = 0; i < loop.size(); ++i) {
            edges.push_back({loop[i], loop[(i + 1) % loop.size()]});
        }
    }
    return edges;
}

/// Edges that meet in the leftmost point where any two do are neighbours just before it, so that
/// testing edges when they become neighbours is enough.
class ParitySweep {
  public:
    ParitySweep(const SweepGraph& graph, const PointOracle& oracle)
        : graph_(graph), oracle_(oracle), inside_above_(graph.edges.size(), 0) {}

    /// Per edge, whether the region lies above it.
    std::vector<char> run() {
        for (int rank = 0; rank < static_cast<int>(graph_.ids.size()); ++rank) {
            visit(rank);
        }
        return std::move(inside_above_);
    }

  private:
    void visit(int rank) {
        const std::span<const int> ending = graph_.ending_at(rank);
        const std::span<const int> starting = graph_.starting_at(rank);
        const int below = ending.empty() ? locate(rank, starting) : order_.previous(ending.front());
        for (const int edge : ending) {
            order_.erase(edge);
        }
        const int above = order_.next(below);
        bool inside = below != none && inside_above_[below] != 0;
        int place = below;
        for (const int edge : starting) {
            inside = !inside;
            inside_above_[edge] = inside ? 1 : 0;
            order_.insert_after(place, edge);
            place = edge;
        }
        if (starting.empty()) {
            check_apart(below, above);
        } else {
            check_apart(below, starting.front());
            check_apart(starting.back(), above);
        }
    }

    int locate(int rank, std::span<const int> starting) const {
        return order_.last_where([&](int edge) {
            const int side = side_of(edge, rank);
            if (side == 0) {
                fail("point " + std::to_string(graph_.ids[rank]) + " lies on edge " +
                         std::to_string(edge) + "; split the edge there",
                     edge, starting.front());
            }
            return side > 0;
        });
    }

    int side_of(int edge, int rank) const {
        const SweepEdge& e = graph_.edges[edge];
        return oracle_.orient(graph_.ids[e.left], graph_.ids[e.right], graph_.ids[rank]);
    }

    /// Edges with a common end were compared when the graph was made.
    void check_apart(int a, int b) const {
        if (a == none || b == none) {
            return;
        }
        const SweepEdge& p = graph_.edges[a];
        const SweepEdge& q = graph_.edges[b];
        if (p.left == q.left || p.right == q.right || p.left == q.right || p.right == q.left) {
            return;
        }
        const int q_left = side_of(a, q.left);
        const int q_right = side_of(a, q.right);
        if (q_left * q_right > 0) {
            return;
        }
        if (q_left == 0 && q_right == 0) {
            if (p.right < q.left || q.right < p.left) {
                return;
            }
        } else if (side_of(b, p.left) * side_of(b, p.right) > 0) {
            return;
        }
        fail("edges " + std::to_string(std::min(a, b)) + " and " + std::to_string(std::max(a, b)) +
                 " meet outside a common corner",
             a, b);
    }

    [[noreturn]] void fail(const std::string& what, int a, int b) const {
        const SweepEdge& p = graph_.edges[a];
        const SweepEdge& q = graph_.edges[b];
        throw InvalidRegion(
            what, {std::min(a, b), std::max(a, b)},
            {graph_.ids[p.left], graph_.ids[p.right], graph_.ids[q.left], graph_.ids[q.right]});
    }

    const SweepGraph& graph_;
    const PointOracle& oracle_;
    OrderedList order_;  ///< edges that the sweep line meets, from the lowest to the highest
    std::vector<char> inside_above_;
};

}  // namespace

std::vector<DirectedEdge> region_of_loops(std::span<const std::vector<PointId>> loops,
                                          const PointOracle& oracle) {
    std::vector<DirectedEdge> edges = edges_of_loops(loops);
    const SweepGraph graph = make_sweep_graph(edges, {}, oracle, Slits::forbidden);
    const std::vector<char> floors = ParitySweep(graph, oracle).run();
    for (std::size_t k = 0; k < edges.size(); ++k) {
        if (graph.edges[k].floor != (floors[k] != 0)) {
            std::swap(edges[k].from, edges[k].to);
        }
    }
    return edges;
}

}  // namespace tetra
