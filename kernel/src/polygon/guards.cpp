// SPDX-License-Identifier: LGPL-2.1-or-later
// Three-colouring by a walk over the dual graph, and the choice of guards.

#include "tetra/polygon/guards.h"

#include <algorithm>

#include "half_edges.h"

namespace tetra {

namespace {

struct Colouring {
    std::vector<std::array<int, 3>> colours;
    std::vector<std::vector<int>> components;  ///< triangles in the order of the walk
};

/// Gives the neighbour across a side the colours of that side and the third one opposite.
void colour_neighbour(std::vector<std::array<int, 3>>& colours, int side, int other) {
    const int from = colours[side / 3][side % 3];
    const int to = colours[side / 3][next_side(side) % 3];
    std::array<int, 3>& neighbour = colours[other / 3];
    neighbour[other % 3] = to;
    neighbour[next_side(other) % 3] = from;
    neighbour[previous_side(other) % 3] = 3 - from - to;
}

Colouring colour_by_components(std::span<const PlanarTriangle> triangles) {
    const std::vector<int> opposite = opposite_sides(triangles, {});
    Colouring result;
    result.colours.assign(triangles.size(), {0, 1, 2});
    std::vector<char> seen(triangles.size(), 0);
    for (int root = 0; root < static_cast<int>(triangles.size()); ++root) {
        if (seen[root] != 0) {
            continue;
        }
        seen[root] = 1;
        std::vector<int> walk{root};
        for (std::size_t at = 0; at < walk.size(); ++at) {
            for (int side = 3 * walk[at]; side < 3 * walk[at] + 3; ++side) {
                const int other = opposite[side];
                if (other < 0 || seen[other / 3] != 0) {
                    continue;
                }
                seen[other / 3] = 1;
                colour_neighbour(result.colours, side, other);
                walk.push_back(other / 3);
            }
        }
        result.components.push_back(std::move(walk));
    }
    return result;
}

void sort_unique(std::vector<PointId>& ids) {
    std::sort(ids.begin(), ids.end());
    ids.erase(std::unique(ids.begin(), ids.end()), ids.end());
}

std::vector<PointId> rarest_colour(std::span<const PlanarTriangle> triangles,
                                   const std::vector<std::array<int, 3>>& colours,
                                   const std::vector<int>& component) {
    std::array<std::vector<PointId>, 3> classes;
    for (const int t : component) {
        for (int k = 0; k < 3; ++k) {
            classes[colours[t][k]].push_back(triangles[t][k]);
        }
    }
    for (std::vector<PointId>& ids : classes) {
        sort_unique(ids);
    }
    return *std::min_element(classes.begin(), classes.end(),
                             [](const auto& a, const auto& b) { return a.size() < b.size(); });
}

/// Guards without those all of whose triangles have another guard, tried from the first on.
std::vector<PointId> without_needless(std::span<const PlanarTriangle> triangles,
                                      const std::vector<PointId>& guards) {
    std::vector<std::vector<int>> seen_by(guards.size());
    std::vector<int> guards_of(triangles.size(), 0);
    for (std::size_t t = 0; t < triangles.size(); ++t) {
        for (const PointId id : triangles[t]) {
            const auto at = std::lower_bound(guards.begin(), guards.end(), id);
            if (at != guards.end() && *at == id) {
                seen_by[at - guards.begin()].push_back(static_cast<int>(t));
                ++guards_of[t];
            }
        }
    }
    std::vector<PointId> kept;
    for (std::size_t g = 0; g < guards.size(); ++g) {
        const bool needless = std::all_of(seen_by[g].begin(), seen_by[g].end(),
                                          [&](int t) { return guards_of[t] > 1; });
        if (!needless) {
            kept.push_back(guards[g]);
            continue;
        }
        for (const int t : seen_by[g]) {
            --guards_of[t];
        }
    }
    return kept;
}

}  // namespace

std::vector<std::array<int, 3>> three_colouring(std::span<const PlanarTriangle> triangles) {
    return colour_by_components(triangles).colours;
}

std::vector<PointId> place_guards(std::span<const PlanarTriangle> triangles) {
    const Colouring colouring = colour_by_components(triangles);
    std::vector<PointId> guards;
    for (const std::vector<int>& component : colouring.components) {
        const std::vector<PointId> chosen = rarest_colour(triangles, colouring.colours, component);
        guards.insert(guards.end(), chosen.begin(), chosen.end());
    }
    sort_unique(guards);
    return without_needless(triangles, guards);
}

}  // namespace tetra
