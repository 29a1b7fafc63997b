// SPDX-License-Identifier: LGPL-2.1-or-later
// Where runs begin and end: one solid in canonical order in, cells in the caller's coordinates out.
#include "collect_cells.h"

#include <algorithm>
#include <cmath>

#include "tetra/errors.h"

namespace tetra::notch {
namespace {

// About the origin of the grid, so that parts far from the caller's origin lose no digits.
double tetra_volume(const Vec3d& o, const Vec3d& a, const Vec3d& b, const Vec3d& c) {
    const auto d = [&](const Vec3d& p, int k) { return p[k] - o[k]; };
    double sum = 0;
    for (int k = 0; k < 3; ++k) {
        const int u = (k + 1) % 3, v = (k + 2) % 3;
        sum += d(a, k) * (d(b, u) * d(c, v) - d(b, v) * d(c, u));
    }
    return sum / 6;
}

class Collector {
  public:
    Collector(const GridSolid& solid, const Decomposition& r, ConvexCells& out)
        : solid_(solid),
          r_(r),
          out_(out),
          source_of_key_(static_cast<std::size_t>(2 * r.points.planes()), -1),
          number_(static_cast<std::size_t>(r.points.points()), -1),
          seen_(static_cast<std::size_t>(r.edges.size()), 0) {
        for (std::size_t t = 0; t < solid.triangles.size(); ++t) {
            int& s = source_of_key_[r.classes.key[t]];
            if (s < 0) s = solid.triangle_source[t];
        }
    }

    void add_cell(int seed) {
        std::vector<int> order{seed};
        seen_[seed] = 1;
        for (std::size_t i = 0; i < order.size(); ++i)
            for (const int n : {r_.edges[order[i]].next, r_.edges[order[i]].twin})
                if (!seen_[n]) {
                    seen_[n] = 1;
                    order.push_back(n);
                }
        for (const int h : order) {
            if (seen_[h] == 2) continue;
            for (int i = h; seen_[i] != 2; i = r_.edges[i].next) {
                seen_[i] = 2;
                out_.facet_vertices.push_back(point_number(r_.edges[i].org));
            }
            out_.facet_offsets.push_back(static_cast<std::int64_t>(out_.facet_vertices.size()));
            out_.facet_source.push_back(source_of_key_[r_.edges[h].key]);
        }
        out_.cell_offsets.push_back(static_cast<std::int64_t>(out_.facet_source.size()));
        out_.cell_solid.push_back(solid_.solid.front());
    }

  private:
    int point_number(int point) {
        int& n = number_[point];
        if (n < 0) {
            n = static_cast<int>(out_.points.size());
            out_.points.push_back(r_.placed[point]);
            out_.point_source.push_back(point < r_.points.inputs() ? solid_.point_source[point]
                                                                   : -1);
            out_.exact.push_back(r_.points.exact(point));
        }
        return n;
    }

    const GridSolid& solid_;
    const Decomposition& r_;
    ConvexCells& out_;
    std::vector<int> source_of_key_, number_;
    std::vector<char> seen_;
};

}  // namespace

GridSolid canonical_solid(const GridSolid& all, int solid) {
    GridSolid one;
    one.grid = all.grid;
    std::vector<int> used;
    for (std::size_t t = 0; t < all.triangles.size(); ++t)
        if (all.solid[t] == solid)
            used.insert(used.end(), all.triangles[t].begin(), all.triangles[t].end());
    std::sort(used.begin(), used.end(),
              [&](int a, int b) { return all.points[a] < all.points[b]; });
    used.erase(std::unique(used.begin(), used.end()), used.end());
    std::vector<int> rank(all.points.size(), -1);
    for (const int v : used) {
        rank[v] = static_cast<int>(one.points.size());
        one.points.push_back(all.points[v]);
        one.point_source.push_back(all.point_source[v]);
    }
    std::vector<std::pair<Triangle, int>> triangles;
    for (std::size_t t = 0; t < all.triangles.size(); ++t) {
        if (all.solid[t] != solid) continue;
        Triangle tri = all.triangles[t];
        for (int& v : tri) v = rank[v];
        std::rotate(tri.begin(), std::min_element(tri.begin(), tri.end()), tri.end());
        triangles.push_back({tri, all.triangle_source[t]});
    }
    std::sort(triangles.begin(), triangles.end());
    for (const auto& [tri, source] : triangles) {
        one.triangles.push_back(tri);
        one.triangle_source.push_back(source);
        one.solid.push_back(solid);
    }
    return one;
}

void collect_cells(const GridSolid& solid, const Decomposition& result, ConvexCells& out) {
    Collector collector(solid, result, out);
    for (const int seed : result.cells) collector.add_cell(seed);
}

void measure_volumes(const GridSolid& solid, const std::vector<Vec3d>& vertices,
                     ConvexCells& cells) {
    const Vec3d& o = solid.grid.origin;
    for (const Triangle& t : solid.triangles)
        cells.stats.solid_volume +=
            tetra_volume(o, vertices[solid.point_source[t[0]]], vertices[solid.point_source[t[1]]],
                         vertices[solid.point_source[t[2]]]);
    for (std::size_t f = 0; f + 1 < cells.facet_offsets.size(); ++f) {
        const auto first = static_cast<std::size_t>(cells.facet_offsets[f]);
        const auto last = static_cast<std::size_t>(cells.facet_offsets[f + 1]);
        const auto point = [&](std::size_t i) -> const Vec3d& {
            return cells.points[static_cast<std::size_t>(cells.facet_vertices[i])];
        };
        for (std::size_t i = first + 1; i + 1 < last; ++i)
            cells.stats.volume += tetra_volume(o, point(first), point(i), point(i + 1));
    }
    const double error = std::fabs(cells.stats.volume - cells.stats.solid_volume);
    if (error > 1e-6 * std::fabs(cells.stats.solid_volume))
        throw VerificationFailed("the cells' volumes do not add up to the solid's");
}

}  // namespace tetra::notch
