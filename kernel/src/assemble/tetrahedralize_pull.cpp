// SPDX-License-Identifier: LGPL-2.1-or-later
// How much to pull off: by counted crossings of projected sharp edges (PULLOFF A1).
#include <algorithm>

#include "tetrahedralize_solid.h"

namespace tetra {
namespace {

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
    PullOff some = pull_off(framed, solid.triangles, owners, {25, PullMode::crossings}, progress);
    const std::int64_t k_none = some.crossings_before, k_some = some.crossings_after;
    const std::int64_t k_all =
        projected_crossings(framed, all.triangles, all.owners, progress, std::min(k_none, k_some));
    report.crossings = {{"none", k_none}, {"crossings", k_some}, {"all", k_all}};
    // A tie goes to the least pulling: without fewer crossings it only adds tetrahedra.
    if (k_all < std::min(k_none, k_some)) return chosen(std::move(all), "all", report);
    if (k_some < k_none) return chosen(std::move(some), "crossings", report);
    return chosen(std::move(none), "none", report);
}

}  // namespace tetra
