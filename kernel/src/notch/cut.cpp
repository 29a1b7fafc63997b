// SPDX-License-Identifier: LGPL-2.1-or-later
// The surgery on half-edges after a section is known (NOTCHES 3.6, 3.9, 3.10).
#include "cut.h"

#include <algorithm>

#include "pieces.h"
#include "tetra/errors.h"

namespace tetra::notch {
namespace {

// The half-edges that a used segment becomes. `upper` runs along the segment and bounds what is
// above the plane, `lower` runs back; the caps of both sides mirror them.
struct Cut {
    int upper = -1, lower = -1;          // chord: new edges in the facet
    int cap_below = -1, cap_above = -1;  // along / against the segment; normals +n and -n
};

// A chord that leaves a corner, in the facet it crosses.
struct Opening {
    int corner;  // half-edge leaving the corner; for a contact: -2 - index of contact
    int key;
    int leaving, arriving;
    bool plus;
};

class Surgeon {
  public:
    Surgeon(PointTable& points, HalfEdges& edges, Piece&& piece, const Section& section,
            Workspace& work)
        : points_(points),
          edges_(edges),
          piece_(std::move(piece)),
          section_(section),
          work_(work) {}

    std::vector<Piece> run() {
        cuts_.resize(section_.segments.size());
        split_crossings();
        insert_chords();
        link_corners();
        add_caps();
        pair_plane_edges();
        close_caps_of_no_width();
        clean();
        return split_pieces(points_, edges_, piece_.edges,
                            piece_.simple && section_.simple && !made_holes_, work_);
    }

  private:
    int add(int org, int key, int line, int notch = -1) {
        const int h = edges_.add(org, key, line, notch);
        piece_.edges.push_back(h);
        return h;
    }

    // Every crossing edge with a used chord at it gets its vertex, once for both its sides.
    void split_crossings() {
        for (std::size_t i = 0; i < section_.segments.size(); ++i) {
            if (!section_.used[i] || section_.segments[i].half_edge >= 0) continue;
            for (const ChordEnd* end : {&section_.segments[i].from, &section_.segments[i].to})
                if (end->crossing) crossings_.push_back({end->half_edge, end->point, -1});
        }
        std::sort(crossings_.begin(), crossings_.end(),
                  [](const Crossing& a, const Crossing& b) { return a.half_edge < b.half_edge; });
        for (Crossing& c : crossings_) {
            if (c.out >= 0) continue;
            const int h = c.half_edge, t = edges_[h].twin;
            const int h2 = edges_.split(h, c.point);
            const int t2 = edges_[h].twin;
            piece_.edges.push_back(h2);
            piece_.edges.push_back(t2);
            c.out = h2;
            if (Crossing* other = find_crossing(t)) other->out = t2;
        }
    }

    struct Crossing {
        int half_edge, point, out;
    };

    Crossing* find_crossing(int h) {
        const auto place =
            std::lower_bound(crossings_.begin(), crossings_.end(), h,
                             [](const Crossing& a, int value) { return a.half_edge < value; });
        return place != crossings_.end() && place->half_edge == h ? &*place : nullptr;
    }

    int corner_of(const ChordEnd& end) {
        if (end.half_edge < 0) return -2 - end.point;
        return end.crossing ? find_crossing(end.half_edge)->out : end.half_edge;
    }

    void insert_chords() {
        for (std::size_t i = 0; i < section_.segments.size(); ++i) {
            const Segment& s = section_.segments[i];
            if (!section_.used[i] || s.half_edge >= 0) continue;
            Cut& c = cuts_[i];
            c.upper = add(s.from.point, s.key, s.line);
            c.lower = add(s.to.point, s.key, s.line);
            openings_.push_back({corner_of(s.from), s.key, c.upper, c.lower, true});
            openings_.push_back({corner_of(s.to), s.key, c.lower, c.upper, false});
        }
    }

    void link_corners() {
        std::sort(openings_.begin(), openings_.end(), [](const Opening& a, const Opening& b) {
            if (a.corner != b.corner) return a.corner < b.corner;
            if (a.key != b.key) return a.key < b.key;
            return a.plus > b.plus;
        });
        for (std::size_t i = 0, j; i < openings_.size(); i = j) {
            for (j = i; j < openings_.size() && openings_[j].corner == openings_[i].corner &&
                        openings_[j].key == openings_[i].key;)
                ++j;
            if (openings_[i].corner < 0)
                link_contact(i, j);
            else
                link_corner(i, j);
        }
    }

    // Both sides of a contact in a facet's interior; with one chord only, an antenna.
    void link_contact(std::size_t i, std::size_t j) {
        if (j - i == 1) {
            edges_.link(openings_[i].arriving, openings_[i].leaving);
        } else {
            edges_.link(openings_[i].arriving, openings_[i + 1].leaving);
            edges_.link(openings_[i + 1].arriving, openings_[i].leaving);
        }
    }

    void link_corner(std::size_t i, std::size_t j) {
        const int out = openings_[i].corner, in = edges_[out].prev;
        if (j - i == 1) {
            edges_.link(in, openings_[i].leaving);
            edges_.link(openings_[i].arriving, out);
            return;
        }
        // Counter-clockwise from the out-edge: -d then +d when the corner wraps around from
        // above, +d then -d from below.
        std::size_t first = i, second = i + 1;  // openings_[i] is +d
        if (points_.side(edges_.dest(out), section_.plane) > 0) std::swap(first, second);
        edges_.link(in, openings_[second].leaving);
        edges_.link(openings_[second].arriving, openings_[first].leaving);
        edges_.link(openings_[first].arriving, out);
    }

