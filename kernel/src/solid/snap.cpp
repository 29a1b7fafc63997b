// SPDX-License-Identifier: LGPL-2.1-or-later
// Snapping: vertices to grid points, equal points merged, collapsed triangles dropped.
#include "tetra/solid/snap.h"

#include <algorithm>
#include <numeric>

#include "tetra/solid/edges.h"

namespace tetra {
namespace {

std::vector<int> used_vertices(const SurfaceView& surface) {
    std::vector<char> used(surface.vertices.size(), 0);
    for (const Triangle& t : surface.triangles)
        for (const int v : t) used[static_cast<std::size_t>(v)] = 1;
    std::vector<int> ids;
    for (std::size_t v = 0; v < used.size(); ++v)
        if (used[v]) ids.push_back(static_cast<int>(v));
    return ids;
}

// Fills points and point_source; returns the point of every vertex (-1 when unused).
std::vector<int> merge_points(const SurfaceView& surface, const std::vector<int>& used,
                              GridSolid& result) {
    std::vector<Vec3i> places(used.size());
    for (std::size_t i = 0; i < used.size(); ++i)
        places[i] = snap(result.grid, surface.vertices[static_cast<std::size_t>(used[i])]);
    std::vector<int> order(used.size());
    std::iota(order.begin(), order.end(), 0);
    std::sort(order.begin(), order.end(), [&](int a, int b) {
        const Vec3i &p = places[static_cast<std::size_t>(a)],
                    &q = places[static_cast<std::size_t>(b)];
        return p != q ? p < q : a < b;
    });
    std::vector<int> leader(used.size());
    for (std::size_t i = 0; i < order.size(); ++i) {
        const auto at = static_cast<std::size_t>(order[i]);
        const bool same = i > 0 && places[at] == places[static_cast<std::size_t>(order[i - 1])];
        leader[at] = same ? leader[static_cast<std::size_t>(order[i - 1])] : order[i];
    }
    std::vector<int> point_of(surface.vertices.size(), -1);
    for (std::size_t i = 0; i < used.size(); ++i) {
        const auto v = static_cast<std::size_t>(used[i]);
        if (leader[i] == static_cast<int>(i)) {
            point_of[v] = static_cast<int>(result.points.size());
            result.points.push_back(places[i]);
            result.point_source.push_back(used[i]);
        } else {
            point_of[v] =
                point_of[static_cast<std::size_t>(used[static_cast<std::size_t>(leader[i])])];
        }
    }
    return point_of;
}

}  // namespace

GridSolid merge_on_grid(const SurfaceView& surface, int bits, SnapReport* report) {
    const std::vector<int> used = used_vertices(surface);
    std::vector<Vec3d> coordinates;
    coordinates.reserve(used.size());
    for (const int v : used) coordinates.push_back(surface.vertices[static_cast<std::size_t>(v)]);
    GridSolid result;
    result.grid = grid_for(coordinates, bits);
    const std::vector<int> point_of = merge_points(surface, used, result);
    for (std::size_t t = 0; t < surface.triangles.size(); ++t) {
        Triangle corners;
        for (std::size_t k = 0; k < 3; ++k)
            corners[k] = point_of[static_cast<std::size_t>(surface.triangles[t][k])];
        if (corners[0] == corners[1] || corners[1] == corners[2] || corners[2] == corners[0])
            continue;
        result.triangles.push_back(corners);
        result.triangle_source.push_back(
            surface.triangle_source.empty() ? static_cast<int>(t) : surface.triangle_source[t]);
        result.solid.push_back(surface.solid.empty() ? 0 : surface.solid[t]);
    }
    if (report) {
        report->merged_points += static_cast<int>(used.size() - result.points.size());
        report->dropped_triangles +=
            static_cast<int>(surface.triangles.size() - result.triangles.size());
    }
    return result;
}

GridSolid build_grid_solid(const SurfaceView& surface, int bits, SnapReport* report) {
    GridSolid merged = merge_on_grid(surface, bits, report);
    if (std::vector<Defect> defects = find_boundary_defects(merged); !defects.empty())
        throw InvalidSolid(std::move(defects));
    GridSolid result = repair_flat_triangles(std::move(merged), report);
    if (result.triangles.empty())
        throw InvalidSolid({{"flat_solid", {}, {}, "the solid has no volume on the grid"}});
    return result;
}

}  // namespace tetra
