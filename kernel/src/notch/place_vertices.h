// SPDX-License-Identifier: LGPL-2.1-or-later
// Where the input's vertices lie once plane classes are chosen: on their planes, exactly.
#pragma once

#include "plane_classes.h"

namespace tetra::notch {

// Adds the solid's points to the table, in order, and marks each as on the planes of its
// triangles. A vertex that a class plane misses becomes the exact meeting point of its three
// planes, so that incidence and arithmetic agree there; it moves by a few grid steps at most, and
// P2 holds. A vertex of more planes stays on the grid and is on a class by incidence only.
void place_vertices(const GridSolid& solid, const PlaneClasses& classes, PointTable& points);

}  // namespace tetra::notch
