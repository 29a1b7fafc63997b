// SPDX-License-Identifier: LGPL-2.1-or-later
// Nesting of the cycles of a section by exact signs at the lexicographically least vertex.
#include "section_components.h"

#include <algorithm>
#include <numeric>

namespace tetra::notch {
namespace {

class Selector {
  public:
    Selector(PointTable& points, const HalfEdges& edges, const Frame& frame, Section& section)
        : points_(points), edges_(edges), frame_(frame), section_(section) {}

    void run(Extent extent, const std::vector<char>& own) {
        find_cycles();
        find_cycles_of_no_width();
        parent_.resize(first_.size());
        std::iota(parent_.begin(), parent_.end(), 0);
        section_.simple &= std::none_of(section_.segments.begin(), section_.segments.end(),
                                        [](const Segment& s) { return s.no_width || s.mate >= 0; });
        if (first_.size() > 1) {
            find_holes();
            section_.simple &= holes_.empty();
            if (extent != Extent::whole_plane) {
                for (const Segment& s : section_.segments)
                    if (s.mate >= 0) unite(s.cycle, section_.segments[s.mate].cycle);
                attach_holes();
            }
        }
        mark_used(extent, own);
    }

  private:
    int find(int c) {
        while (parent_[c] != c) c = parent_[c] = parent_[parent_[c]];
        return c;
    }
    void unite(int a, int b) {
        a = find(a);
        b = find(b);
        if (a != b) parent_[std::max(a, b)] = std::min(a, b);
    }

    void find_cycles() {
        for (int i = 0; i < static_cast<int>(section_.segments.size()); ++i) {
            if (section_.segments[i].cycle >= 0) continue;
            const int c = static_cast<int>(first_.size());
            first_.push_back(i);
            for (int s = i; section_.segments[s].cycle < 0; s = section_.segments[s].next)
                section_.segments[s].cycle = c;
        }
    }

    // Where an edge touches a facet from inside, Q has a part that runs to and fro on one line.
    // An across edge alone does so too, but there Q lies around it.
    void find_cycles_of_no_width() {
        for (const int first : first_) {
            bool straight = true, alone = false;
            int s = first;
            do {
                const Segment& g = section_.segments[s];
                alone |= g.mate < 0;
                s = g.next;
                straight &= turn_on_plane(frame_, g.direction, section_.segments[s].direction) == 0;
            } while (s != first && straight);
            if (!straight || !alone) continue;
            do {
                section_.segments[s].no_width = true;
                s = section_.segments[s].next;
            } while (s != first);
        }
    }

    int compare(int a, int b) const {
        const int u = (frame_.axis + 1) % 3, v = (frame_.axis + 2) % 3;
        const int x = points_.compare(a, b, u);
        return x != 0 ? x : points_.compare(a, b, v);
    }

    // The least vertex of a cycle and whether the cycle has Q outside (is a hole).
    bool is_hole(int cycle, int& least) const {
        least = section_.segments[first_[cycle]].from.point;
        int s = first_[cycle];
        do {
            const int p = section_.segments[s].from.point;
            if (compare(p, least) < 0) least = p;
            s = section_.segments[s].next;
        } while (s != first_[cycle]);
        if (section_.segments[s].no_width) return false;
        bool hole = false;
        do {
            const Segment& arriving = section_.segments[s];
            if (arriving.to.point == least) {
                const Segment& leaving = section_.segments[arriving.next];
                // All rays at the least vertex lie in a half plane: no left turn means that the
                // sector of Q holds the direction away from the cycle.
                hole |= turn_on_plane(frame_, arriving.direction, leaving.direction) <= 0;
            }
            s = arriving.next;
        } while (s != first_[cycle]);
        return hole;
    }

