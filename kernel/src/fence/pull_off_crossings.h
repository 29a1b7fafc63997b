// SPDX-License-Identifier: LGPL-2.1-or-later
// A changing set of edges seen along z, counting proper crossings.
#pragma once

#include <cstdint>
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
    struct Place {
        std::int64_t x, y;
    };
    // The line through two places; exact while coordinates are below 2^30 (pull_off()).
    struct PlanLine {
        PlanLine() = default;
        PlanLine(const Place& a, const Place& b)
            : dx(b.x - a.x), dy(b.y - a.y), c(dx * a.y - dy * a.x) {}
        // Are the places strictly on different sides?
        bool parts(const Place& p, const Place& q) const {
            const std::int64_t s = dx * p.y - dy * p.x - c, t = dx * q.y - dy * q.x - c;
            return (s > 0 && t < 0) || (s < 0 && t > 0);
        }
        std::int64_t dx = 0, dy = 0, c = 0;
    };
    struct Stored {
        Place from, to;
        PlanLine line;
        VertexPair ends;
        std::uint32_t stamp;
        int next;  // with the same lower vertex, or of the free ones; -1 ends a list
    };
    struct Entry {
        int edge, next;
    };
    template <class Visit>
    void visit_cells(const Place& from, const Place& to, const Visit& visit) const;
    Place place(int id) const {
        const Vec3i& p = points_[static_cast<std::size_t>(id)];
        return {p[0], p[1]};
    }

    const std::vector<Vec3i>& points_;
    std::vector<int> cells_;      // first entry, -1 = empty
    std::vector<Entry> entries_;  // of all cells, and free ones
    int free_entry_ = -1;
    std::vector<Stored> stored_;
    int free_edge_ = -1;
    std::vector<int> by_vertex_;  // first stored edge with this lower vertex
    std::uint32_t stamp_ = 0;
    double origin_[2] = {0, 0}, scale_ = 1;
    int columns_ = 1, rows_ = 1;
};

// All edges of the live triangles that are sharp, in ascending order.
std::vector<VertexPair> sharp_edges(const PullSurface& surface);

bool is_vertical(const PullSurface& surface, const VertexPair& edge);

}  // namespace tetra
