// SPDX-License-Identifier: LGPL-2.1-or-later
// What carries each point of a mesh, told by the owners of the skin around it.
#pragma once

#include "tetra/solid/exact_mesh.h"

namespace tetra {

// `owner` is one facet id per skin triangle, `point_source` the grid point of each mesh point or
// -1. Facet carriers take mesh.skin_source; edge carriers end at the next input points.
std::vector<Carrier> skin_carriers(const ExactMesh& mesh, const std::vector<int>& owner,
                                   const std::vector<int>& point_source);

}  // namespace tetra
