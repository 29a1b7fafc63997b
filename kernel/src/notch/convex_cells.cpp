// SPDX-License-Identifier: LGPL-2.1-or-later
// Runs notch cutting per solid, takes back plane classes that contradict themselves, and collects.
#include "tetra/notch/convex_cells.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>

#include "check_cells.h"
#include "evaluate.h"
#include "tetra/errors.h"

namespace tetra {
namespace {

using namespace notch;

// One solid with points and triangles in an order that does not depend on the caller's.
GridSolid canonical(const GridSolid& all, int solid) {
    GridSolid one;
    one.grid = all.grid;
    std::vector<int> used;
    for (std::size_t t = 0; t < all.triangles.size(); ++t)
        if (all.solid[t] == solid)
            used.insert(used.end(), all.triangles[t].begin(), all.triangles[t].end());
    std::sort(used.begin(), used.end(),
              [&](int a, int b) { return all.points[a] < all.points[b]; });
    used.erase(std::unique(used.begin(), used.end()), used.end());
    std::vector<int> rank(all.points.size(), -1);
    for (const int v : used) {
        rank[v] = static_cast<int>(one.points.size());
        one.points.push_back(all.points[v]);
        one.point_source.push_back(all.point_source[v]);
    }
    std::vector<std::pair<Triangle, int>> triangles;
    for (std::size_t t = 0; t < all.triangles.size(); ++t) {
        if (all.solid[t] != solid) continue;
        Triangle tri = all.triangles[t];
        for (int& v : tri) v = rank[v];
        std::rotate(tri.begin(), std::min_element(tri.begin(), tri.end()), tri.end());
        triangles.push_back({tri, all.triangle_source[t]});
    }
    std::sort(triangles.begin(), triangles.end());
    for (const auto& [tri, source] : triangles) {
        one.triangles.push_back(tri);
        one.triangle_source.push_back(source);
        one.solid.push_back(solid);
    }
    return one;
}

struct Attempt {
    Decomposition result;
    double delta = 0;
    int restarts = 0, demoted = 0;
};

constexpr int kMaxRestarts = 24;

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
        collect(solid, *best);
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
                Fault fault = find_fault(a.result);
                if (fault.reason.empty()) return a;
                at_fault.push_back(std::move(fault.planes));
            }
            ++a.restarts;
            if (!demote(a.result.classes, at_fault, demoted, a.demoted)) break;
        }
        a.delta = 0;
        a.result = decompose(solid, options_, 0, {}, seed, progress_);
        if (!a.result.contradictions.empty())
            throw VerificationFailed("notch cutting: a section does not close");
        const Fault fault = find_fault(a.result);
        if (!fault.reason.empty()) throw VerificationFailed("notch cutting: " + fault.reason);
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

    void collect(const GridSolid& solid, Attempt& a) {
        Decomposition& r = a.result;
        const CallerPlanes planes =
            fit_caller_planes(solid, vertices_, r.classes.key, r.points.planes());
        std::vector<int> source_of_key(static_cast<std::size_t>(2 * r.points.planes()), -1);
        for (std::size_t t = 0; t < solid.triangles.size(); ++t) {
            int& s = source_of_key[r.classes.key[t]];
            if (s < 0) s = solid.triangle_source[t];
        }
        number_.assign(static_cast<std::size_t>(r.points.points()), -1);
        std::vector<char> seen(static_cast<std::size_t>(r.edges.size()), 0);
        for (const int seed : r.cells) {
            std::vector<int> order{seed};
            seen[seed] = 1;
            for (std::size_t i = 0; i < order.size(); ++i)
                for (const int n : {r.edges[order[i]].next, r.edges[order[i]].twin})
                    if (!seen[n]) {
                        seen[n] = 1;
                        order.push_back(n);
                    }
            for (const int h : order) {
                if (seen[h] == 2) continue;
                for (int i = h; seen[i] != 2; i = r.edges[i].next) {
                    seen[i] = 2;
                    out_.facet_vertices.push_back(point_number(solid, r, planes, r.edges[i].org));
                }
                out_.facet_offsets.push_back(static_cast<std::int64_t>(out_.facet_vertices.size()));
                out_.facet_source.push_back(source_of_key[r.edges[h].key]);
            }
            out_.cell_offsets.push_back(static_cast<std::int64_t>(out_.facet_source.size()));
            out_.cell_solid.push_back(solid.solid.front());
        }
        add_stats(a);
    }

    int point_number(const GridSolid& solid, const Decomposition& r, const CallerPlanes& planes,
                     int point) {
        int& n = number_[point];
        if (n < 0) {
            n = static_cast<int>(out_.points.size());
            out_.points.push_back(evaluate_point(r.points, point, solid, vertices_, planes));
            out_.point_source.push_back(point < r.points.inputs() ? solid.point_source[point] : -1);
            out_.exact.push_back(r.points.exact(point));
        }
        return n;
    }

    void add_stats(const Attempt& a) {
        CellsStats& s = out_.stats;
        s.notches += a.result.notches;
        s.planes += a.result.planes;
        s.cuts += a.result.cuts;
        s.splices += a.result.splices;
        s.raw_cells += a.result.raw_cells;
        s.restarts += a.restarts;
        s.demoted += a.demoted;
        s.flatness = std::max(s.flatness, a.result.uses_classes() ? a.delta : 0);
        s.exact = s.exact && a.result.exact;
    }

    const std::vector<Vec3d>& vertices_;
    const CellsOptions& options_;
    Progress& progress_;
    ConvexCells out_;
    std::vector<int> number_;
};

