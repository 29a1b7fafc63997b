// SPDX-License-Identifier: LGPL-2.1-or-later
// Hulls with the ids of the part's points, and samples of their facets.
#include "hull_stray.h"

#include <algorithm>
#include <queue>

#include "convex_hull.h"

namespace tetra {
namespace {

constexpr double kSlack = 1.05;
constexpr int kMostPlaces = 1000;  // divided triangles

std::size_t at(int i) { return static_cast<std::size_t>(i); }

struct Place {
    double bound;
    Corners corners;
    bool operator<(const Place& o) const {
        return bound != o.bound ? bound < o.bound : corners < o.corners;
    }
};

}  // namespace

MergedHull hull_of_points(std::span<const Vec3d> points, const std::vector<int>& ids) {
    std::vector<Vec3d> local;
    local.reserve(ids.size());
    for (const int i : ids) local.push_back(points[at(i)]);
    MergedHull hull;
    hull.triangles = convex_hull(local);
    hull.volume6 = volume6(local, hull.triangles);
    for (Triangle& t : hull.triangles)
        for (int& corner : t) {
            corner = ids[at(corner)];
            hull.points.push_back(corner);
        }
    std::sort(hull.points.begin(), hull.points.end());
    hull.points.erase(std::unique(hull.points.begin(), hull.points.end()), hull.points.end());
    if (hull.triangles.empty()) hull.points = ids;
    return hull;
}

double farthest_of(const PartDistance& distance, std::span<const Corners> triangles, double known,
                   double enough) {
    std::priority_queue<Place> queue;
    double found = known;
    const auto enter = [&](const Corners& corners) {
        const Ball ball = ball_around(corners);
        if (ball.radius <= std::max(kSlack * found, distance.coarse())) return;
        const std::optional<double> middle = distance.of_middle(corners);
        if (!middle) return;
        found = std::max(found, *middle);
        const double bound = *middle + ball.radius;
        if (bound > kSlack * found) queue.push({bound, corners});
    };
    for (const Corners& corners : triangles) enter(corners);
    for (int seen = 0; !queue.empty() && seen < kMostPlaces && found < enough; ++seen) {
        const Place next = queue.top();
        queue.pop();
        if (next.bound <= kSlack * found || next.bound <= distance.coarse()) break;
        for (const Corners& quarter : quarters(next.corners)) enter(quarter);
    }
    return found;
}

}  // namespace tetra
