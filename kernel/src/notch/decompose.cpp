// SPDX-License-Identifier: LGPL-2.1-or-later
// The cutting loop.
#include "decompose.h"

#include <algorithm>
#include <set>

#include "cut.h"
#include "merge_cells.h"
#include "place_vertices.h"
#include "volume_residue.h"

namespace tetra::notch {
namespace {

Rule rule_of(NotchRule rule) {
    return rule == NotchRule::plain ? Rule::plain
                                    : (rule == NotchRule::random ? Rule::random : Rule::cover);
}

constexpr std::size_t kPlanesTried = 32;

class Run {
  public:
    Run(const GridSolid& solid, const CellsOptions& options, double delta, Decomposition& out,
        Progress& progress)
        : solid_(solid), options_(options), out_(out), state_(options.seed), progress_(progress) {
        work_.reach = delta > 0 ? 2 * delta : 1e-3;
    }

    void cut_all(std::uint64_t seed) {
        Piece whole = build_piece(solid_, out_.classes, out_.points, out_.edges, notches_);
        out_.exact = lies_on_planes(whole);
        out_.volume = volume_residue(out_.points, out_.edges, whole.edges);
        assign_notches(notches_, rule_of(options_.rule), seed);
        out_.notches = static_cast<int>(notches_.size());
        std::set<int> planes;
        for (const Notch& n : notches_) planes.insert(n.assigned);
        out_.planes = static_cast<int>(planes.size());
        total_ = notches_.size() + 1;
        std::vector<Piece> open;
        open.push_back(std::move(whole));
        while (!open.empty()) {
            Piece piece = std::move(open.back());
            open.pop_back();
            step(std::move(piece), open);
            progress_.poll("cutting notches", 1 - 1.0 / (1 + out_.cuts / double(total_)));
        }
    }

  private:
    // Whether arithmetic agrees with incidence at every vertex.
    bool lies_on_planes(const Piece& piece) const {
        return std::all_of(piece.edges.begin(), piece.edges.end(), [&](int h) {
            const HalfEdge& e = out_.edges[h];
            return out_.points.is_exactly_on(e.org, plane_of(e.key));
        });
    }

    void step(Piece&& piece, std::vector<Piece>& open) {
        std::vector<int> excluded, at_fault;
        for (;;) {
            const Choice choice = choose_plane(out_.points, out_.edges, piece, notches_,
                                               rule_of(options_.rule), excluded, state_, work_);
            if (choice.plane < 0) break;
            try {
                const Section section = trace(piece, choice);
                cut(std::move(piece), section, open);
                return;
            } catch (const Inconsistent& e) {
                // Another plane may split the trouble.
                excluded.push_back(choice.plane);
                if (at_fault.empty()) at_fault = e.planes;
                if (excluded.size() >= kPlanesTried) break;
            }
        }
        if (excluded.empty())
            close(piece);
        else if (!cut_with_other_plane(piece, excluded, open))
            out_.contradictions.push_back(std::move(at_fault));
    }

    // The facet planes that the cover left out may work where the assigned ones contradict
    // themselves: any plane through a notch resolves it.
    bool cut_with_other_plane(Piece& piece, const std::vector<int>& excluded,
                              std::vector<Piece>& open) {
        std::set<int> others;
        for (const int h : piece.edges)
            if (const int n = out_.edges[h].notch; n >= 0) {
                others.insert(plane_of(out_.edges[h].key));
                others.insert(notches_[n].plane_a);
                others.insert(notches_[n].plane_b);
            }
        std::size_t tried = 0;
        for (const int plane : others) {
            if (std::find(excluded.begin(), excluded.end(), plane) != excluded.end()) continue;
            if (++tried > kPlanesTried) return false;
            try {
                const Section section = trace(piece, {plane, false});
                cut(std::move(piece), section, open);
                return true;
            } catch (const Inconsistent&) {
                continue;
            }
        }
        return false;
    }

    void cut(Piece&& piece, const Section& section, std::vector<Piece>& open) {
        std::vector<Piece> parts =
            cut_piece(out_.points, out_.edges, std::move(piece), section, work_);
        ++out_.cuts;
        out_.splices += parts.size() == 1;
        for (Piece& p : parts) open.push_back(std::move(p));
    }

    Section trace(Piece& piece, Choice choice) {
        Extent extent = Extent::notch_components;
        if (choice.whole || options_.extent == CutExtent::whole_plane ||
            (options_.extent == CutExtent::random && (next_random(state_) & 1)))
            extent = Extent::whole_plane;
        else if (options_.rule == NotchRule::plain)
            extent = Extent::own_notches;
        std::vector<char> own;
        if (extent == Extent::own_notches) own = lowest_notch(piece);
        return trace_section(out_.points, out_.edges, piece, choice.plane, extent, own, work_);
    }

    std::vector<char> lowest_notch(const Piece& piece) const {
        int lowest = -1;
        for (const int h : piece.edges) {
            const int n = out_.edges[h].notch;
            if (n >= 0 && (lowest < 0 || n < lowest)) lowest = n;
        }
        std::vector<char> own(notches_.size(), 0);
        own[static_cast<std::size_t>(lowest)] = 1;
        return own;
    }

    // A piece without notches: each of its surfaces is a convex cell.
    void close(const Piece& piece) {
        for (const int h : piece.edges)
            if (out_.edges.alive(h)) out_.edges.straighten(h);
        seen_.resize(static_cast<std::size_t>(out_.edges.size()), 0);
        std::vector<int> stack;
        for (const int seed : piece.edges) {
            if (!out_.edges.alive(seed) || seen_[seed]) continue;
            out_.cells.push_back(seed);
            seen_[seed] = 1;
            stack.push_back(seed);
            while (!stack.empty()) {
                const int h = stack.back();
                stack.pop_back();
                for (const int n : {out_.edges[h].next, out_.edges[h].twin})
                    if (!seen_[n]) {
                        seen_[n] = 1;
                        stack.push_back(n);
                    }
            }
        }
        for (const int h : piece.edges) seen_[h] = 0;
    }

    const GridSolid& solid_;
    const CellsOptions& options_;
    Decomposition& out_;
    std::uint64_t state_;
    Progress& progress_;
    std::vector<Notch> notches_;
    std::vector<char> seen_;
    Workspace work_;
    std::size_t total_ = 1;
};

}  // namespace

Decomposition decompose(const GridSolid& solid, const CellsOptions& options, double delta,
                        const std::vector<char>& demoted, std::uint64_t seed, Progress& progress) {
    Decomposition out(solid.grid.bits);
    out.classes = assign_planes(solid, delta, demoted, out.points);
    place_vertices(solid, out.classes, out.points);
    Run(solid, options, delta, out, progress).cut_all(seed);
    out.raw_cells = static_cast<int>(out.cells.size());
    if (options.merge && out.contradictions.empty())
        out.cells = merge_cells(out.points, out.edges, out.cells);
    return out;
}

}  // namespace tetra::notch
