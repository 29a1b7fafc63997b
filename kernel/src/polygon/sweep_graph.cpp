// SPDX-License-Identifier: LGPL-2.1-or-later
// Ranking of the points and sorting of the edges around them.

#include "sweep_graph.h"

#include <algorithm>
#include <utility>

namespace tetra {

namespace {

std::vector<PointId> distinct_ids(std::span<const DirectedEdge> edges,
                                  std::span<const PointId> inner_points) {
    std::vector<PointId> ids;
    ids.reserve(2 * edges.size() + inner_points.size());
    for (const DirectedEdge& edge : edges) {
        ids.push_back(edge.from);
    }
    for (const DirectedEdge& edge : edges) {
        ids.push_back(edge.to);
    }
    ids.insert(ids.end(), inner_points.begin(), inner_points.end());
    std::sort(ids.begin(), ids.end());
    ids.erase(std::unique(ids.begin(), ids.end()), ids.end());
    return ids;
}

/// Rank of each point in the order of the ids; fills the ids in the order of the ranks.
std::vector<int> rank_points(const std::vector<PointId>& by_id, const PointOracle& oracle,
                             std::vector<PointId>& by_rank) {
    by_rank = by_id;
    std::stable_sort(by_rank.begin(), by_rank.end(),
                     [&](PointId a, PointId b) { return oracle.compare(a, b) < 0; });
    std::vector<int> rank_of(by_id.size());
    for (std::size_t rank = 0; rank < by_rank.size(); ++rank) {
        if (rank > 0 && oracle.compare(by_rank[rank - 1], by_rank[rank]) >= 0) {
            throw InvalidRegion("points " + std::to_string(by_rank[rank - 1]) + " and " +
                                    std::to_string(by_rank[rank]) +
                                    " coincide; use one id for both",
                                {}, {by_rank[rank - 1], by_rank[rank]});
        }
        const auto place = std::lower_bound(by_id.begin(), by_id.end(), by_rank[rank]);
        rank_of[place - by_id.begin()] = static_cast<int>(rank);
    }
    return rank_of;
}

/// Groups the edges by one of their ends, in the order of the input.
void group_by_end(const std::vector<SweepEdge>& edges, int SweepEdge::*end, std::size_t n_points,
                  std::vector<int>& begin, std::vector<int>& grouped) {
    begin.assign(n_points + 1, 0);
    for (const SweepEdge& edge : edges) {
        ++begin[edge.*end + 1];
    }
    for (std::size_t rank = 0; rank < n_points; ++rank) {
        begin[rank + 1] += begin[rank];
    }
    grouped.resize(edges.size());
    std::vector<int> next(begin.begin(), begin.end() - 1);
    for (std::size_t edge = 0; edge < edges.size(); ++edge) {
        grouped[next[edges[edge].*end]++] = static_cast<int>(edge);
    }
}

/// Sorts the edges around the points from the lowest to the highest.
class Sorter {
  public:
    Sorter(SweepGraph& graph, const PointOracle& oracle, Slits slits)
        : graph_(graph), oracle_(oracle), slits_(slits) {}

    void run() {
        for (std::size_t rank = 0; rank < graph_.ids.size(); ++rank) {
            std::sort(graph_.ending.begin() + graph_.ending_begin[rank],
                      graph_.ending.begin() + graph_.ending_begin[rank + 1],
                      [&](int a, int b) { return a != b && ending_below(a, b); });
            std::sort(graph_.starting.begin() + graph_.starting_begin[rank],
                      graph_.starting.begin() + graph_.starting_begin[rank + 1],
                      [&](int a, int b) { return a != b && starting_below(a, b); });
        }
    }

  private:
    bool ending_below(int a, int b) const {
        const SweepEdge& first = graph_.edges[a];
        const SweepEdge& second = graph_.edges[b];
        if (first.left == second.left) {
            return slit_below(a, b);
        }
        const int sign = oracle_.orient(graph_.ids[first.left], graph_.ids[first.right],
                                        graph_.ids[second.left]);
        return sign != 0 ? sign > 0 : overlap(a, b);
    }

    bool starting_below(int a, int b) const {
        const SweepEdge& first = graph_.edges[a];
        const SweepEdge& second = graph_.edges[b];
        if (first.right == second.right) {
            return slit_below(a, b);
        }
        const int sign = oracle_.orient(graph_.ids[first.left], graph_.ids[first.right],
                                        graph_.ids[second.right]);
        return sign != 0 ? sign > 0 : overlap(a, b);
    }

    /// The region on both sides of a slit: below its ceiling and above its floor.
    bool slit_below(int a, int b) const {
        if (slits_ == Slits::forbidden || graph_.edges[a].floor == graph_.edges[b].floor) {
            overlap(a, b);
        }
        return graph_.edges[b].floor;
    }

    [[noreturn]] bool overlap(int a, int b) const {
        const auto [low, high] = std::minmax(a, b);
        const PointId p = graph_.ids[graph_.edges[a].left];
        const PointId q = graph_.ids[graph_.edges[a].right];
        throw InvalidRegion("edges " + std::to_string(low) + " and " + std::to_string(high) +
                                " overlap; split them where they meet and drop one copy",
                            {low, high}, {p, q});
    }

    SweepGraph& graph_;
    const PointOracle& oracle_;
    Slits slits_;
};

}  // namespace

SweepGraph make_sweep_graph(std::span<const DirectedEdge> edges,
                            std::span<const PointId> inner_points, const PointOracle& oracle,
                            Slits slits) {
    const std::vector<PointId> by_id = distinct_ids(edges, inner_points);
    SweepGraph graph;
    const std::vector<int> rank_of = rank_points(by_id, oracle, graph.ids);
    const auto rank = [&](PointId id) {
        return rank_of[std::lower_bound(by_id.begin(), by_id.end(), id) - by_id.begin()];
    };
    graph.edges.reserve(edges.size());
    for (std::size_t k = 0; k < edges.size(); ++k) {
        const int from = rank(edges[k].from);
        const int to = rank(edges[k].to);
        if (from == to) {
            throw InvalidRegion(
                "edge " + std::to_string(k) + " has no length; give each corner once",
                {static_cast<int>(k)}, {edges[k].from});
        }
        graph.edges.push_back({std::min(from, to), std::max(from, to), from < to});
    }
    group_by_end(graph.edges, &SweepEdge::right, graph.ids.size(), graph.ending_begin,
                 graph.ending);
    group_by_end(graph.edges, &SweepEdge::left, graph.ids.size(), graph.starting_begin,
                 graph.starting);
    Sorter(graph, oracle, slits).run();
    return graph;
}

}  // namespace tetra
