// SPDX-License-Identifier: LGPL-2.1-or-later
// Looking for the coarsest grid that keeps a valid surface valid.
#include "tetra/solid/validate.h"

namespace tetra {
namespace {

struct Try {
    GridSolid solid;
    SnapReport report;
    bool valid = false;     // closed, with volume, not crossing itself
    bool faithful = false;  // besides, points distinct and no new contact of facets
};

Try try_grid(const SurfaceView& surface, int facet_contacts, int bits, Progress& progress) {
    Try t;
    try {
        t.solid = build_grid_solid(surface, bits, &t.report);
    } catch (const InvalidSolid&) {
        return t;
    }
    const GridSolid& s = t.solid;
    const Sheets sheets = pair_half_edges(s.points, s.triangles, s.solid);
    for (const Int256& v : find_shells(s.points, s.triangles, sheets.twin).volume)
        if (v.is_zero()) return t;
    const BoxTree tree = build_box_tree(s.points, s.triangles);
    const Crossings crossings = find_crossings(s, sheets, tree, 1, progress);
    t.valid = crossings.pairs.empty();
    t.faithful =
        t.valid && t.report.merged_points == 0 && crossings.facet_contacts <= facet_contacts;
    return t;
}

}  // namespace

GridChoice choose_grid(const std::vector<Vec3d>& vertices, const Validation& valid, int lowest,
                       int highest, Progress& progress) {
    return choose_grid(valid.surface(vertices), valid.counts.facet_contacts, lowest, highest,
                       progress);
}

GridChoice choose_grid(const SurfaceView& surface, int facet_contacts, int lowest, int highest,
                       Progress& progress) {
    GridChoice fallback;
    bool found = false;
    std::vector<int> rejected;
    for (int bits = lowest; bits <= highest; ++bits) {
        Try t = try_grid(surface, facet_contacts, bits, progress);
        if (t.faithful) return {std::move(t.solid), t.report, std::move(rejected)};
        if (t.valid && !found) {
            found = true;
            fallback = {std::move(t.solid), t.report, rejected};
        }
        rejected.push_back(bits);
    }
    if (found) return fallback;
    std::vector<Defect> defects;
    try {
        defects = find_defects(build_grid_solid(surface, highest), progress);
    } catch (const InvalidSolid& e) {
        defects = e.defects;
    }
    for (Defect& d : defects)
        d.message += " (when rounded to a grid of 2^" + std::to_string(highest) +
                     " steps: details are too fine for the size of the part)";
    throw InvalidSolid(std::move(defects));
}

}  // namespace tetra
