// SPDX-License-Identifier: LGPL-2.1-or-later
// Better shaped triangles by flips towards the constrained Delaunay triangulation.
#pragma once

#include <array>
#include <functional>
#include <span>
#include <vector>

#include "tetra/polygon/region.h"

namespace tetra {

/// Coordinates of a point as near as doubles come; they only steer, they decide nothing exact.
using ApproximatePoint = std::function<std::array<double, 2>(PointId)>;

/// Flips inner edges whose opposite angles sum up to clearly more than two right angles.
///
/// A flip happens only when both new triangles are positive by the oracle, so the result is as
/// valid as the input, however rough the coordinates. It is deterministic, and it ends: an edge
/// is flipped when the sine of the angle sum is below -1e-10 in relation to its terms, and the
/// flips are limited to 64 per triangle (a limit for hostile input; a few flips are usual).
/// Lawson's method, O(t log t) to set up, two calls of orient per flip tried.
///
/// \param triangles a triangulation, for instance by triangulate_region.
/// \param fixed edges that must stay (slits); edges with a triangle on one side stay anyway.
std::vector<PlanarTriangle> flip_towards_delaunay(std::vector<PlanarTriangle> triangles,
                                                  std::span<const DirectedEdge> fixed,
                                                  const PointOracle& oracle,
                                                  const ApproximatePoint& approximate);

}  // namespace tetra
