// SPDX-License-Identifier: LGPL-2.1-or-later
// Plane sweep over trapezoids, each of which feeds one monotone piece or, behind a merge, two.
//
// Between two boundary edges the sweep line cuts the region into trapezoids. The diagonals of the
// monotone partition are never stored: a trapezoid knows the monotone piece under construction in
// it, and a diagonal is where pieces begin, part or end. A piece takes its vertices from left to
// right, each tagged with its chain, and keeps the usual stack of a concave chain.
//
// No flat triangle can arise on valid input, although straight angles stay on the stack: a vertex
// of the other chain lies strictly above the first edge of the stack (it is joined to the bottom
// by an edge that the rest of the stack lies strictly below), and the further edges of a concave
// chain only turn away from it. Every emitted triangle is tested nevertheless: that is what finds
// edges that cross.

#include "tetra/polygon/triangulate.h"

#include <algorithm>
#include <string>
#include <utility>

#include "ordered_list.h"
#include "sweep_graph.h"

namespace tetra {

namespace {

constexpr int none = -1;

/// Monotone pieces under construction, and the triangles cut off them.
class MonotonePieces {
  public:
    MonotonePieces(const SweepGraph& graph, const PointOracle& oracle)
        : graph_(graph), oracle_(oracle) {}

    int begin(int point) {
        pieces_.push_back({push(point, none), true});
        return static_cast<int>(pieces_.size()) - 1;
    }

    int last_point(int piece) const { return links_[pieces_[piece].top].point; }

    /// Whether the last point can be taken as one of the lower chain.
    bool last_is_lower(int piece) const {
        return pieces_[piece].lower || links_[pieces_[piece].top].below == none;
    }

    void feed(int piece, int point, bool lower) {
        Piece& p = pieces_[piece];
        if (links_[p.top].below == none) {
            p.lower = lower;
        } else if (p.lower == lower) {
            cut_ears(p, point);
        } else {
            cut_fan(p, point);
            links_[p.top].below = none;
            p.lower = lower;
        }
        p.top = push(point, p.top);
    }

    void finish(int piece, int point) { cut_fan(pieces_[piece], point); }

    std::vector<PlanarTriangle> take_triangles() { return std::move(triangles_); }

  private:
    /// All points of the stack but the bottom one are on the same chain.
    struct Piece {
        int top = none;
        bool lower = true;
    };
    struct Link {
        int point = 0;
        int below = none;
    };

    int push(int point, int below) {
        links_.push_back({point, below});
        return static_cast<int>(links_.size()) - 1;
    }

    PlanarTriangle triangle(const Piece& piece, int low, int high, int point) const {
        const PointId a = graph_.ids[links_[low].point];
        const PointId b = graph_.ids[links_[high].point];
        return piece.lower ? PlanarTriangle{a, b, graph_.ids[point]}
                           : PlanarTriangle{b, a, graph_.ids[point]};
    }

    void cut_ears(Piece& piece, int point) {
        for (int below = links_[piece.top].below; below != none; below = links_[piece.top].below) {
            const PlanarTriangle ear = triangle(piece, below, piece.top, point);
            if (oracle_.orient(ear[0], ear[1], ear[2]) <= 0) {
                return;
            }
            triangles_.push_back(ear);
            piece.top = below;
        }
    }

    void cut_fan(const Piece& piece, int point) {
        int high = piece.top;
        for (int low = links_[high].below; low != none; low = links_[low].below) {
            const PlanarTriangle cut = triangle(piece, low, high, point);
            if (oracle_.orient(cut[0], cut[1], cut[2]) <= 0) {
                throw InvalidRegion("boundary edges cross near points " + std::to_string(cut[0]) +
                                        ", " + std::to_string(cut[1]) + " and " +
                                        std::to_string(cut[2]),
                                    {}, {cut[0], cut[1], cut[2]});
            }
            triangles_.push_back(cut);
            high = low;
        }
    }

    const SweepGraph& graph_;
    const PointOracle& oracle_;
    std::vector<Piece> pieces_;
    std::vector<Link> links_;
    std::vector<PlanarTriangle> triangles_;
};

/// The sweep itself. At each point the sectors of the region around it are dealt with one by one,
/// so that a point where the region touches itself needs no copies.
class Sweep {
  public:
    Sweep(const SweepGraph& graph, const PointOracle& oracle)
        : graph_(graph),
          oracle_(oracle),
          pieces_(graph, oracle),
          trapezoid_at_(graph.edges.size(), none) {}

