// SPDX-License-Identifier: LGPL-2.1-or-later
// One run with exact planes, read off its half-edges.
#include "tetra/notch/exact_cells.h"

#include "check_cells.h"
#include "tetra/errors.h"

namespace tetra {
namespace {

using namespace notch;

class Reader {
  public:
    explicit Reader(const Decomposition& run)
        : run_(run),
          number_(static_cast<std::size_t>(run.points.points()), -1),
          seen_(static_cast<std::size_t>(run.edges.size()), 0) {}

    Polyhedra read() {
        for (const int seed : run_.cells) read_cell(seed);
        return std::move(out_);
    }

  private:
    void read_cell(int seed) {
        std::vector<int> order{seed};
        seen_[seed] = 1;
        for (std::size_t i = 0; i < order.size(); ++i)
            for (const int n : {run_.edges[order[i]].next, run_.edges[order[i]].twin})
                if (!seen_[n]) {
                    seen_[n] = 1;
                    order.push_back(n);
                }
        for (const int h : order)
            if (seen_[h] != 2) read_facet(h);
        out_.cell_offsets.push_back(static_cast<std::int64_t>(out_.facet_planes.size()));
    }

    void read_facet(int h) {
        for (int i = h; seen_[i] != 2; i = run_.edges[i].next) {
            seen_[i] = 2;
            out_.facet_points.push_back(number_of(run_.edges[i].org));
        }
        out_.facet_offsets.push_back(static_cast<std::int64_t>(out_.facet_points.size()));
        const int key = run_.edges[h].key;
        const Plane& plane = run_.points.plane(plane_of(key));
        out_.facet_planes.push_back(key_sign(key) > 0 ? plane : opposite(plane));
    }

    int number_of(int point) {
        int& n = number_[point];
        if (n < 0) {
            n = static_cast<int>(out_.points.size());
            out_.points.push_back(run_.points.exact(point));
            out_.point_source.push_back(point < run_.points.inputs() ? point : -1);
        }
        return n;
    }

    const Decomposition& run_;
    std::vector<int> number_;
    std::vector<char> seen_;
    Polyhedra out_;
};

}  // namespace

Polyhedra exact_cells(const GridSolid& solid, const CellsOptions& options, CellsStats& stats,
                      Progress& progress) {
    if (solid.grid.bits > 26)
        throw VerificationFailed("notch cutting needs a grid of at most 26 bits");
    Decomposition run = decompose(solid, options, 0, {}, options.seed, progress);
    if (!run.contradictions.empty())
        throw VerificationFailed("notch cutting: a section does not close");
    const std::vector<Fault> faults = find_faults(solid.grid, run);
    if (!faults.empty()) throw VerificationFailed("notch cutting: " + faults.front().reason);
    stats.notches = run.notches;
    stats.planes = run.planes;
    stats.cuts = run.cuts;
    stats.splices = run.splices;
    stats.raw_cells = run.raw_cells;
    return Reader(run).read();
}

}  // namespace tetra
