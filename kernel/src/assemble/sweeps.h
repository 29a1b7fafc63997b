// SPDX-License-Identifier: LGPL-2.1-or-later
// Sweeps of flips over a whole mesh: 3-2 wherever they go, 4-4 and 2-2 at random (COMPACT.md A4).
#pragma once

#include "tet_complex.h"
#include "tetra/progress.h"

namespace tetra {

struct Sweep {
    TetComplex& mesh;
    Rng& rng;
    Progress& progress;
    std::vector<char>* dirty = nullptr;  // per point, set where tetrahedra change; may be null
    int reducing = 0;                    // 3-2 flips done
};

// Every 3-2 flip there is; new tetrahedra are looked at too.
void reduce_all(Sweep& sweep);

// A random 4-4 or 2-2 flip at each tetrahedron, kept when a 3-2 follows, else by a coin.
void neutral_sweep(Sweep& sweep);

}  // namespace tetra
