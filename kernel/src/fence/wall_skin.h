// SPDX-License-Identifier: LGPL-2.1-or-later
// Which wall triangles lie in vertical facets, and in which.
#pragma once

#include "columns.h"

namespace tetra::fence {

// Adds the unpaired wall triangles to columns.skin and skin_facet.
// \throw InvalidSolid when one lies in no vertical facet.
void add_wall_skin(const Plan& plan, const Walls& walls, const Joints& joints, const Bases& bases,
                   Columns& columns, Progress& progress);

// A triangle of the facet that holds the mark, or any of its triangles when none does.
int triangle_under(const Plan& plan, const Mark& mark, int facet);

}  // namespace tetra::fence
