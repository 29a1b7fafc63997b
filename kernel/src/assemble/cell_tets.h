// SPDX-License-Identifier: LGPL-2.1-or-later
// Tetrahedra from convex cells that need not meet face to face (ALGORITHMS 1.5 and 2.4).
#pragma once

#include <vector>

#include "tetra/assemble/tetrahedralize.h"
#include "tetra/notch/exact_cells.h"
#include "tetra/solid/exact_mesh.h"

namespace tetra {

// Conforming tetrahedra of the cells of `solid`, one Polyhedra for each of `solid_ids`, whose
// point_source are points of `solid`. The facets on both sides of each plane are overlaid, each
// common part is triangulated once, each cell is a cone over its triangles: from a vertex whose
// facets are all fanned from it, else from a point inside. Solids in contact share the triangles
// of the contact, which are skin of both. `owners` as in facet_owners(): borders between owners
// stay edges of the skin. Every input point becomes a vertex.
//
// All points but the cone points are input points or exact meetings of three planes (P2).
// \throw VerificationFailed when the cells don't fit the surface; Cancelled.
// Complexity: O(n log n) for n corners of cells and crossings of their edges.
ExactMesh tets_of_cells(const GridSolid& solid, const std::vector<int>& owners,
                        const std::vector<Polyhedra>& cells, const std::vector<int>& solid_ids,
                        CellTetCounts& counts, Progress& progress);

}  // namespace tetra
