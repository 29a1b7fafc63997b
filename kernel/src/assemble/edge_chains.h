// SPDX-License-Identifier: LGPL-2.1-or-later
// Points that the meshes of several solids put on one common edge, in order from end to end.
#pragma once

#include <map>
#include <utility>
#include <vector>

#include "tetra/exact/grid.h"
#include "vec3.h"

namespace tetra {

class EdgeChains {
  public:
    // On the straight edge from u to v, or on a part of an edge that is divided already. True when
    // the point is new there. O(points of the edge).
    bool add(int u, int v, int point, const std::vector<Vec3d>& points);

    // The points between u and v on one edge, from the lower id on; none when no edge has both.
    std::vector<int> between(int u, int v) const;

    // Per divided edge its lower end, its points in order, and its upper end.
    const std::map<std::pair<int, int>, std::vector<int>>& chains() const { return chains_; }

  private:
    using Edge = std::pair<int, int>;  // the lower end first

    const std::vector<int>* chain_of(int u, int v) const;

    std::map<Edge, std::vector<int>> chains_;
    std::map<int, Edge> edge_of_;  // of inner points of chains
};

}  // namespace tetra
