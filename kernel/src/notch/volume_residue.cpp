// SPDX-License-Identifier: LGPL-2.1-or-later
// Fans of determinants in modular arithmetic.
#include "volume_residue.h"

namespace tetra::notch {
namespace {

using Residue = std::array<std::uint64_t, 3>;

std::uint64_t minus(std::uint64_t a, std::uint64_t b) {
    return a >= b ? a - b : a + kHashPrime - b;
}

std::uint64_t plus(std::uint64_t a, std::uint64_t b) {
    const std::uint64_t s = a + b;
    return s >= kHashPrime ? s - kHashPrime : s;
}

std::uint64_t determinant(const Residue& p, const Residue& q, const Residue& r) {
    std::uint64_t sum = 0;
    for (int k = 0; k < 3; ++k) {
        const int u = (k + 1) % 3, v = (k + 2) % 3;
        sum = plus(sum,
                   multiply_mod(p[k], minus(multiply_mod(q[u], r[v]), multiply_mod(q[v], r[u]))));
    }
    return sum;
}

}  // namespace

std::uint64_t volume_residue(const PointTable& points, const HalfEdges& edges,
                             const std::vector<int>& surface) {
    std::vector<Residue> residue(static_cast<std::size_t>(points.points()));
    std::vector<char> known(residue.size(), 0);
    const auto at = [&](int v) -> const Residue& {
        if (!known[v]) {
            known[v] = 1;
            residue[v] = residues(points.exact(v));
        }
        return residue[v];
    };
    std::vector<char> seen(static_cast<std::size_t>(edges.size()), 0);
    std::uint64_t total = 0;
    for (const int f : surface) {
        if (seen[f]) continue;
        seen[f] = 1;
        const Residue first = at(edges[f].org);
        for (int i = edges[f].next; i != f; i = edges[i].next) {
            seen[i] = 1;
            if (edges[i].next != f)
                total = plus(total, determinant(first, at(edges[i].org), at(edges.dest(i))));
        }
    }
    return total;
}

}  // namespace tetra::notch
