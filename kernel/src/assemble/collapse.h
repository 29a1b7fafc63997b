// SPDX-License-Identifier: LGPL-2.1-or-later
// Where a Steiner point may slide, and the collapse onto the best such neighbour.
#pragma once

#include "tet_complex.h"

namespace tetra {

struct Target {
    int point = -1;
    int killed = 0;  // tetrahedra that go
};

// Buffers of the calls below, kept to spare allocations.
struct CollapseScratch {
    std::vector<int> star;
    std::vector<Target> targets;
    std::vector<std::array<int, 2>> skin;  // (neighbour of p along a skin edge, class)
    std::vector<int> touched;              // points of the last star that was looked at
};

// Fills scratch.star and scratch.targets: the neighbours of p along its carrier, those that remove
// most tetrahedra first. On a sharp edge the two along it, in a facet those by skin edges, inside
// all (COMPACT.md A1). Empty for input vertices and where the skin at p is none of these.
void find_targets(TetComplex& mesh, int p, CollapseScratch& scratch);

// True when every tetrahedron of the star that stays is positive with p at q.
bool may_collapse(const TetComplex& mesh, const std::vector<int>& star, int p, int q);

// Collapses p onto the first target that allows it; scratch.touched is its former link.
bool try_collapse(TetComplex& mesh, int p, CollapseScratch& scratch);

}  // namespace tetra
