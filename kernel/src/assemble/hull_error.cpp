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

void raise_to(HullError& error, std::span<const Vec3d> points, std::span<const Triangle> triangles,
              const PartDistance& distance, Progress& progress) {
    std::priority_queue<Candidate> queue;
    const auto enter = [&](const Corners& corners) {
        const Ball ball = ball_around(corners);
        if (ball.radius <= kSlack * error.found || distance.in_one_cell(corners)) return;
        const double middle = distance(ball.middle);
        error.found = std::max(error.found, middle);
        if (middle + ball.radius > kSlack * error.found)
            queue.push({middle + ball.radius, corners});
    };
    for (const Triangle& t : triangles) {
        Corners corners;
        for (std::size_t k = 0; k < 3; ++k) corners[k] = points[static_cast<std::size_t>(t[k])];
        for (const Vec3d& p : corners) error.found = std::max(error.found, distance(p));
        enter(corners);
    }
    for (int seen = 0; !queue.empty(); ++seen) {
        const Candidate next = queue.top();
        if (next.bound <= kSlack * error.found) break;
        if (seen >= kMostTriangles) {
            error.bound = std::max(error.bound, next.bound);
            break;
        }
        queue.pop();
        progress.poll("hull_error", 0);
        for (const Corners& quarter : quarters(next.corners)) enter(quarter);
    }
    // What was left out reaches no farther than that, or touches the part.
    error.bound = std::max({error.bound, kSlack * error.found, distance.touching()});
}

}  // namespace tetra
