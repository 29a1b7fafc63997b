// SPDX-License-Identifier: LGPL-2.1-or-later
// A changing set of edges seen along z, counting proper crossings.
#pragma once

#include <cstdint>
#include <unordered_map>
#include <vector>

#include "pull_off_surface.h"

namespace tetra {

using VertexPair = std::array<int, 2>;  // smaller id first

VertexPair vertex_pair(int a, int b);

class ProjectedEdges {
  public:
    // A uniform grid of about `expected` cells over all points.
    ProjectedEdges(const std::vector<Vec3i>& points, std::size_t expected);

    void insert(const VertexPair& edge);
    void erase(const VertexPair& edge);
    std::int64_t crossings(const VertexPair& edge);

  private:
    struct Stored {
        VertexPair ends;
        std::uint32_t stamp;
    };
    template <class Visit>
    void visit_cells(const VertexPair& edge, const Visit& visit) const;
    bool cross(const VertexPair& e, const VertexPair& f) const;
    const Vec3i& point(int id) const { return points_[static_cast<std::size_t>(id)]; }

    const std::vector<Vec3i>& points_;
    std::vector<std::vector<int>> cells_;
    std::vector<Stored> stored_;
    std::unordered_map<std::uint64_t, int> ids_;
    std::vector<int> free_;
    std::uint32_t stamp_ = 0;
    double origin_[2] = {0, 0}, scale_ = 1;
    int columns_ = 1, rows_ = 1;
};

// All edges of the live triangles that are sharp, in ascending order.
std::vector<VertexPair> sharp_edges(const PullSurface& surface);

bool is_vertical(const PullSurface& surface, const VertexPair& edge);

}  // namespace tetra