    void add_caps() {
        const int below = 2 * section_.plane, above = below + 1;
        for (std::size_t i = 0; i < section_.segments.size(); ++i) {
            if (!section_.used[i]) continue;
            const Segment& s = section_.segments[i];
            cuts_[i].cap_below = add(s.from.point, below, s.line);
            cuts_[i].cap_above = add(s.to.point, above, s.line);
        }
        for (std::size_t i = 0; i < section_.segments.size(); ++i) {
            if (!section_.used[i]) continue;
            const Cut &c = cuts_[i], &after = cuts_[section_.segments[i].next];
            edges_.link(c.cap_below, after.cap_below);
            edges_.link(after.cap_above, c.cap_above);
            if (section_.segments[i].half_edge < 0) {
                edges_.pair(c.upper, c.cap_above);
                edges_.pair(c.lower, c.cap_below);
            }
        }
    }

    void pair_plane_edges() {
        for (std::size_t i = 0; i < section_.segments.size(); ++i) {
            const Segment& s = section_.segments[i];
            if (!section_.used[i] || s.half_edge < 0) continue;
            const int h = s.half_edge;
            if (s.mate < 0) {
                const int t = edges_[h].twin;
                edges_[h].notch = edges_[t].notch = -1;
                edges_.pair(h, cuts_[i].cap_above);
                edges_.pair(t, cuts_[i].cap_below);
            } else if (s.mate > static_cast<int>(i)) {
                const int t = section_.segments[s.mate].half_edge;
                edges_[h].notch = edges_[t].notch = -1;
                const Cut &left = cuts_[i], &right = cuts_[s.mate];
                if (s.facets_above) {
                    edges_.pair(h, left.cap_above);
                    edges_.pair(left.cap_below, right.cap_below);
                    edges_.pair(right.cap_above, t);
                } else {
                    edges_.pair(h, right.cap_below);
                    edges_.pair(right.cap_above, left.cap_above);
                    edges_.pair(left.cap_below, t);
                }
            }
        }
    }

    // Caps of no width vanish, and the facets beside them come together in the pairs that
    // enclose solid.
    void close_caps_of_no_width() {
        for (std::size_t i = 0; i < section_.segments.size(); ++i) {
            if (!section_.used[i] || !section_.segments[i].no_width) continue;
            if (edges_.alive(cuts_[i].cap_below)) close_cap(cuts_[i].cap_below);
            if (edges_.alive(cuts_[i].cap_above)) close_cap(cuts_[i].cap_above);
        }
    }

    // Folds a cap that runs to and fro on a line: every edge meets the one that runs back.
    void close_cap(int first) {
        std::vector<int> open;
        int h = first;
        do {
            const int next = edges_[h].next;
            if (!open.empty() && edges_[open.back()].org == edges_[next].org) {
                const int a = edges_[open.back()].twin, b = edges_[h].twin;
                edges_.pair(a, b);
                folded_.push_back(a);
                used_up_.push_back(open.back());
                used_up_.push_back(h);
                open.pop_back();
            } else {
                open.push_back(h);
            }
            h = next;
        } while (h != first);
        if (!open.empty()) throw VerificationFailed("notch cutting: a cap does not fold");
        for (const int u : used_up_) edges_.remove(u);
        used_up_.clear();
    }

    // Dissolves edges between facets of one key, then straightens what that leaves behind.
    void clean() {
        std::vector<int> touched;
        for (std::size_t i = 0; i < cuts_.size(); ++i) {
            if (!section_.used[i]) continue;
            for (const int h : {cuts_[i].cap_below, cuts_[i].cap_above}) {
                if (!edges_.alive(h)) continue;
                touched.push_back(h);
                touched.push_back(edges_[h].twin);
            }
        }
        for (const int h : folded_) {
            touched.push_back(h);
            touched.push_back(edges_[h].twin);
        }
        const std::size_t caps = touched.size();
        for (std::size_t i = 0; i < caps; ++i) {
            const int h = touched[i];
            if (!edges_.alive(h) || edges_[h].key != edges_[edges_[h].twin].key) continue;
            made_holes_ = made_holes_ || leaves_a_hole(h);
            edges_.dissolve(h, touched);
        }
        for (std::size_t i = 0; i < touched.size(); ++i)
            if (edges_.alive(touched[i])) edges_.straighten(touched[i]);
        std::erase_if(piece_.edges, [&](int h) { return !edges_.alive(h); });
    }

    // Dissolving an edge with one cycle on both sides parts it in two, one in the other, unless it
    // is an antenna: where a cap meets a facet of its plane twice.
    bool leaves_a_hole(int h) const {
        const int t = edges_[h].twin;
        if (edges_[h].next == t || edges_[t].next == h) return false;
        for (int i = edges_[h].next; i != h; i = edges_[i].next)
            if (i == t) return true;
        return false;
    }

    PointTable& points_;
    HalfEdges& edges_;
    Piece piece_;
    const Section& section_;
    Workspace& work_;
    std::vector<Cut> cuts_;
    std::vector<Crossing> crossings_;
    std::vector<Opening> openings_;
    bool made_holes_ = false;
    std::vector<int> folded_, used_up_;  // half-edges paired across vanished caps; those caps
};

}  // namespace

std::vector<Piece> cut_piece(PointTable& points, HalfEdges& edges, Piece&& piece,
                             const Section& section, Workspace& work) {
    return Surgeon(points, edges, std::move(piece), section, work).run();
}

}  // namespace tetra::notch
