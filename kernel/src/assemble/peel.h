// SPDX-License-Identifier: LGPL-2.1-or-later
// When a flat tetrahedron may be taken off the skin (COMPACT.md B4 d).
#pragma once

#include "tet_complex.h"

namespace tetra {

// True when t has exactly two skin faces, both of one B-rep face; is lower than 1e-3 grid steps at
// `places`; its old and its new skin triangles have equal areas, equal to the length of their
// vector sums, at `places` (1e-9) and on the grid (1e-4); and the new edge is not on the skin.
bool may_peel(TetComplex& mesh, int t, const std::vector<Vec3d>& places);

}  // namespace tetra