    std::vector<PlanarTriangle> run() {
        for (int rank = 0; rank < static_cast<int>(graph_.ids.size()); ++rank) {
            visit(rank);
        }
        return pieces_.take_triangles();
    }

  private:
    /// The two pieces differ behind a merge, and then both end with the merge point.
    struct Trapezoid {
        int floor = none;
        int ceiling = none;
        int lower_piece = none;
        int upper_piece = none;
    };

    bool is_floor(int edge) const { return graph_.edges[edge].floor; }

    void visit(int rank) {
        const std::span<const int> ending = graph_.ending_at(rank);
        const std::span<const int> starting = graph_.starting_at(rank);
        check_balance(rank, ending, starting);
        int place = place_of(rank, ending, starting);
        if (ending.empty() && starting.empty()) {
            divide(trapezoids_[place], rank);
            return;
        }
        close_sectors(rank, ending);
        if (starting.empty()) {
            if (!is_floor(ending.front())) {
                merge(trapezoid_at_[ending.front()], trapezoid_at_[ending.back()], rank);
            }
            return;
        }
        if (ending.empty()) {
            if (!is_floor(starting.front())) {
                split(place, rank, starting.front(), starting.back());
            }
        } else {
            pass(rank, ending, starting);
        }
        open_sectors(rank, starting, place);
    }

    /// Floors and ceilings alternate around a point, which also makes in- and out-degree equal.
    void check_balance(int rank, std::span<const int> ending, std::span<const int> starting) const {
        bool good = alternate(ending) && alternate(starting);
        if (good && !ending.empty() && !starting.empty()) {
            good = is_floor(ending.front()) == is_floor(starting.front()) &&
                   is_floor(ending.back()) == is_floor(starting.back());
        } else if (good) {
            good = (ending.size() + starting.size()) % 2 == 0;
        }
        if (!good) {
            std::vector<int> edges(ending.begin(), ending.end());
            edges.insert(edges.end(), starting.begin(), starting.end());
            fail("the edges at point " + std::to_string(graph_.ids[rank]) +
                     " do not enclose a region on their left",
                 edges, rank);
        }
    }

    bool alternate(std::span<const int> edges) const {
        for (std::size_t k = 1; k < edges.size(); ++k) {
            if (is_floor(edges[k - 1]) == is_floor(edges[k])) {
                return false;
            }
        }
        return true;
    }

    /// The trapezoid behind which new ones are put; the one around the point when there is one.
    int place_of(int rank, std::span<const int> ending, std::span<const int> starting) {
        if (!ending.empty()) {
            const int lowest = trapezoid_at_[ending.front()];
            return is_floor(ending.front()) ? order_.previous(lowest) : lowest;
        }
        const int below = order_.last_where(
            [&](int trapezoid) { return side_of(trapezoids_[trapezoid].floor, rank) > 0; });
        const bool inside = below != none && side_of(trapezoids_[below].ceiling, rank) < 0;
        const bool inside_wanted = starting.empty() || !is_floor(starting.front());
        if (inside != inside_wanted) {
            const std::string point = "point " + std::to_string(graph_.ids[rank]);
            fail(inside ? point + " starts a boundary inside the region"
                        : point + " should lie inside the region but does not",
                 {starting.begin(), starting.end()}, rank);
        }
        return below;
    }

    /// Side of an edge that does not end here; a point must not lie on it.
    int side_of(int edge, int rank) const {
        const SweepEdge& e = graph_.edges[edge];
        const int side = oracle_.orient(graph_.ids[e.left], graph_.ids[e.right], graph_.ids[rank]);
        if (side == 0) {
            fail("point " + std::to_string(graph_.ids[rank]) + " lies on edge " +
                     std::to_string(edge) + "; split the edge there",
                 {edge}, rank);
        }
        return side;
    }

    /// Sectors that lie between two ending edges.
    void close_sectors(int rank, std::span<const int> ending) {
        const std::size_t first = !ending.empty() && !is_floor(ending.front()) ? 1 : 0;
        for (std::size_t k = first; k + 1 < ending.size(); k += 2) {
            const int at = trapezoid_at_[ending[k]];
            if (trapezoids_[at].ceiling != ending[k + 1]) {
                fail_crossing(ending[k + 1], trapezoids_[at].ceiling, rank);
            }
            const Trapezoid& t = trapezoids_[at];
            pieces_.finish(t.lower_piece, rank);
            if (t.upper_piece != t.lower_piece) {
                pieces_.finish(t.upper_piece, rank);
            }
            order_.erase(at);
        }
    }

