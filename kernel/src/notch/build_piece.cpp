// SPDX-License-Identifier: LGPL-2.1-or-later
// Radial pairing, dissolving and numbering of the input's edges.
#include "build_piece.h"

#include <algorithm>

namespace tetra::notch {
namespace {

// A half-edge u -> v of triangle `triangle`, filed under its undirected edge.
struct Side {
    int lo, hi;
    int half_edge;
    bool forward;  // lo -> hi
    int apex;      // the triangle's third vertex
};

// Position of facets around the axis u -> v, counter-clockwise from a first facet: 0 for the
// same half plane, then by exact signs.
class Radial {
  public:
    Radial(const GridSolid& solid, int u, int v, int first)
        : p_(solid.points), u_(u), v_(v), first_(first) {}

    // Half-turn of apex w from the first: 0 at angle 0, 1 in (0, pi), 2 at pi, 3 beyond.
    int sector(int w) const {
        const int s = orient3d(p_[u_], p_[v_], p_[first_], p_[w]);
        if (s != 0) return s > 0 ? 1 : 3;
        return same_side(w) ? 0 : 2;
    }
    bool less(int a, int b) const {
        const int sa = sector(a), sb = sector(b);
        if (sa != sb) return sa < sb;
        if (sa == 0 || sa == 2) return false;
        return orient3d(p_[u_], p_[v_], p_[a], p_[b]) > 0;
    }
    bool equal(int a, int b) const { return !less(a, b) && !less(b, a); }

  private:
    bool same_side(int w) const {
        // w and first are coplanar with the axis: compare cross products with the axis.
        for (int k = 0; k < 3; ++k) {
            const int a = orient2d(p_[u_], p_[v_], p_[first_], k, (k + 1) % 3);
            const int b = orient2d(p_[u_], p_[v_], p_[w], k, (k + 1) % 3);
            if (a != 0) return a == b;
        }
        return true;
    }
    const std::vector<Vec3i>& p_;
    int u_, v_, first_;
};

class Builder {
  public:
    Builder(const GridSolid& solid, const PlaneClasses& classes, PointTable& points,
            HalfEdges& edges)
        : solid_(solid), classes_(classes), points_(points), edges_(edges) {}

    Piece run(std::vector<Notch>& notches) {
        add_triangles();
        pair_edges();
        dissolve_and_straighten();
        set_plane_lines();
        number_notches(notches);
        return std::move(piece_);
    }

  private:
    void add_triangles() {
        for (std::size_t t = 0; t < solid_.triangles.size(); ++t) {
            const Triangle& tri = solid_.triangles[t];
            std::array<int, 3> h{};
            for (int k = 0; k < 3; ++k) {
                h[k] = edges_.add(tri[k], classes_.key[t], -1);
                piece_.edges.push_back(h[k]);
                const int u = tri[k], v = tri[(k + 1) % 3];
                sides_.push_back({std::min(u, v), std::max(u, v), h[k], u < v, tri[(k + 2) % 3]});
            }
            for (int k = 0; k < 3; ++k) edges_.link(h[k], h[(k + 1) % 3]);
        }
        std::sort(sides_.begin(), sides_.end(), [](const Side& a, const Side& b) {
            if (a.lo != b.lo) return a.lo < b.lo;
            if (a.hi != b.hi) return a.hi < b.hi;
            return a.half_edge < b.half_edge;
        });
    }

    void pair_edges() {
        for (std::size_t i = 0, j; i < sides_.size(); i = j) {
            for (j = i;
                 j < sides_.size() && sides_[j].lo == sides_[i].lo && sides_[j].hi == sides_[i].hi;)
                ++j;
            const int line = points_.input_line(sides_[i].lo, sides_[i].hi);
            for (std::size_t k = i; k < j; ++k) edges_[sides_[k].half_edge].line = line;
            if (j - i == 2)
                edges_.pair(sides_[i].half_edge, sides_[i + 1].half_edge);
            else
                pair_radially(i, j);
        }
    }

