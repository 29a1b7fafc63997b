// SPDX-License-Identifier: LGPL-2.1-or-later
// Exact triangle-triangle tests on all pairs whose boxes touch.
#include "tetra/solid/crossing.h"

#include <algorithm>

#include "tetra/exact/predicates.h"
#include "tetra/solid/edges.h"

namespace tetra {
namespace {

using Signs = std::array<int, 3>;

// A surface can cross itself in n^2 places: after this many times the limit the search ends.
constexpr std::size_t enough = 100;

// Where a triangle meets the plane of another: two points on edges `from` (strictly off the
// plane) -> `to`, or along the edge opposite to its only corner off the plane.
struct Section {
    struct End {
        int from, to, side;
    };
    std::array<End, 2> ends;
    int edge = -1;  // local index i of the edge i -> i+1 that lies in the plane, else -1
};

// False when the triangle meets the plane in a point or not at all.
bool section_of(const Signs& s, Section& r) {
    const int zeros = (s[0] == 0) + (s[1] == 0) + (s[2] == 0);
    if (zeros == 2) {
        const int off = s[0] != 0 ? 0 : (s[1] != 0 ? 1 : 2);
        const int side = s[static_cast<std::size_t>(off)];
        r.ends = {{{off, (off + 1) % 3, side}, {off, (off + 2) % 3, side}}};
        r.edge = (off + 1) % 3;
        return true;
    }
    if (s[0] + s[1] + s[2] == (zeros == 1 ? 2 : 3) || s[0] + s[1] + s[2] == (zeros == 1 ? -2 : -3))
        return false;
    for (int k = 0; k < 3; ++k) {
        // The corner alone on its side (any corner off the plane when one lies in it).
        const int a = s[static_cast<std::size_t>(k)], b = s[static_cast<std::size_t>((k + 1) % 3)],
                  c = s[static_cast<std::size_t>((k + 2) % 3)];
        if (a == 0 || a == b || a == c) continue;
        r.ends = {{{k, (k + 1) % 3, a}, {k, (k + 2) % 3, a}}};
        r.edge = -1;
        return true;
    }
    return false;
}

class Finder {
  public:
    Finder(const GridSolid& s, const Sheets& sheets, const BoxTree& tree, std::size_t limit)
        : s_(s), sheets_(sheets), tree_(tree), limit_(limit) {}

    Crossings run(Progress& progress) {
        std::size_t tests = 0;
        const double expected = 20.0 * static_cast<double>(s_.triangles.size()) + 1;
        for_touching_boxes(tree_, [&](int a, int b) {
            if (++tests % 1024 == 0)
                progress.poll("validate", std::min(1.0, static_cast<double>(tests) / expected));
            if (found_.pairs.size() <= enough * limit_) test(a, b);
        });
        std::sort(found_.pairs.begin(), found_.pairs.end());
        if (found_.pairs.size() > limit_) found_.pairs.resize(limit_);
        std::sort(found_.touching_points.begin(), found_.touching_points.end());
        found_.touching_points.erase(
            std::unique(found_.touching_points.begin(), found_.touching_points.end()),
            found_.touching_points.end());
        return std::move(found_);
    }

  private:
    const Triangle& triangle(int t) const { return s_.triangles[static_cast<std::size_t>(t)]; }
    int vertex(int t, int i) const { return triangle(t)[static_cast<std::size_t>(i % 3)]; }
    const Vec3i& point(int v) const { return s_.points[static_cast<std::size_t>(v)]; }
    const Vec3i& corner(int t, int i) const { return point(vertex(t, i)); }
    bool has_vertex(int t, int v) const {
        return triangle(t)[0] == v || triangle(t)[1] == v || triangle(t)[2] == v;
    }
    bool same_solid(int a, int b) const {
        return s_.solid[static_cast<std::size_t>(a)] == s_.solid[static_cast<std::size_t>(b)];
    }
    int side_of(int t, int v) const {
        return has_vertex(t, v) ? 0 : orient3d(corner(t, 0), corner(t, 1), corner(t, 2), point(v));
    }
    Signs sides_of(int t, int other) const {
        return {side_of(t, vertex(other, 0)), side_of(t, vertex(other, 1)),
                side_of(t, vertex(other, 2))};
    }

