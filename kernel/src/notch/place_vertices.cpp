// SPDX-License-Identifier: LGPL-2.1-or-later
// Three-plane vertices of plane classes.
#include "place_vertices.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace tetra::notch {
namespace {

constexpr double kFarthestMove = 8;  // grid steps

struct Place {
    HPoint exact;
    Vec3d approx;
};

Vec3d as_doubles(const Vec3i& p) {
    return {static_cast<double>(p[0]), static_cast<double>(p[1]), static_cast<double>(p[2])};
}

std::vector<std::vector<int>> planes_of_vertices(const GridSolid& solid,
                                                 const PlaneClasses& classes) {
    std::vector<std::vector<int>> planes(solid.points.size());
    for (std::size_t t = 0; t < solid.triangles.size(); ++t)
        for (const int v : solid.triangles[t]) {
            std::vector<int>& list = planes[v];
            const int plane = classes.key[t] >> 1;
            if (std::find(list.begin(), list.end(), plane) == list.end()) list.push_back(plane);
        }
    return planes;
}

// The meeting point of a vertex' three planes when its grid place is not on all of them.
std::optional<Place> moved_place(const Vec3i& grid, const std::vector<int>& planes,
                                 const PointTable& points) {
    if (planes.size() != 3) return std::nullopt;
    bool on_all = true;
    for (const int p : planes) on_all &= plane_value(points.plane(p), grid) == 0;
    if (on_all) return std::nullopt;
    const Plane &a = points.plane(planes[0]), &b = points.plane(planes[1]),
                &c = points.plane(planes[2]);
    if (det_normals(a, b, c).is_zero()) return std::nullopt;
    Place place;
    place.exact = meet(a, b, c);
    place.approx = to_doubles(place.exact);
    for (int k = 0; k < 3; ++k)
        if (std::fabs(place.approx[k] - static_cast<double>(grid[k])) > kFarthestMove)
            return std::nullopt;
    return place;
}

// An edge must not turn round when its ends move.
void keep_directions(const GridSolid& solid, std::vector<std::optional<Place>>& places) {
    const auto at = [&](int v) {
        return places[v] ? places[v]->approx : as_doubles(solid.points[v]);
    };
    for (bool again = true; again;) {
        again = false;
        for (const Triangle& t : solid.triangles)
            for (int k = 0; k < 3; ++k) {
                const int u = t[k], v = t[(k + 1) % 3];
                if (!places[u] && !places[v]) continue;
                const Vec3d p = at(u), q = at(v);
                double dot = 0, size = 0;
                for (int i = 0; i < 3; ++i) {
                    const double d = static_cast<double>(solid.points[v][i] - solid.points[u][i]);
                    dot += (q[i] - p[i]) * d;
                    size += d * d;
                }
                if (dot > 0.25 * size) continue;
                places[u].reset();
                places[v].reset();
                again = true;
            }
    }
}

}  // namespace

void place_vertices(const GridSolid& solid, const PlaneClasses& classes, PointTable& points) {
    const std::vector<std::vector<int>> planes = planes_of_vertices(solid, classes);
    std::vector<std::optional<Place>> places(solid.points.size());
    for (std::size_t v = 0; v < places.size(); ++v)
        places[v] = moved_place(solid.points[v], planes[v], points);
    keep_directions(solid, places);
    for (std::size_t v = 0; v < places.size(); ++v) {
        if (places[v])
            points.add_moved_input(solid.points[v], places[v]->exact, places[v]->approx);
        else
            points.add_input(solid.points[v]);
        for (const int p : planes[v]) points.set_on(static_cast<int>(v), p);
    }
}

}  // namespace tetra::notch