    // Around lo -> hi a forward facet has its solid clockwise, so it pairs with the backward
    // facet that comes before it counter-clockwise. Facets in one half plane (a contact of
    // faces) have void between them: the forward one comes first there.
    void pair_radially(std::size_t i, std::size_t j) {
        const Radial radial(solid_, sides_[i].lo, sides_[i].hi, sides_[i].apex);
        std::vector<Side> ring(sides_.begin() + static_cast<std::ptrdiff_t>(i),
                               sides_.begin() + static_cast<std::ptrdiff_t>(j));
        std::stable_sort(ring.begin(), ring.end(), [&](const Side& a, const Side& b) {
            if (radial.less(a.apex, b.apex)) return true;
            if (radial.less(b.apex, a.apex)) return false;
            return a.forward > b.forward;
        });
        for (std::size_t k = 0; k < ring.size(); ++k) {
            const Side& s = ring[k];
            if (!s.forward) continue;
            const Side& before = ring[(k + ring.size() - 1) % ring.size()];
            edges_.pair(s.half_edge, before.half_edge);
        }
    }

    void dissolve_and_straighten() {
        std::vector<int> touched;
        for (const int h : piece_.edges)
            if (edges_.alive(h) && edges_[h].key == edges_[edges_[h].twin].key)
                edges_.dissolve(h, touched);
        for (const int h : piece_.edges)
            if (edges_.alive(h)) edges_.straighten(h);
        std::erase_if(piece_.edges, [&](int h) { return !edges_.alive(h); });
    }

    // An edge whose ends were moved onto its planes lies on their line, not on a grid line.
    void set_plane_lines() {
        for (const int h : piece_.edges) {
            const int t = edges_[h].twin;
            const int p = plane_of(edges_[h].key), q = plane_of(edges_[t].key);
            if (h > t || p == q) continue;
            const int u = edges_[h].org, v = edges_[t].org;
            const Line& line = points_.line(edges_[h].line);
            const bool as_given = !points_.is_moved(u) && !points_.is_moved(v) &&
                                  std::minmax(line.u, line.v) == std::minmax(u, v);
            if (as_given) continue;
            bool on = true;
            for (const int w : {u, v})
                on &= points_.is_exactly_on(w, p) && points_.is_exactly_on(w, q);
            edges_[h].line = edges_[t].line =
                on ? points_.plane_line(p, q) : points_.input_line(u, v);
        }
    }

    void number_notches(std::vector<Notch>& notches) {
        for (const int h : piece_.edges) {
            const int t = edges_[h].twin;
            if (h > t || !is_reflex(points_, edges_, h)) continue;
            edges_[h].notch = edges_[t].notch = static_cast<int>(notches.size());
            notches.push_back({plane_of(edges_[h].key), plane_of(edges_[t].key), -1});
        }
    }

    const GridSolid& solid_;
    const PlaneClasses& classes_;
    PointTable& points_;
    HalfEdges& edges_;
    Piece piece_;
    std::vector<Side> sides_;

  public:
    // (n_own x n_twin) . direction < 0, exactly (5b+9 bits).
    static bool is_reflex(const PointTable& points, const HalfEdges& edges, int h) {
        const int t = edges[h].twin;
        const int a = edges[h].key, b = edges[t].key;
        if (plane_of(a) == plane_of(b)) return false;
        const Direction n = points.cross(plane_of(a), plane_of(b));
        const Vec3i &u = points.input(edges[h].org), &v = points.input(edges[t].org);
        Int256 dot;
        for (int k = 0; k < 3; ++k) dot += multiply<4>(WideInt<2>(n[k]), WideInt<1>(v[k] - u[k]));
        return dot.sign() * key_sign(a) * key_sign(b) < 0;
    }
};

}  // namespace

Piece build_piece(const GridSolid& solid, const PlaneClasses& classes, PointTable& points,
                  HalfEdges& edges, std::vector<Notch>& notches) {
    return Builder(solid, classes, points, edges).run(notches);
}

}  // namespace tetra::notch
