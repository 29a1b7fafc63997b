// SPDX-License-Identifier: LGPL-2.1-or-later
// Runs notch cutting per solid, takes back plane classes that contradict themselves, and verifies.
#include "tetra/notch/convex_cells.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "check_cells.h"
#include "collect_cells.h"
#include "place_points.h"
#include "tetra/errors.h"

namespace tetra {
namespace {

using namespace notch;

struct Attempt {
    Decomposition result;
    double delta = 0;
    int restarts = 0, demoted = 0;
};

constexpr int kMaxRestarts = 24;

// Relative error of volume that plane classes may cause.
constexpr double kVolumeTolerance = 2e-8;

class Cutter {
  public:
    Cutter(const std::vector<Vec3d>& vertices, const CellsOptions& options, Progress& progress)
        : vertices_(vertices), options_(options), progress_(progress) {}

    void add_solid(const GridSolid& solid) {
        std::optional<Attempt> best;
        for (int i = 0; i < std::max(1, options_.tries); ++i) {
            Attempt a = attempt(solid, static_cast<std::uint64_t>(i));
            if (!best || a.result.cells.size() < best->result.cells.size()) best = std::move(a);
        }
        collect_cells(solid, best->result, out_);
        set_stats(*best);
    }

    ConvexCells take() { return std::move(out_); }

  private:
    // Plane classes first; those that contradict themselves go back to exact triangles; at last
    // exact planes only, which always work (NOTCHES 4).
    Attempt attempt(const GridSolid& solid, std::uint64_t seed) {
        std::vector<char> demoted;
        Attempt a{Decomposition(solid.grid.bits)};
        for (a.delta = options_.flatness; a.delta > 0 && a.restarts <= kMaxRestarts;) {
            a.result = decompose(solid, options_, a.delta, demoted, seed, progress_);
            std::vector<std::vector<int>> at_fault = a.result.contradictions;
            if (at_fault.empty()) {
                place_points(solid, vertices_, a.result);
                std::vector<Fault> faults = find_faults(solid.grid, a.result);
                if (faults.empty()) return a;
                for (Fault& fault : faults) at_fault.push_back(std::move(fault.planes));
            }
            ++a.restarts;
            if (!demote(a.result.classes, at_fault, demoted, a.demoted)) break;
        }
        a.delta = 0;
        a.result = decompose(solid, options_, 0, {}, seed, progress_);
        if (!a.result.contradictions.empty())
            throw VerificationFailed("notch cutting: a section does not close");
        place_points(solid, vertices_, a.result);
        const std::vector<Fault> faults = find_faults(solid.grid, a.result);
        if (!faults.empty()) throw VerificationFailed("notch cutting: " + faults.front().reason);
        return a;
    }

    // Takes back the smallest class of each contradiction: the exact planes of its triangles are
    // marked. False when no class is involved.
    static bool demote(const PlaneClasses& classes, const std::vector<std::vector<int>>& at_fault,
                       std::vector<char>& demoted, int& count) {
        std::vector<int> size(classes.is_class.size(), 0);
        for (const int key : classes.key) ++size[key >> 1];
        std::vector<char> chosen(size.size(), 0);
        for (const std::vector<int>& planes : at_fault) {
            int smallest = -1;
            for (const int p : planes)
                if (p < static_cast<int>(size.size()) && classes.is_class[p] &&
                    (smallest < 0 || size[p] < size[smallest]))
                    smallest = p;
            if (smallest >= 0) chosen[smallest] = 1;
        }
        bool any = false;
        demoted.resize(classes.is_class.size(), 0);
        for (std::size_t t = 0; t < classes.key.size(); ++t)
            if (chosen[classes.key[t] >> 1]) demoted[classes.exact_key[t] >> 1] = any = true;
        count += static_cast<int>(std::count(chosen.begin(), chosen.end(), 1));
        return any;
    }

