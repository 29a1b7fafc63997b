// SPDX-License-Identifier: LGPL-2.1-or-later
// Facets joined by peels, and sources found by shared directed edges.
#include "restore_facets.h"

#include <algorithm>
#include <cstdint>
#include <unordered_map>

namespace tetra {
namespace {

std::size_t at(int i) { return static_cast<std::size_t>(i); }

}  // namespace

std::vector<int> joined_facets(const FacetClasses& classes,
                               const std::vector<std::array<int, 2>>& pairs) {
    std::vector<int> facet = classes.of_triangle;
    for (const auto& [a, b] : pairs) {
        const int keep = std::min(facet[at(a)], facet[at(b)]);
        const int drop = std::max(facet[at(a)], facet[at(b)]);
        if (keep != drop) std::replace(facet.begin(), facet.end(), drop, keep);
    }
    return facet;
}

void refine_sources(ExactMesh& mesh, const GridSolid& solid, const std::vector<int>& facet) {
    std::unordered_map<std::uint64_t, int> owner;
    const auto key = [](int a, int b) {
        return static_cast<std::uint64_t>(a) << 32 | static_cast<std::uint32_t>(b);
    };
    for (std::size_t k = 0; k < solid.triangles.size(); ++k)
        for (std::size_t i = 0; i < 3; ++i)
            owner.emplace(key(solid.triangles[k][i], solid.triangles[k][(i + 1) % 3]),
                          static_cast<int>(k));
    const auto grid_point = [&](int p) {
        const Carrier& c = mesh.carriers[at(p)];
        return c.kind == CarrierKind::vertex ? c.first : -1;
    };
    for (std::size_t s = 0; s < mesh.skin.size(); ++s)
        for (std::size_t i = 0; i < 3; ++i) {
            const int a = grid_point(mesh.skin[s][i]), b = grid_point(mesh.skin[s][(i + 1) % 3]);
            if (a < 0 || b < 0) continue;
            const auto it = owner.find(key(a, b));
            if (it == owner.end() || facet[at(it->second)] != facet[at(mesh.skin_source[s])])
                continue;
            mesh.skin_source[s] = it->second;
            break;
        }
}

}  // namespace tetra