    // Most pairs are neighbours, and b meets the plane of a in what they share alone: a corner, or
    // a side at which the sheets were made not to cross.
    bool meets_in_own_corners(int a, int b, const Signs& sides) const {
        if (!same_solid(a, b)) return false;
        int most = 0, least = 0;
        for (int i = 0; i < 3; ++i) {
            const int side = sides[static_cast<std::size_t>(i)];
            if (side == 0 && !has_vertex(a, vertex(b, i))) return false;
            most = std::max(most, side);
            least = std::min(least, side);
        }
        return most - least == 1;
    }

    void report(int a, int b, bool flat) {
        found_.pairs.push_back({std::min(a, b), std::max(a, b), flat});
    }

    void test(int a, int b) {
        const Signs sb = sides_of(a, b);
        if (meets_in_own_corners(a, b, sb)) return;
        if ((sb[0] > 0 && sb[1] > 0 && sb[2] > 0) || (sb[0] < 0 && sb[1] < 0 && sb[2] < 0)) return;
        if (sb[0] == 0 && sb[1] == 0 && sb[2] == 0) return test_coplanar(a, b);
        const Signs sa = sides_of(b, a);
        if ((sa[0] > 0 && sa[1] > 0 && sa[2] > 0) || (sa[0] < 0 && sa[1] < 0 && sa[2] < 0)) return;
        note_touching(a, b, sb);
        note_touching(b, a, sa);
        Section section_a, section_b;
        if (!section_of(sa, section_a) || !section_of(sb, section_b)) return;
        if (overlap(a, section_a, b, section_b)) judge_segment(a, section_a, b, section_b);
    }

    // Do the two sections, both on the common line of the planes, share more than a point?
    bool overlap(int a, const Section& sa, int b, const Section& sb) const {
        bool before = false, after = false;
        for (const Section::End& x : sa.ends)
            for (const Section::End& y : sb.ends) {
                // Sign of position(y) - position(x) along the line, up to a common factor.
                const int order = x.side * y.side *
                                  orient3d(corner(a, x.from), corner(a, x.to), corner(b, y.from),
                                           corner(b, y.to));
                before = before || order < 0;
                after = after || order > 0;
            }
        return before && after;
    }

    void judge_segment(int a, const Section& sa, int b, const Section& sb) {
        if (sa.edge < 0 && sb.edge < 0) return report(a, b, false);
        if (sa.edge < 0) return judge_edge(a, b, sb.edge);
        if (sb.edge < 0) return judge_edge(b, a, sa.edge);
        judge_two_edges(a, sa.edge, b, sb.edge);
    }

    // Edge i of b lies inside a: the sheet of that edge must stay on one side of a. A half of it
    // that lies in a touches from outside: the other half may not go into the solid.
    void judge_edge(int a, int b, int i) {
        const int h = 3 * b + i, twin = sheets_.twin[static_cast<std::size_t>(h)];
        const int here = side_of(a, apex_of(s_.triangles, h));
        const int there = side_of(a, apex_of(s_.triangles, twin));
        if (here * there < 0) report(a, b, false);
        if (there == 0 && here < 0) report(a, b, true);
    }