    void set_stats(const Attempt& a) {
        CellsStats& s = out_.stats;
        s.notches = a.result.notches;
        s.planes = a.result.planes;
        s.cuts = a.result.cuts;
        s.splices = a.result.splices;
        s.raw_cells = a.result.raw_cells;
        s.restarts = a.restarts;
        s.demoted = a.demoted;
        s.flatness = a.result.uses_classes() ? a.delta : 0;
        s.exact = a.result.exact;
    }

    const std::vector<Vec3d>& vertices_;
    const CellsOptions& options_;
    Progress& progress_;
    ConvexCells out_;
};

ConvexCells cut_solid(const GridSolid& solid, const std::vector<Vec3d>& vertices,
                      const CellsOptions& options, Progress& progress) {
    Cutter cutter(vertices, options, progress);
    cutter.add_solid(solid);
    return cutter.take();
}

// The cells of one solid. Plane classes that are too coarse for a thin one show in its volume:
// then exact planes only.
ConvexCells cells_of_solid(const GridSolid& solid, const std::vector<Vec3d>& vertices,
                           CellsOptions options, Progress& progress) {
    if (options.flatness > 0) {
        ConvexCells cells = cut_solid(solid, vertices, options, progress);
        try {
            measure_volumes(solid, vertices, cells);
            const double whole = cells.stats.solid_volume;
            if (std::fabs(cells.stats.volume - whole) <= kVolumeTolerance * std::fabs(whole))
                return cells;
        } catch (const VerificationFailed&) {
            // Far off: exact planes will tell whether the classes were to blame.
        }
        options.flatness = 0;
    }
    ConvexCells cells = cut_solid(solid, vertices, options, progress);
    measure_volumes(solid, vertices, cells);
    return cells;
}

void add_stats(CellsStats& s, const CellsStats& t) {
    s.notches += t.notches;
    s.planes += t.planes;
    s.cuts += t.cuts;
    s.splices += t.splices;
    s.raw_cells += t.raw_cells;
    s.restarts += t.restarts;
    s.demoted += t.demoted;
    s.flatness = std::max(s.flatness, t.flatness);
    s.exact = s.exact && t.exact;
    s.volume += t.volume;
    s.solid_volume += t.solid_volume;
}

void append(ConvexCells& all, ConvexCells&& one) {
    const int points = static_cast<int>(all.points.size());
    const auto vertices = static_cast<std::int64_t>(all.facet_vertices.size());
    const auto facets = static_cast<std::int64_t>(all.facet_source.size());
    const auto extend = [](auto& to, const auto& from) {
        to.insert(to.end(), from.begin(), from.end());
    };
    extend(all.points, one.points);
    extend(all.point_source, one.point_source);
    extend(all.exact, one.exact);
    extend(all.facet_source, one.facet_source);
    extend(all.cell_solid, one.cell_solid);
    for (const int v : one.facet_vertices) all.facet_vertices.push_back(v + points);
    for (std::size_t i = 1; i < one.facet_offsets.size(); ++i)
        all.facet_offsets.push_back(one.facet_offsets[i] + vertices);
    for (std::size_t i = 1; i < one.cell_offsets.size(); ++i)
        all.cell_offsets.push_back(one.cell_offsets[i] + facets);
    add_stats(all.stats, one.stats);
}

}  // namespace

ConvexCells convex_cells(const GridSolid& solid, const std::vector<Vec3d>& vertices,
                         const CellsOptions& options, Progress& progress) {
    if (solid.grid.bits > 26)
        throw VerificationFailed("notch cutting needs a grid of at most 26 bits");
    std::vector<int> ids = solid.solid;
    std::sort(ids.begin(), ids.end());
    ids.erase(std::unique(ids.begin(), ids.end()), ids.end());
    ConvexCells cells;
    for (const int id : ids)
        append(cells, cells_of_solid(canonical_solid(solid, id), vertices, options, progress));
    return cells;
}

}  // namespace tetra
