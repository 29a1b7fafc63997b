// SPDX-License-Identifier: LGPL-2.1-or-later
// Dividing tetrahedra of a finished mesh at points on their edges and faces, face to face.
#pragma once

#include <array>
#include <map>
#include <utility>
#include <vector>

#include "tetra/exact/grid.h"
#include "tetra/solid/grid_solid.h"

namespace tetra {

// Points are ids of one list. Edges and triangles are keyed by ascending ids.
struct Division {
    std::map<std::pair<int, int>, std::vector<int>> on_edge;  // from the lower end on
    std::map<Triangle, std::vector<Triangle>> faces;  // outward; with the points of their edges

    bool any() const { return !on_edge.empty() || !faces.empty(); }
    bool touches(const Triangle& triangle) const;
    // What a triangle becomes: as `faces` says, else by the points on its edges alone, in a way
    // that depends on nothing but the ids.
    std::vector<Triangle> parts_of(const Triangle& triangle) const;
};

// Tetrahedra that take the place of `tet`; each is a cone over the parts of its faces, from one of
// its corners or from a new point, which is appended.
// \throw VerificationFailed when one is not positive in doubles.
std::vector<std::array<int, 4>> divided(const std::array<int, 4>& tet, const Division& division,
                                        std::vector<Vec3d>& points);

}  // namespace tetra
