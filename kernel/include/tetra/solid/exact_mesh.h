// SPDX-License-Identifier: LGPL-2.1-or-later
// A tetrahedral mesh with exact points and what carries them: passed from fences to compaction.
#pragma once

#include <vector>

#include "tetra/exact/hpoint.h"
#include "tetra/solid/grid_solid.h"

namespace tetra {

enum class CarrierKind { vertex, edge, facet, inner };

// What a mesh point may slide along. `first`, `second` are grid point ids: the vertex itself
// (vertex), the ends of the straight sharp edge it lies on (edge); for a facet `first` is a
// triangle of the GridSolid whose plane holds it; -1 where unused.
struct Carrier {
    CarrierKind kind = CarrierKind::inner;
    int first = -1, second = -1;
};

// Tetrahedra have det(b-a, c-a, d-a) > 0. Skin triangles are outward; `skin_source` is a triangle
// of the GridSolid whose plane and B-rep face the skin triangle lies on.
struct ExactMesh {
    std::vector<HPoint> points;
    std::vector<Carrier> carriers;
    std::vector<std::array<int, 4>> tets;
    std::vector<int> tet_solid;
    std::vector<Triangle> skin;
    std::vector<int> skin_source;
};

}  // namespace tetra