// About the origin of the grid, so that parts far from the caller's origin lose no digits.
double tetra_volume(const Vec3d& o, const Vec3d& a, const Vec3d& b, const Vec3d& c) {
    const auto d = [&](const Vec3d& p, int k) { return p[k] - o[k]; };
    double sum = 0;
    for (int k = 0; k < 3; ++k) {
        const int u = (k + 1) % 3, v = (k + 2) % 3;
        sum += d(a, k) * (d(b, u) * d(c, v) - d(b, v) * d(c, u));
    }
    return sum / 6;
}

void measure_volumes(const GridSolid& solid, const std::vector<Vec3d>& vertices,
                     ConvexCells& cells) {
    const Vec3d& o = solid.grid.origin;
    for (const Triangle& t : solid.triangles)
        cells.stats.solid_volume +=
            tetra_volume(o, vertices[solid.point_source[t[0]]], vertices[solid.point_source[t[1]]],
                         vertices[solid.point_source[t[2]]]);
    for (std::size_t f = 0; f + 1 < cells.facet_offsets.size(); ++f) {
        const auto first = static_cast<std::size_t>(cells.facet_offsets[f]);
        const auto last = static_cast<std::size_t>(cells.facet_offsets[f + 1]);
        const auto point = [&](std::size_t i) -> const Vec3d& {
            return cells.points[static_cast<std::size_t>(cells.facet_vertices[i])];
        };
        for (std::size_t i = first + 1; i + 1 < last; ++i)
            cells.stats.volume += tetra_volume(o, point(first), point(i), point(i + 1));
    }
}

}  // namespace

ConvexCells convex_cells(const GridSolid& solid, const std::vector<Vec3d>& vertices,
                         const CellsOptions& options, Progress& progress) {
    if (solid.grid.bits > 26)
        throw VerificationFailed("notch cutting needs a grid of at most 26 bits");
    std::vector<int> ids = solid.solid;
    std::sort(ids.begin(), ids.end());
    ids.erase(std::unique(ids.begin(), ids.end()), ids.end());
    Cutter cutter(vertices, options, progress);
    for (const int id : ids) cutter.add_solid(canonical(solid, id));
    ConvexCells cells = cutter.take();
    measure_volumes(solid, vertices, cells);
    const double error = std::fabs(cells.stats.volume - cells.stats.solid_volume);
    if (error > 1e-6 * std::fabs(cells.stats.solid_volume))
        throw VerificationFailed("the cells' volumes do not add up to the solid's");
    return cells;
}

}  // namespace tetra
