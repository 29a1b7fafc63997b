// SPDX-License-Identifier: LGPL-2.1-or-later
// Finds the base region around each flat point by the parity of a ray.
#include "flat_points.h"

#include <algorithm>

namespace tetra::fence {
namespace {

// Parity of the runs' crossings with the ray from the point towards +x; -1 on a run.
int inside(const Plan& plan, const Walls& walls, const std::vector<int>& runs, int point) {
    int parity = 0;
    for (const int r : runs) {
        const std::span<const int> of_run = walls.run_points[r];
        int lower = at(walls.points, of_run.front()).point;
        int upper = at(walls.points, of_run.back()).point;
        int low = plan.points.compare_axis(1, lower, point);
        int high = plan.points.compare_axis(1, upper, point);
        if (low > high) {
            std::swap(lower, upper);
            std::swap(low, high);
        }
        if (low > 0 || high < 0) continue;
        const int turn = plan.points.orient(lower, upper, point);
        if (turn == 0) {
            const int a = plan.points.compare_axis(0, lower, point);
            const int b = plan.points.compare_axis(0, upper, point);
            if (a * b <= 0) return -1;
        }
        if (low <= 0 && high > 0 && turn > 0) parity ^= 1;
    }
    return parity;
}

}  // namespace

std::vector<InnerPoint> locate_flat_points(const Plan& plan, const Walls& walls) {
    std::vector<InnerPoint> inner;
    if (plan.flat_points.empty()) return inner;
    std::vector<char> wanted(plan.facets.size(), 0);
    for (const int f : plan.flat_point_facet) at(wanted, f) = 1;
    struct Entry {
        int facet, partner, run;
        auto operator<=>(const Entry&) const = default;
    };
    std::vector<Entry> entries;
    for (int r = 0; r < static_cast<int>(walls.runs.size()); ++r) {
        const Run& run = at(walls.runs, r);
        if (at(wanted, run.floor)) entries.push_back({run.floor, run.ceiling, r});
        if (at(wanted, run.ceiling)) entries.push_back({run.ceiling, run.floor, r});
    }
    std::sort(entries.begin(), entries.end());
    for (std::size_t k = 0; k < plan.flat_points.size(); ++k) {
        const int facet = plan.flat_point_facet[k];
        if (at(plan.facets, facet).side == 0) continue;
        const int point = at(plan.point_of, plan.flat_points[k]);
        std::vector<int> runs;
        auto entry = std::lower_bound(entries.begin(), entries.end(), Entry{facet, -1, -1});
        while (entry != entries.end() && entry->facet == facet) {
            const int partner = entry->partner;
            runs.clear();
            for (; entry != entries.end() && entry->facet == facet && entry->partner == partner;
                 ++entry)
                runs.push_back(entry->run);
            if (inside(plan, walls, runs, point) != 1) continue;
            const bool floor = at(plan.facets, facet).side < 0;
            inner.push_back({floor ? facet : partner, floor ? partner : facet, point});
        }
    }
    return inner;
}

}  // namespace tetra::fence
