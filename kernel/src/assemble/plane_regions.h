// SPDX-License-Identifier: LGPL-2.1-or-later
// Regions of exact points in a plane: their borders as chains of edges, and their triangles.
#pragma once

#include <vector>

#include "../notch/half_edges.h"
#include "tetra/polygon/region.h"

namespace tetra::cells {

using notch::PointTable;

using Edges = std::vector<DirectedEdge>;

// A plane (key = 2 plane + side) seen from outside: along the axis in which its normal is longest.
class PlaneView final : public PointOracle {
  public:
    PlaneView(const PointTable& points, int key);
    int compare(PointId i, PointId j) const override;
    int orient(PointId i, PointId j, PointId k) const override;

  private:
    const PointTable& points_;
    int axis_ = 0, flip_ = 1;
};

// What is left when opposite edges cancel, each edge once, sorted.
Edges without_opposites(Edges edges);

// Triangles of the region on the left of the edges, with more vertices inside it.
// \throw VerificationFailed when they bound no region.
std::vector<PlanarTriangle> triangles_of_region(const Edges& edges, const PlaneView& view,
                                                const std::vector<PointId>& inner);

// Triangles of a convex polygon with points on its sides, its edges in order: a fan from the first
// corner (by id) that sees no two of them in a row, so that cells can be cones from that corner.
std::vector<PlanarTriangle> triangles_of_convex(const Edges& loop, const PlaneView& view);

}  // namespace tetra::cells
