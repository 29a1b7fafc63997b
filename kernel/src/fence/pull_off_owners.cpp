// SPDX-License-Identifier: LGPL-2.1-or-later
// Plane facets of a surface as connected components over flat edges.
#include <numeric>

#include "coplanar.h"
#include "tetra/fence/pull_off.h"
#include "tetra/solid/edges.h"

namespace tetra {
namespace {

std::size_t root_of(std::vector<std::size_t>& parent, std::size_t i) {
    while (parent[i] != i) i = parent[i] = parent[parent[i]];
    return i;
}

}  // namespace

std::vector<int> facet_owners(const std::vector<Vec3i>& points,
                              const std::vector<Triangle>& triangles, const std::vector<int>& face,
                              const std::vector<int>& solid) {
    std::vector<std::size_t> parent(triangles.size());
    std::iota(parent.begin(), parent.end(), std::size_t{0});
    const EdgeTable edges = build_edges(triangles, solid);
    for (std::size_t e = 0; e < edges.edges.size(); ++e) {
        const auto sides = edges.of(e);
        if (sides.size() != 2) continue;
        const auto a = static_cast<std::size_t>(sides[0] / 3);
        const auto b = static_cast<std::size_t>(sides[1] / 3);
        if (!face.empty() && face[a] != face[b]) continue;
        if (!fence::coplanar(points, triangles[a], triangles[b])) continue;
        const std::size_t ra = root_of(parent, a), rb = root_of(parent, b);
        parent[std::max(ra, rb)] = std::min(ra, rb);
    }
    std::vector<int> owner(triangles.size());
    int count = 0;
    for (std::size_t i = 0; i < owner.size(); ++i)
        owner[i] = parent[i] == i ? count++ : owner[root_of(parent, i)];
    return owner;
}

}  // namespace tetra
