// SPDX-License-Identifier: LGPL-2.1-or-later
// How much to pull off: by counted crossings of projected sharp edges (PULLOFF A1).
#include <algorithm>

#include "tetrahedralize_solid.h"

namespace tetra {
namespace {

constexpr int kSampled = 400;  // edges

PullOff chosen(PullOff state, const char* name, SolidReport& report) {
    report.pulled = name;
    report.pull = state.statistics;
    report.cup_tets = 0;
    for (const Cup& cup : state.cups) report.cup_tets += static_cast<int>(cup.dome.size());
    return state;
}

}  // namespace

PullOff untouched(const GridSolid& solid, const std::vector<int>& owners) {
    PullOff state;
    state.triangles = solid.triangles;
    state.owners = owners;
    for (const int owner : owners) state.first_cup = std::max(state.first_cup, owner + 1);
    return state;
}

PullOff choose_pull(const std::vector<Vec3i>& framed, const GridSolid& solid,
                    const std::vector<int>& owners, PullPolicy policy, const PullOff* everything,
                    SolidReport& report, Progress& progress) {
    report.crossings.clear();
    PullOff none = untouched(solid, owners);
    if (policy == PullPolicy::off) return chosen(std::move(none), "none", report);
    PullOff all =
        everything ? *everything : pull_off(solid.points, solid.triangles, owners, {}, progress);
    if (policy == PullPolicy::on || all.triangles.empty())
        return chosen(std::move(all), "all", report);
    if (all.cups.empty()) return chosen(std::move(none), "none", report);
    const auto crossings = [&](const PullOff& state) {
        return projected_crossings(framed, state.triangles, state.owners, progress, kSampled);
    };
    const std::int64_t k_none = crossings(none);
    report.crossings = {{"none", k_none}};
    // A tie goes to the least pulling: without fewer crossings it only adds tetrahedra.
    if (k_none == 0) return chosen(std::move(none), "none", report);
    const std::int64_t k_all = crossings(all);
    report.crossings.emplace_back("all", k_all);
    if (k_all < k_none) return chosen(std::move(all), "all", report);
    PullOff some = pull_off(framed, solid.triangles, owners, {25, PullMode::crossings}, progress);
    report.crossings.emplace_back("crossings", some.crossings_after);
    if (some.crossings_after < k_none) return chosen(std::move(some), "crossings", report);
    return chosen(std::move(none), "none", report);
}

}  // namespace tetra
