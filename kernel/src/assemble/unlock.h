// SPDX-License-Identifier: LGPL-2.1-or-later
// The walk of flips that clears the way for a collapse (COMPACT.md A5).
#pragma once

#include "collapse.h"

namespace tetra {

struct WalkOptions {
    int targets = 2;   // neighbours to try, those with fewest blockers first
    int max_bad = 8;   // give up on targets with more blocking tetrahedra
    int sideways = 4;  // flips that leave the count of blockers as it is
    int max_ring = 6;
    int wander = 0;  // FlipWalkLimits
    int shrink = 0;  // passes of flips that take edges off the point before its walk
};

// Flips round p until a target accepts it, then collapses; else the mesh is as before.
// scratch.touched then holds the points of everything that changed.
bool unlock_collapse(TetComplex& mesh, int p, const WalkOptions& options, Rng& rng,
                     CollapseScratch& scratch);

}  // namespace tetra