    // Whether a point next to `least`, towards smaller first coordinate, is inside a cycle.
    bool inside(int least, int cycle) {
        bool in = false;
        int s = first_[cycle];
        do {
            const Segment& g = section_.segments[s];
            s = g.next;
            const int v = (frame_.axis + 2) % 3;
            const bool from_up = points_.compare(g.from.point, least, v) > 0;
            const bool to_up = points_.compare(g.to.point, least, v) > 0;
            if (from_up == to_up) continue;
            // (u, v) is right-handed when looking along the dropped axis.
            const int turn = side_of_segment(g, least);
            if (turn != 0 && (turn > 0) != to_up) in = !in;
        } while (s != first_[cycle]);
        return in;
    }

    // Orientation of (from, to, point) in the unsigned projection.
    int side_of_segment(const Segment& g, int point) {
        return points_.orient(g.from.point, g.to.point, point, frame_.axis);
    }

    void find_holes() {
        least_.resize(first_.size());
        for (int c = 0; c < static_cast<int>(first_.size()); ++c)
            (is_hole(c, least_[c]) ? holes_ : outers_).push_back(c);
    }

    void attach_holes() {
        // Outer cycles around a point are nested: the innermost has the most others around it.
        std::vector<int> depth(first_.size(), -1);
        for (const int hole : holes_) {
            int best = -1;
            for (const int outer : outers_) {
                if (!inside(least_[hole], outer)) continue;
                if (best >= 0) {
                    for (const int c : {best, outer})
                        if (depth[c] < 0) depth[c] = nesting_depth(c, least_[c]);
                    if (depth[outer] <= depth[best]) continue;
                }
                best = outer;
            }
            if (best < 0) throw Inconsistent{"hole outside of the section", {section_.plane}};
            unite(hole, best);
        }
    }

    int nesting_depth(int cycle, int least) {
        int depth = 0;
        for (const int outer : outers_)
            if (outer != cycle && inside(least, outer)) ++depth;
        return depth;
    }

    void mark_used(Extent extent, const std::vector<char>& own) {
        std::vector<char> carries(first_.size(), 0);
        bool any = false;
        for (const Segment& s : section_.segments) {
            if (s.half_edge < 0) continue;
            const int notch = edges_[s.half_edge].notch;
            if (notch < 0) continue;
            if (extent == Extent::own_notches && !own[notch]) continue;
            carries[find(s.cycle)] = 1;
            any = true;
        }
        if (!any) throw Inconsistent{"notch without a section", {section_.plane}};
        section_.used.resize(section_.segments.size());
        for (std::size_t i = 0; i < section_.segments.size(); ++i)
            section_.used[i] =
                extent == Extent::whole_plane || carries[find(section_.segments[i].cycle)];
    }

    PointTable& points_;
    const HalfEdges& edges_;
    const Frame& frame_;
    Section& section_;
    std::vector<int> first_, parent_;
    std::vector<int> holes_, outers_, least_;  // cycles, and the least vertex of each
};

int sign_of_product_difference(Int128 a, Int128 b, Int128 c, Int128 d) {
    const double x = static_cast<double>(a) * static_cast<double>(b);
    const double y = static_cast<double>(c) * static_cast<double>(d);
    const double gap = x - y, bound = 0x1p-50 * (std::fabs(x) + std::fabs(y));
    if (gap > bound) return 1;
    if (gap < -bound) return -1;
    return (multiply<4>(WideInt<2>(a), WideInt<2>(b)) - multiply<4>(WideInt<2>(c), WideInt<2>(d)))
        .sign();
}

}  // namespace

int half_plane(const Frame& frame, const Direction& d) {
    const Int128 x = d[(frame.axis + 1) % 3];
    const Int128 y = frame.sign > 0 ? d[(frame.axis + 2) % 3] : -d[(frame.axis + 2) % 3];
    return y > 0 || (y == 0 && x > 0) ? 0 : 1;
}

int turn_on_plane(const Frame& frame, const Direction& p, const Direction& q) {
    const int u = (frame.axis + 1) % 3, v = (frame.axis + 2) % 3;
    return frame.sign * sign_of_product_difference(p[u], q[v], p[v], q[u]);
}

void select_components(PointTable& points, const HalfEdges& edges, const Frame& frame,
                       Extent extent, const std::vector<char>& own, Section& section) {
    Selector(points, edges, frame, section).run(extent, own);
}

}  // namespace tetra::notch