    // Collinear edges overlap: neither sheet may have the other's half-planes on different sides,
    // and half-planes that coincide touch from outside. Along u -> v the solid of a's sheet lies
    // between the twin's half-plane and a's own (place -1).
    void judge_two_edges(int a, int i, int b, int j) {
        const int ha = 3 * a + i, hb = 3 * b + j;
        const int u = tail_of(s_.triangles, ha), v = head_of(s_.triangles, ha);
        const int p = tail_of(s_.triangles, hb), q = head_of(s_.triangles, hb);
        // Pairs at one edge of one solid were made not to cross.
        if (same_solid(a, b) && std::min(u, v) == std::min(p, q) &&
            std::max(u, v) == std::max(p, q))
            return;
        const auto apex = [&](int h) -> const Vec3i& { return point(apex_of(s_.triangles, h)); };
        const auto twin = [&](int h) { return sheets_.twin[static_cast<std::size_t>(h)]; };
        const Vec3i &start = apex(ha), &end = apex(twin(ha));
        const auto place = [&](const Vec3i& w) {
            if (compare_around(point(u), point(v), start, start, w) == 0) return 0;
            return compare_around(point(u), point(v), start, end, w);
        };
        const int here = place(apex(hb)), there = place(apex(twin(hb)));
        if (here * there < 0) report(a, b, false);
        if ((here == 0 && there < 0) || (there == 0 && here < 0)) report(a, b, true);
    }

    // The projection along an axis in which coplanar triangles keep their area.
    static void projection(const Vec3i& p, const Vec3i& q, const Vec3i& r, int& u, int& v) {
        for (const auto& [i, j] : {std::pair{0, 1}, {1, 2}, {2, 0}})
            if (orient2d(p, q, r, i, j) != 0) {
                u = i;
                v = j;
                return;
            }
    }

    void test_coplanar(int a, int b) {
        int u = 0, v = 1;
        projection(corner(a, 0), corner(a, 1), corner(a, 2), u, v);
        const int turn_a = orient2d(corner(a, 0), corner(a, 1), corner(a, 2), u, v);
        const int turn_b = orient2d(corner(b, 0), corner(b, 1), corner(b, 2), u, v);
        for (int i = 0; i < 3; ++i) note_inside(a, vertex(b, i), u, v);
        for (int i = 0; i < 3; ++i) note_inside(b, vertex(a, i), u, v);
        if (separated(a, turn_a, b, u, v) || separated(b, turn_b, a, u, v)) return;
        if (turn_a == turn_b)
            report(a, b, true);
        else
            ++found_.facet_contacts;
    }

    // Does the line of an edge of a have all of b on its outer side?
    bool separated(int a, int turn, int b, int u, int v) const {
        for (int i = 0; i < 3; ++i) {
            bool outside = true;
            for (int k = 0; k < 3 && outside; ++k)
                outside = turn * orient2d(corner(a, i), corner(a, i + 1), corner(b, k), u, v) <= 0;
            if (outside) return true;
        }
        return false;
    }

    void note_touching(int a, int b, const Signs& sides) {
        int u = -1, v = -1;
        for (int i = 0; i < 3; ++i) {
            if (sides[static_cast<std::size_t>(i)] != 0 || has_vertex(a, vertex(b, i))) continue;
            if (u < 0) projection(corner(a, 0), corner(a, 1), corner(a, 2), u, v);
            note_inside(a, vertex(b, i), u, v);
        }
    }

    // Notes a point in the plane of t that lies on t, corners excepted.
    void note_inside(int t, int p, int u, int v) {
        if (has_vertex(t, p)) return;
        const int turn = orient2d(corner(t, 0), corner(t, 1), corner(t, 2), u, v);
        for (int i = 0; i < 3; ++i)
            if (turn * orient2d(corner(t, i), corner(t, i + 1), point(p), u, v) < 0) return;
        found_.touching_points.push_back(p);
    }

    const GridSolid& s_;
    const Sheets& sheets_;
    const BoxTree& tree_;
    std::size_t limit_;
    Crossings found_;
};

}  // namespace

Crossings find_crossings(const GridSolid& surface, const Sheets& sheets, const BoxTree& tree,
                         std::size_t limit, Progress& progress) {
    return Finder(surface, sheets, tree, limit).run(progress);
}

}  // namespace tetra
