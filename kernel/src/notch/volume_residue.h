// SPDX-License-Identifier: LGPL-2.1-or-later
// Six times the volume bounded by half-edges, modulo 2^61 - 1: exact sums without big rationals.
#pragma once

#include "half_edges.h"

namespace tetra::notch {

// Facets must be planar; holes run clockwise. Two different volumes agree by chance with
// probability 2^-61. Linear.
std::uint64_t volume_residue(const PointTable& points, const HalfEdges& edges,
                             const std::vector<int>& surface);

}  // namespace tetra::notch