    /// Sectors below and above a point with edges on both sides.
    void pass(int rank, std::span<const int> ending, std::span<const int> starting) {
        if (!is_floor(ending.front())) {
            const int at = trapezoid_at_[ending.front()];
            touch_ceiling(trapezoids_[at], rank);
            trapezoids_[at].ceiling = starting.front();
            trapezoid_at_[starting.front()] = at;
        }
        if (is_floor(ending.back())) {
            const int at = trapezoid_at_[ending.back()];
            touch_floor(trapezoids_[at], rank);
            trapezoids_[at].floor = starting.back();
            trapezoid_at_[starting.back()] = at;
        }
    }

    /// Sectors between two starting edges.
    void open_sectors(int rank, std::span<const int> starting, int place) {
        const std::size_t first = is_floor(starting.front()) ? 0 : 1;
        for (std::size_t k = first; k + 1 < starting.size(); k += 2) {
            const int piece = pieces_.begin(rank);
            place = add_trapezoid({starting[k], starting[k + 1], piece, piece}, place);
        }
    }

    void touch_ceiling(Trapezoid& t, int rank) {
        if (t.upper_piece != t.lower_piece) {
            pieces_.finish(t.upper_piece, rank);
            t.upper_piece = t.lower_piece;
        }
        pieces_.feed(t.lower_piece, rank, false);
    }

    void touch_floor(Trapezoid& t, int rank) {
        if (t.upper_piece != t.lower_piece) {
            pieces_.finish(t.lower_piece, rank);
            t.lower_piece = t.upper_piece;
        }
        pieces_.feed(t.upper_piece, rank, true);
    }

    /// Joins a point inside a trapezoid to the last one before; leaves two pieces ending in it.
    void divide(Trapezoid& t, int rank) {
        if (t.upper_piece == t.lower_piece) {
            const int fresh = pieces_.begin(pieces_.last_point(t.lower_piece));
            if (pieces_.last_is_lower(t.upper_piece)) {
                t.lower_piece = fresh;
            } else {
                t.upper_piece = fresh;
            }
        }
        pieces_.feed(t.lower_piece, rank, false);
        pieces_.feed(t.upper_piece, rank, true);
    }

    void split(int at, int rank, int ceiling, int floor) {
        divide(trapezoids_[at], rank);
        const Trapezoid whole = trapezoids_[at];
        trapezoids_[at] = {whole.floor, ceiling, whole.lower_piece, whole.lower_piece};
        trapezoid_at_[ceiling] = at;
        add_trapezoid({floor, whole.ceiling, whole.upper_piece, whole.upper_piece}, at);
    }

    void merge(int lower, int upper, int rank) {
        if (order_.next(lower) != upper) {
            fail_crossing(trapezoids_[lower].ceiling, trapezoids_[upper].floor, rank);
        }
        touch_ceiling(trapezoids_[lower], rank);
        touch_floor(trapezoids_[upper], rank);
        trapezoids_[lower].ceiling = trapezoids_[upper].ceiling;
        trapezoids_[lower].upper_piece = trapezoids_[upper].upper_piece;
        trapezoid_at_[trapezoids_[lower].ceiling] = lower;
        order_.erase(upper);
    }

    int add_trapezoid(const Trapezoid& t, int place) {
        const int at = static_cast<int>(trapezoids_.size());
        trapezoids_.push_back(t);
        trapezoid_at_[t.floor] = at;
        trapezoid_at_[t.ceiling] = at;
        order_.insert_after(place, at);
        return at;
    }

    [[noreturn]] void fail_crossing(int a, int b, int rank) const {
        fail("edges " + std::to_string(a) + " and " + std::to_string(b) + " cross", {a, b}, rank);
    }

    [[noreturn]] void fail(const std::string& what, std::vector<int> edges, int rank) const {
        std::sort(edges.begin(), edges.end());
        throw InvalidRegion(what, std::move(edges), {graph_.ids[rank]});
    }

    const SweepGraph& graph_;
    const PointOracle& oracle_;
    MonotonePieces pieces_;
    std::vector<Trapezoid> trapezoids_;
    std::vector<int> trapezoid_at_;  ///< per edge
    OrderedList order_;              ///< of trapezoids, from the lowest to the highest
};

}  // namespace

std::vector<PlanarTriangle> triangulate_region(std::span<const DirectedEdge> boundary,
                                               const PointOracle& oracle,
                                               std::span<const PointId> inner_points) {
    const SweepGraph graph = make_sweep_graph(boundary, inner_points, oracle, Slits::allowed);
    return Sweep(graph, oracle).run();
}

}  // namespace tetra
