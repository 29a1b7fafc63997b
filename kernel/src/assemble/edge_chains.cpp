// SPDX-License-Identifier: LGPL-2.1-or-later
// A part of an edge is found by the edge of one of its ends.
#include "edge_chains.h"

#include <algorithm>

namespace tetra {
namespace {

auto place_in(const std::vector<int>& chain, int point) {
    return std::find(chain.begin(), chain.end(), point);
}

}  // namespace

const std::vector<int>* EdgeChains::chain_of(int u, int v) const {
    for (const int end : {u, v}) {
        const auto edge = edge_of_.find(end);
        if (edge == edge_of_.end()) continue;
        const std::vector<int>& chain = chains_.at(edge->second);
        if (place_in(chain, u + v - end) != chain.end()) return &chain;
    }
    const auto whole = chains_.find({std::min(u, v), std::max(u, v)});
    return whole == chains_.end() ? nullptr : &whole->second;
}

bool EdgeChains::add(int u, int v, int point, const std::vector<Vec3d>& points) {
    const std::vector<int>* known = chain_of(u, v);
    const Edge edge =
        known ? Edge{known->front(), known->back()} : Edge{std::min(u, v), std::max(u, v)};
    std::vector<int>& chain =
        chains_.try_emplace(edge, std::vector{edge.first, edge.second}).first->second;
    if (place_in(chain, point) != chain.end()) return false;
    const auto distance = [&](int p) {
        const Vec3d d = minus(points[p], points[edge.first]);
        return dot(d, d);
    };
    const auto next = std::find_if(chain.begin() + 1, chain.end() - 1,
                                   [&](int p) { return distance(p) > distance(point); });
    chain.insert(next, point);
    edge_of_[point] = edge;
    return true;
}

std::vector<int> EdgeChains::between(int u, int v) const {
    const std::vector<int>* chain = chain_of(u, v);
    if (!chain) return {};
    auto low = place_in(*chain, std::min(u, v)), high = place_in(*chain, std::max(u, v));
    const bool turned = high < low;
    if (turned) std::swap(low, high);
    std::vector<int> result(low + 1, high);
    if (turned) std::reverse(result.begin(), result.end());
    return result;
}

}  // namespace tetra
