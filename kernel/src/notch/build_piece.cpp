// SPDX-License-Identifier: LGPL-2.1-or-later
// Radial pairing, dissolving and numbering of the input's edges.
#include "build_piece.h"

#include <algorithm>

#include "tetra/solid/sheets.h"

namespace tetra::notch {
namespace {

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
    // The pool is empty, so half-edge i of triangle t is 3 t + i as in sheets.h.
    void add_triangles() {
        for (std::size_t t = 0; t < solid_.triangles.size(); ++t) {
            const Triangle& tri = solid_.triangles[t];
            std::array<int, 3> h{};
            for (int k = 0; k < 3; ++k) {
                h[k] = edges_.add(tri[k], classes_.key[t], -1);
                piece_.edges.push_back(h[k]);
            }
            for (int k = 0; k < 3; ++k) edges_.link(h[k], h[(k + 1) % 3]);
        }
    }

    void pair_edges() {
        const Sheets sheets = pair_half_edges(solid_.points, solid_.triangles, solid_.solid);
        for (const int h : piece_.edges) {
            const int t = sheets.twin[h];
            if (h > t) continue;
            edges_.pair(h, t);
            edges_[h].line = edges_[t].line = points_.input_line(edges_[h].org, edges_[t].org);
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
