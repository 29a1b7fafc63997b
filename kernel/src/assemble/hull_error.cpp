// SPDX-License-Identifier: LGPL-2.1-or-later
// Branch and bound on triangles, the one that may hold the farthest point first.
#include "hull_error.h"

#include <queue>

namespace tetra {
namespace {

constexpr double kSlack = 1.05;
constexpr int kMostTriangles = 20'000;

struct Candidate {
    double bound;
    Corners corners;
    bool operator<(const Candidate& o) const {
        return bound != o.bound ? bound < o.bound : corners < o.corners;
    }
};

}  // namespace

double hull_error(std::span<const Vec3d> points, std::span<const Triangle> triangles,
                  const PartDistance& distance, double& found, Progress& progress) {
    std::priority_queue<Candidate> queue;
    const auto enter = [&](const Corners& corners) {
        const std::optional<double> middle = distance.of_middle(corners);
        if (!middle) return;
        found = std::max(found, *middle);
        const double bound = *middle + ball_around(corners).radius;
        if (bound > kSlack * found) queue.push({bound, corners});
    };
    for (const Triangle& t : triangles) {
        Corners corners;
        double farthest = 0;
        for (std::size_t k = 0; k < 3; ++k) {
            corners[k] = points[static_cast<std::size_t>(t[k])];
            farthest = std::max(farthest, distance(corners[k]));
        }
        found = std::max(found, farthest);
        // From any point of a triangle its nearest corner is no farther than the radius.
        if (farthest + ball_around(corners).radius > kSlack * found) enter(corners);
    }
    // What is left out reaches no farther than `left`, or touches the part.
    double left = distance.touching();
    for (int seen = 0; !queue.empty(); ++seen) {
        const Candidate next = queue.top();
        if (next.bound <= kSlack * found) break;
        if (seen >= kMostTriangles) {
            left = next.bound;
            break;
        }
        queue.pop();
        progress.poll("hull_error", 0);
        for (const Corners& quarter : quarters(next.corners)) enter(quarter);
    }
    return std::max(left, kSlack * found);
}

}  // namespace tetra
