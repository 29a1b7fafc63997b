// SPDX-License-Identifier: LGPL-2.1-or-later
// Convex polygons from a triangulation, by leaving out diagonals that no angle needs.
#pragma once

#include <span>
#include <vector>

#include "tetra/polygon/region.h"

namespace tetra {

/// Hertel-Mehlhorn: drops an edge when both angles it divides stay at most straight without it.
///
/// Every vertex of the triangulation stays a vertex of all polygons around it, also where the
/// angle is straight, so the partition is face to face. At most four times as many polygons as
/// an optimal partition for regions without inner points. Linear but for one sort; a few calls
/// of orient per edge.
///
/// \param triangles a triangulation, for instance by triangulate_region.
/// \param fixed edges that must stay (slits); edges with a triangle on one side stay anyway.
/// \return counter-clockwise polygons with angles of at most 180 degrees.
std::vector<std::vector<PointId>> convex_partition(std::span<const PlanarTriangle> triangles,
                                                   std::span<const DirectedEdge> fixed,
                                                   const PointOracle& oracle);

}  // namespace tetra
