// SPDX-License-Identifier: LGPL-2.1-or-later
// A new inner point that takes the place of tetrahedra which nothing else gets rid of.
#pragma once

#include <functional>

#include "tet_complex.h"

namespace tetra {

struct Insertion {
    int point = -1;             // -1: no place was found
    std::vector<int> vanished;  // inner Steiner points that lay in the cavity
};

// Replaces `bad` tetrahedra and as many around them as it takes by the cone from a new inner point
// over the hull of them all. Candidates for the point are drawn near `bad`; that with the smallest
// cone is taken. `sound(tet)`: may the result hold the tetrahedron? It must at least be positive
// on the grid and in place. No input vertex is lost and the skin stays.
// The union of both chains has the same boundary: when all cones are positive they fill the cavity
// once, whatever its shape.
Insertion insert_point(TetComplex& mesh, const std::vector<int>& bad, Rng& rng,
                       const std::function<bool(const Tet&)>& sound);

}  // namespace tetra
