// SPDX-License-Identifier: LGPL-2.1-or-later
// Lays given polyhedra out as the half-edges of a finished run, then merges and checks as ever.
#include "tetra/notch/merge_polyhedra.h"

#include <algorithm>
#include <tuple>

#include "check_cells.h"
#include "collect_cells.h"
#include "merge_cells.h"
#include "place_points.h"
#include "place_vertices.h"
#include "tetra/errors.h"
#include "volume_residue.h"

namespace tetra {
namespace {

using namespace notch;

class Layout {
  public:
    Layout(const Polyhedra& given, Decomposition& out) : given_(given), out_(out) {
        for (std::size_t p = 0; p < given.points.size(); ++p)
            point_.push_back(given.point_source[p] >= 0 ? given.point_source[p]
                                                        : out.points.add_point(given.points[p]));
    }

    void add_cell(std::size_t cell) {
        open_.clear();
        const auto first = static_cast<std::size_t>(given_.cell_offsets[cell]);
        const auto last = static_cast<std::size_t>(given_.cell_offsets[cell + 1]);
        for (std::size_t f = first; f < last; ++f) add_facet(f);
        pair_up();
    }

  private:
    void add_facet(std::size_t f) {
        const int key = out_.points.add_plane(given_.facet_planes[f]);
        int head = -1, before = -1;
        for (std::int64_t i = given_.facet_offsets[f]; i < given_.facet_offsets[f + 1]; ++i) {
            const int p = point_[given_.facet_points[static_cast<std::size_t>(i)]];
            out_.points.set_on(p, plane_of(key));
            const int h = out_.edges.add(p, key, -1);
            if (before < 0)
                head = h;
            else
                out_.edges.link(before, h);
            before = h;
        }
        out_.edges.link(before, head);
        int h = head;
        do {
            const int u = out_.edges[h].org, w = out_.edges[out_.edges[h].next].org;
            open_.emplace_back(std::min(u, w), std::max(u, w), h);
            h = out_.edges[h].next;
        } while (h != head);
    }

    void pair_up() {
        std::sort(open_.begin(), open_.end());
        if (open_.size() % 2 != 0) throw VerificationFailed("merging: a cell is not closed");
        for (std::size_t i = 0; i < open_.size(); i += 2) {
            const auto& [u, w, h] = open_[i];
            const auto& [u2, w2, t] = open_[i + 1];
            HalfEdge &a = out_.edges[h], &b = out_.edges[t];
            if (u != u2 || w != w2 || a.org == b.org)
                throw VerificationFailed("merging: a cell is not closed");
            out_.edges.pair(h, t);
            a.line = b.line = out_.points.plane_line(plane_of(a.key), plane_of(b.key));
        }
        out_.cells.push_back(std::get<2>(open_.front()));
    }

    const Polyhedra& given_;
    Decomposition& out_;
    std::vector<int> point_;
    std::vector<std::tuple<int, int, int>> open_;
};

}  // namespace

GridSolid solid_in_order(const GridSolid& all, int solid) { return canonical_solid(all, solid); }

ConvexCells merge_polyhedra(const GridSolid& solid, const std::vector<Vec3d>& vertices,
                            const Polyhedra& polyhedra, bool merge, Progress& progress) {
    if (solid.grid.bits > 26) throw VerificationFailed("merging needs a grid of at most 26 bits");
    Decomposition run(solid.grid.bits);
    run.classes = assign_planes(solid, 0, {}, run.points);
    place_vertices(solid, run.classes, run.points);
    std::vector<Notch> notches;
    const Piece whole = build_piece(solid, run.classes, run.points, run.edges, notches);
    run.volume = volume_residue(run.points, run.edges, whole.edges);
    Layout layout(polyhedra, run);
    for (std::size_t c = 0; c + 1 < polyhedra.cell_offsets.size(); ++c) {
        progress.poll("merging cells", 0);
        layout.add_cell(c);
    }
    const int raw = static_cast<int>(run.cells.size());
    if (merge) run.cells = merge_cells(run.points, run.edges, run.cells);
    progress.poll("merging cells", 1);
    place_points(solid, vertices, run);
    const std::vector<Fault> faults = find_faults(solid.grid, run);
    if (!faults.empty()) throw VerificationFailed("cells from fences: " + faults.front().reason);
    ConvexCells cells;
    collect_cells(solid, run, cells);
    cells.stats.notches = static_cast<int>(notches.size());
    cells.stats.raw_cells = raw;
    measure_volumes(solid, vertices, cells);
    return cells;
}

}  // namespace tetra
