// SPDX-License-Identifier: LGPL-2.1-or-later
// Merge, enclose, measure: the steps from exact cells to those an engine takes.
#include "tetra/assemble/limit_cells.h"

#include <algorithm>
#include <cmath>

#include "convex_hull.h"
#include "hull_error.h"
#include "hull_planes.h"
#include "merge_hulls.h"
#include "shift_cells.h"

namespace tetra {
namespace {

std::size_t at(std::int64_t i) { return static_cast<std::size_t>(i); }

std::vector<std::vector<int>> points_of_cells(const CellArrays& part) {
    std::vector<std::vector<int>> cells(part.cell_solid.size());
    for (std::size_t c = 0; c < cells.size(); ++c) {
        const auto begin = part.facet_offsets[at(part.cell_offsets[c])];
        const auto end = part.facet_offsets[at(part.cell_offsets[c + 1])];
        cells[c].assign(part.facet_vertices.begin() + begin, part.facet_vertices.begin() + end);
        std::sort(cells[c].begin(), cells[c].end());
        cells[c].erase(std::unique(cells[c].begin(), cells[c].end()), cells[c].end());
    }
    return cells;
}

std::vector<MergedHull> unmerged(const std::vector<std::vector<int>>& cells) {
    std::vector<MergedHull> hulls(cells.size());
    for (std::size_t c = 0; c < cells.size(); ++c) {
        hulls[c].cells = {static_cast<int>(c)};
        hulls[c].points = cells[c];
    }
    return hulls;
}

class Limiter {
  public:
    Limiter(const CellArrays& part, const Limits& limits, Progress& progress)
        : part_(part),
          limits_(limits),
          progress_(progress),
          distance_(part),
          cells_(points_of_cells(part)) {
        result_.points = part.points;
    }

    LimitedCells run() {
        const bool too_many =
            limits_.max_cells > 0 && cells_.size() > static_cast<std::size_t>(limits_.max_cells);
        const std::vector<MergedHull> hulls = too_many ? merged() : unmerged(cells_);
        for (const MergedHull& hull : hulls) add(hull);
        if (!changed_.empty()) measure();
        return std::move(result_);
    }

  private:
    // A piece that is not a cell as given: where its hull and its final triangles stand.
    struct Changed {
        std::vector<Triangle> hull, triangles;
        double growth6;     // of the final piece over its cells
        double simplified;  // how far the final piece reaches beyond the hull
    };
    const CellArrays& part_;
    const Limits& limits_;
    Progress& progress_;
    PartDistance distance_;
    std::vector<std::vector<int>> cells_;
    std::vector<Changed> changed_;
    LimitedCells result_;

    std::vector<MergedHull> merged() {
        return shift_cells(part_, cells_, distance_,
                           merge_hulls(part_, cells_, distance_, limits_.max_cells, progress_),
                           progress_);
    }

    double cell_volume6(int c) const {
        return volume6(part_.points,
                       fans(part_, part_.cell_offsets[at(c)], part_.cell_offsets[at(c + 1)]));
    }

    void add(const MergedHull& hull) {
        const bool merged = hull.cells.size() > 1;
        const auto count =
            static_cast<int>(merged ? hull.points.size() : cells_[at(hull.cells.front())].size());
        const bool crowded = limits_.max_vertices > 0 && count > limits_.max_vertices;
        LimitedPiece piece{hull.cells, {}};
        if (merged || crowded) {
            Changed change{merged ? hull.triangles : hull_of(hull.points), {}, 0, 0};
            change.triangles = change.hull;
            if (crowded) simplify(change);
            if (!change.triangles.empty()) {
                change.growth6 = volume6(result_.points, change.triangles);
                for (const int c : hull.cells) change.growth6 -= cell_volume6(c);
                piece.triangles = change.triangles;
                result_.merged += merged;
                result_.simplified += crowded;
                changed_.push_back(std::move(change));
            }
        }
        result_.pieces.push_back(std::move(piece));
    }

    std::vector<Triangle> hull_of(const std::vector<int>& ids) const {
        std::vector<Vec3d> points;
        for (const int i : ids) points.push_back(part_.points[at(i)]);
        std::vector<Triangle> triangles = convex_hull(points);
        for (Triangle& t : triangles)
            for (int& corner : t) corner = ids[at(corner)];
        return triangles;
    }

    // Encloses the hull by a polytope on points of its own, which join the others.
    void simplify(Changed& change) {
        std::vector<int> ids;
        for (const Triangle& t : change.hull) ids.insert(ids.end(), t.begin(), t.end());
        std::sort(ids.begin(), ids.end());
        ids.erase(std::unique(ids.begin(), ids.end()), ids.end());
        std::vector<Vec3d> points;
        for (const int i : ids) points.push_back(part_.points[at(i)]);
        std::vector<Triangle> local = change.hull;
        for (Triangle& t : local)
            for (int& corner : t)
                corner = static_cast<int>(std::lower_bound(ids.begin(), ids.end(), corner) -
                                          ids.begin());
        Polytope fewer = enclosed_by_fewer(points, local, limits_.max_vertices);
        const int first = static_cast<int>(result_.points.size());
        const std::vector<HalfSpace> halves = half_spaces(points, local);
        for (const Vec3d& p : fewer.points) {
            const auto out = [&](const HalfSpace& h) { return beyond(h, p) > 0; };
            if (std::any_of(halves.begin(), halves.end(), out))
                change.simplified = std::max(change.simplified, distance_to(p, points, local));
        }
        result_.points.insert(result_.points.end(), fewer.points.begin(), fewer.points.end());
        change.triangles = std::move(fewer.triangles);
        for (Triangle& t : change.triangles)
            for (int& corner : t) corner += first;
    }

    // The pieces that grew most come first: what they reach spares the others the search.
    void measure() {
        std::stable_sort(changed_.begin(), changed_.end(),
                         [](const Changed& x, const Changed& y) { return x.growth6 > y.growth6; });
        for (const Changed& change : changed_) {
            result_.volume_added += change.growth6 / 6;
            double bound = error_of(part_.points, change.hull);
            if (change.simplified > 0) {
                // Straight to the part, or first to the hull and on from there.
                bound =
                    std::min(bound + change.simplified, error_of(result_.points, change.triangles));
            }
            result_.error = std::max(result_.error, bound);
        }
    }

    double error_of(const std::vector<Vec3d>& points, const std::vector<Triangle>& triangles) {
        return hull_error(points, triangles, distance_, result_.error_found, progress_);
    }
};

}  // namespace

LimitedCells limit_cells(const CellArrays& part, const Limits& limits, Progress& progress) {
    return Limiter(part, limits, progress).run();
}

}  // namespace tetra
