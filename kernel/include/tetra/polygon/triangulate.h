// SPDX-License-Identifier: LGPL-2.1-or-later
// Triangulation of planar regions by one plane sweep that feeds monotone pieces.
#pragma once

#include "tetra/polygon/region.h"

#include <span>
#include <vector>

namespace tetra {

/// Triangulates the region on the left of the boundary edges.
///
/// The region may have any number of components and holes and may touch itself in vertices. An
/// edge that is given in both directions is a slit: it has the region on both sides and becomes
/// an edge of two triangles. Vertices in the middle of straight boundary stay vertices. No
/// triangle is flat, no edge passes through a vertex, and each directed boundary edge is the side
/// of exactly one triangle. With e directed edges, c components of the interior and h holes among
/// them (slits and inner points apart from the rest count as holes) there are e - 2c + 2h
/// triangles; equally, e + 2i - 2c + 2h when the i inner points are not counted in h.
///
/// Method: monotone partition by plane sweep and the stack algorithm for monotone polygons
/// (Mirolo; de Berg et al., chapter 3), both at once. O(n log n) calls of compare for one sort;
/// O(n + m log m) calls of orient, with m the local extremes where boundary starts or splits.
///
/// \param boundary directed edges, in any order.
/// \param oracle exact predicates on the points of the edges.
/// \param inner_points points strictly inside that become vertices; those that are boundary
///        vertices already, or come twice, are ignored.
/// \throw InvalidRegion when the edges do not bound a region, or an inner point is not inside it.
std::vector<PlanarTriangle> triangulate_region(std::span<const DirectedEdge> boundary,
                                               const PointOracle& oracle,
                                               std::span<const PointId> inner_points = {});

}  // namespace tetra
