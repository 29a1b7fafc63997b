// SPDX-License-Identifier: LGPL-2.1-or-later
// Art-gallery guards from a three-colouring of a triangulation.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "tetra/polygon/region.h"

namespace tetra {

/// Colours 0, 1, 2 for the corners of each triangle, all three in each.
///
/// Triangles that share a side agree on it where a spanning tree of the dual graph crosses that
/// side. For a simple polygon the dual is a tree and this is a colouring of its vertices. A
/// polygon with h holes has h further shared sides: it is taken as cut open along these, which
/// joins the holes to the outside and makes a simple polygon of n + 2h corners. Then a point may
/// have several colours.
std::vector<std::array<int, 3>> three_colouring(std::span<const PlanarTriangle> triangles);

/// Vertices such that every triangle has one of them as a corner, so all of the region is seen.
///
/// At most floor((n + 2h) / 3) for a component with n vertices and h holes, which is
/// floor(n / 3) for a simple polygon (Chvatal, Fisk) and floor((t + 2) / 3) by its t triangles:
/// the rarest colour of the component, less the guards whose triangles are all seen by others.
/// O(t log t), no geometry.
///
/// \return ids in increasing order.
std::vector<PointId> place_guards(std::span<const PlanarTriangle> triangles);

}  // namespace tetra
