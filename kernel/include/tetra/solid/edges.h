// SPDX-License-Identifier: LGPL-2.1-or-later
// The edges of a triangle surface, each with its half-edges, and what keeps them from being closed.
#pragma once

#include <span>
#include <vector>

#include "tetra/errors.h"
#include "tetra/solid/grid_solid.h"

namespace tetra {

// Half-edge 3 t + i runs from triangles[t][i] to triangles[t][(i + 1) % 3].
inline int next_half_edge(int h) { return h % 3 == 2 ? h - 2 : h + 1; }
inline int previous_half_edge(int h) { return h % 3 == 0 ? h + 2 : h - 1; }

inline int tail_of(std::span<const Triangle> triangles, int h) {
    return triangles[static_cast<std::size_t>(h / 3)][static_cast<std::size_t>(h % 3)];
}
inline int head_of(std::span<const Triangle> triangles, int h) {
    return tail_of(triangles, next_half_edge(h));
}
inline int apex_of(std::span<const Triangle> triangles, int h) {
    return tail_of(triangles, previous_half_edge(h));
}

// All edges of a surface: edge e joins low < high of one solid and has the half-edges
// half_edges[first[e]] to half_edges[first[e + 1] - 1], ascending.
struct EdgeTable {
    struct Edge {
        int solid, low, high;
    };
    std::vector<Edge> edges;
    std::vector<int> first;
    std::vector<int> half_edges;

    std::span<const int> of(std::size_t e) const {
        return std::span(half_edges)
            .subspan(static_cast<std::size_t>(first[e]),
                     static_cast<std::size_t>(first[e + 1] - first[e]));
    }
};

// Sorted by solid, low, high; `solid` may be empty (all 0). O(n log n).
EdgeTable build_edges(std::span<const Triangle> triangles, std::span<const int> solid);

// True when every directed edge occurs as often as its reverse within its solid.
bool is_closed(std::span<const Triangle> triangles, std::span<const int> solid);

// One defect per connected group of open edges (kind open_edge) and per connected part that is
// oriented inconsistently (inconsistent_orientation, naming the fewest triangles to turn) or can't
// be oriented at all (non_orientable). Ids are translated to the caller's by the solid's sources.
std::vector<Defect> find_boundary_defects(const GridSolid& surface);

// Triangles of one solid with the same three points in the same cyclic order, flat ones excepted
// (their repair settles them).
std::vector<Defect> find_duplicate_triangles(const GridSolid& surface);

}  // namespace tetra
