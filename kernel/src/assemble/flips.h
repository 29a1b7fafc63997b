// SPDX-License-Identifier: LGPL-2.1-or-later
// Proposals of flips: a triangle for an edge (2-3), an edge for a triangulated ring (3-2, 4-4,
// 2-2).
#pragma once

#include <limits>

#include "tet_complex.h"

namespace tetra {

// The tetrahedra round edge a-b: (a, b, rim[k], rim[k+1]) is tets[k]. Open rings start and end on
// the skin. Found from a tetrahedron t and two of its corners.
struct Ring {
    static constexpr int kMax = 8;
    int a = -1, b = -1;
    std::array<int, kMax> tets;
    std::array<int, kMax + 1> rim;
    int size = 0;  // tetrahedra
    bool open = false;
    int first_class = -1, last_class = -1;  // of the skin at the ends of an open ring

    int rim_size() const { return open ? size + 1 : size; }
};

// False when the ring has more than max_size tetrahedra.
bool find_ring(const TetComplex& mesh, int t, int i, int j, int max_size, Ring& ring);

// True if an open ring may be removed: both ends in one class, and no other fan at the edge.
bool may_open_flip(TetComplex& mesh, const Ring& ring);

// 2-3 through face `face` of t; false on the skin or when a new tetrahedron is not positive.
bool propose_face_flip(const TetComplex& mesh, int t, int face, Flip& flip);

// cost_of(tet) when mesh.positive(tet), else infinity.
template <class Cost>
double checked_cost(const TetComplex& mesh, const Tet& t, const Cost& cost_of) {
    return mesh.positive(t) ? cost_of(t) : std::numeric_limits<double>::infinity();
}

// The cheapest way to fill the ring without its edge, by dynamic programming over triangulations
// of the rim (Klincsek 1980); false when none is positive. `fresh` != 0 forbids, for rings of four,
// nothing: kept tetrahedra never return since all hold the edge.
template <class Cost>
bool propose_edge_flip(const TetComplex& mesh, const Ring& ring, const Cost& cost_of, Flip& flip) {
    constexpr int kN = Ring::kMax + 1;
    constexpr double kNone = std::numeric_limits<double>::infinity();
    const int n = ring.rim_size();
    if (n < 3) return false;
    const auto r = [&](int i) { return ring.rim[static_cast<std::size_t>(i)]; };
    const auto upper = [&](int i, int k, int j) { return Tet{r(i), r(k), r(j), ring.b}; };
    const auto lower = [&](int i, int k, int j) { return Tet{r(i), r(j), r(k), ring.a}; };
    double best[kN][kN];
    int apex[kN][kN];
    for (int i = 0; i + 1 < n; ++i) best[i][i + 1] = 0;
    for (int width = 2; width < n; ++width)
        for (int i = 0; i + width < n; ++i) {
            const int j = i + width;
            best[i][j] = kNone;
            apex[i][j] = -1;
            for (int k = i + 1; k < j; ++k) {
                const double parts = best[i][k] + best[k][j];
                if (parts >= best[i][j]) continue;
                double sum = parts + checked_cost(mesh, upper(i, k, j), cost_of);
                if (sum >= best[i][j]) continue;
                sum += checked_cost(mesh, lower(i, k, j), cost_of);
                if (sum >= best[i][j]) continue;
                best[i][j] = sum;
                apex[i][j] = k;
            }
        }
    if (best[0][n - 1] == kNone) return false;
    flip.clear();
    for (int k = 0; k < ring.size; ++k)
        flip.kills[static_cast<std::size_t>(flip.kill_count++)] =
            ring.tets[static_cast<std::size_t>(k)];
    std::array<std::array<int, 2>, kN> stack;
    int depth = 0;
    stack[0] = {0, n - 1};
    for (++depth; depth > 0;) {
        const auto [i, j] = stack[static_cast<std::size_t>(--depth)];
        if (j - i < 2) continue;
        const int k = apex[i][j];
        flip.adds[static_cast<std::size_t>(flip.add_count++)] = upper(i, k, j);
        flip.adds[static_cast<std::size_t>(flip.add_count++)] = lower(i, k, j);
        stack[static_cast<std::size_t>(depth++)] = {i, k};
        stack[static_cast<std::size_t>(depth++)] = {k, j};
    }
    flip.skin_class = ring.open ? ring.first_class : -1;
    flip.cost = best[0][n - 1];
    return true;
}

}  // namespace tetra
