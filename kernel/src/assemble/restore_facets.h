// SPDX-License-Identifier: LGPL-2.1-or-later
// What the skin of a restored mesh lies on: facets after peels, the source of each triangle.
#pragma once

#include "tet_complex.h"

namespace tetra {

// Facet of each triangle as the classes are, those of each pair of triangles joined.
std::vector<int> joined_facets(const FacetClasses& classes,
                               const std::vector<std::array<int, 2>>& pairs);

// The source of a skin triangle becomes the triangle of its facet that shares a directed edge with
// it, where there is one.
void refine_sources(ExactMesh& mesh, const GridSolid& solid, const std::vector<int>& facet);

}  // namespace tetra
