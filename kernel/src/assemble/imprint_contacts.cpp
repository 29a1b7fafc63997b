// SPDX-License-Identifier: LGPL-2.1-or-later
// Triangles are overlaid like facets of cells, bounded by planes upright on their own.
#include "tetra/assemble/imprint_contacts.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

#include "cell_tets_stages.h"
#include "plane_regions.h"
#include "tetra/exact/predicates.h"
#include "tetra/fence/pull_off.h"
#include "tetra/solid/edges.h"
#include "tetra/solid/snap.h"
#include "vec3.h"

namespace tetra {
namespace {

using namespace cells;

constexpr int kBits = 26;  // the finest grid whose overlays fit 256 bits

// The plane through u and v along the axis nearest to the normal, facing away from `inner`.
int upright(const GridSolid& solid, PointTable& points, const Plane& plane, int u, int v,
            int inner) {
    const std::array<std::int64_t, 3> n{plane.a, plane.b, plane.c};
    std::size_t axis = 0;
    for (std::size_t k = 1; k < 3; ++k)
        if (std::abs(n[k]) > std::abs(n[axis])) axis = k;
    Vec3i above = solid.points[u];
    ++above[axis];
    const int key = points.add_plane(plane_through(solid.points[u], solid.points[v], above));
    points.set_on(u, plane_of(key));
    points.set_on(v, plane_of(key));
    return key_sign(key) * points.side(inner, plane_of(key)) < 0 ? key : opposite_key(key);
}

// Each triangle as a facet of a cell of its own, with the same number.
Complex complex_of_triangles(const GridSolid& solid) {
    Complex complex(kBits);
    complex.between_solids_only = true;
    for (const Vec3i& p : solid.points) complex.points.add_input(p);
    for (std::size_t t = 0; t < solid.triangles.size(); ++t) {
        const Triangle& c = solid.triangles[t];
        const Plane plane =
            plane_through(solid.points[c[0]], solid.points[c[1]], solid.points[c[2]]);
        Facet facet{static_cast<int>(t), complex.points.add_plane(plane), {{c[0], c[1], c[2]}, {}}};
        for (const int p : c) complex.points.set_on(p, plane_of(facet.key));
        for (std::size_t k = 0; k < 3; ++k)
            facet.polygon.beyond.push_back(
                upright(solid, complex.points, plane, c[k], c[(k + 1) % 3], c[(k + 2) % 3]));
        complex.facets.push_back(std::move(facet));
        complex.first_facet.push_back(static_cast<int>(complex.facets.size()));
        complex.cell_solid.push_back(solid.solid[t]);
    }
    complex.on_plane.resize(static_cast<std::size_t>(complex.points.planes()));
    for (std::size_t f = 0; f < complex.facets.size(); ++f)
        complex.on_plane[plane_of(complex.facets[f].key)].push_back(static_cast<int>(f));
    return complex;
}

using Edge = std::pair<int, int>;  // grid points, the lower first

// Where two of the caller's edges meet in doubles: the point of the first nearest to the second.
Vec3d meeting(const Vec3d& a, const Vec3d& b, const Vec3d& c, const Vec3d& d) {
    const Vec3d u = minus(b, a), v = minus(d, c), w = minus(a, c);
    const double uu = dot(u, u), uv = dot(u, v), vv = dot(v, v);
    const double t = (uv * dot(v, w) - vv * dot(u, w)) / (uu * vv - uv * uv);
    return {a[0] + t * u[0], a[1] + t * u[1], a[2] + t * u[2]};
}

Vec3d unit(const Vec3d& v) {
    const double length = norm(v);
    return {v[0] / length, v[1] / length, v[2] / length};
}

// Two facets in contact, of solids with the lower and the higher id.
struct Contact {
    int front, back;          // owners
    std::vector<int> pieces;  // common parts of their triangles
};

class Imprinter {
  public:
    Imprinter(const TetInput& input, Progress& progress) : input_(input), progress_(progress) {}

    Imprint run() {
        Imprint out;
        SnapReport snapped;
        grid_ = build_grid_solid({input_.vertices, input_.triangles, {}, input_.solid}, kBits,
                                 &snapped);
        out.merged_points = snapped.merged_points;
        owners_ = facet_owners(grid_.points, grid_.triangles, faces_of_grid(), grid_.solid);
        Complex complex = complex_of_triangles(grid_);
        pieces_ = overlay(complex, progress_);
        if (pieces_.empty()) return as_given();
        find_facets_to_divide(complex);
        find_splits(complex);
        vertices_ = input_.vertices;
        place_new_points(complex);
        for (const Contact& c : contacts_)
            if (divide_[c.front]) fill_contact(complex, c, out);
        fill_rests(complex, out);
        keep_others(complex, out);
        out.surface.vertices = std::move(vertices_);
        find_contacts(out);
        return out;
    }

    Imprint as_given() const {
        Imprint out;
        out.surface = input_;
        out.source.resize(input_.triangles.size());
        std::iota(out.source.begin(), out.source.end(), 0);
        out.contact.assign(input_.triangles.size(), -1);
        return out;
    }

  private:
    std::vector<int> faces_of_grid() const {
        std::vector<int> faces;
        if (!input_.face.empty())
            for (const int t : grid_.triangle_source) faces.push_back(input_.face[t]);
        return faces;
    }

    // Facets whose triangles already equal those on the other side stay as they are, unless they
    // touch a facet that doesn't.
    void find_facets_to_divide(const Complex& complex) {
        std::map<std::pair<int, int>, Contact> found;
        divide_.assign(1 + *std::max_element(owners_.begin(), owners_.end()), 0);
        for (std::size_t p = 0; p < pieces_.size(); ++p) {
            const int f = owners_[pieces_[p].front], b = owners_[pieces_[p].back];
            Contact& contact = found.try_emplace({f, b}, Contact{f, b, {}}).first->second;
            contact.pieces.push_back(static_cast<int>(p));
            const auto same = [&](int triangle) {
                std::vector<int> corners = pieces_[p].polygon.corners,
                                 own = complex.facets[triangle].polygon.corners;
                std::sort(corners.begin(), corners.end());
                std::sort(own.begin(), own.end());
                return corners == own;
            };
            if (!same(pieces_[p].front) || !same(pieces_[p].back)) divide_[f] = divide_[b] = 1;
        }
        for (auto& [owners, contact] : found) contacts_.push_back(std::move(contact));
        for (bool grew = true; grew;) {
            grew = false;
            for (const Contact& c : contacts_)
                if (divide_[c.front] != divide_[c.back]) {
                    divide_[c.front] = divide_[c.back] = 1;
                    grew = true;
                }
        }
    }

    void find_splits(Complex& complex) {
        const auto add = [&](const Polygon& polygon, int key) {
            for (std::size_t i = 0; i < polygon.corners.size(); ++i)
                splits_.add(polygon.corners[i], polygon.corners[(i + 1) % polygon.corners.size()],
                            plane_of(key), plane_of(polygon.beyond[i]));
        };
        for (const Facet& f : complex.facets) add(f.polygon, f.key);
        for (const Piece& p : pieces_) add(p.polygon, complex.facets[p.front].key);
        splits_.find(complex, progress_);
    }

    // Points where borders of facets cross; crossings with inner edges of facets are left out.
    void place_new_points(const Complex& complex) {
        made_.assign(static_cast<std::size_t>(complex.points.points()), -1);
        std::map<int, std::vector<Edge>> borders_at;
        const EdgeTable table = build_edges(grid_.triangles, grid_.solid);
        for (std::size_t e = 0; e < table.edges.size(); ++e) {
            const auto sides = table.of(e);
            if (sides.size() == 2 && owners_[sides[0] / 3] == owners_[sides[1] / 3]) continue;
            const Edge border{table.edges[e].low, table.edges[e].high};
            splits_.for_parts(border.first, border.second, [&](int, int p) {
                if (p >= complex.points.inputs()) borders_at[p].push_back(border);
            });
        }
        for (const auto& [p, borders] : borders_at) place(p, borders);
    }

    const Vec3d& caller(int point) const { return input_.vertices[grid_.point_source[point]]; }

    // In the caller's coordinates, from the two borders that cross at the largest angle.
    void place(int point, const std::vector<Edge>& borders) {
        const auto direction = [&](const Edge& e) {
            return unit(minus(caller(e.second), caller(e.first)));
        };
        const auto parallel = [&](const Edge& e, const Edge& f) {
            const Vec3i &a = grid_.points[e.first], &b = grid_.points[e.second];
            return collinear(a, b, grid_.points[f.first]) &&
                   collinear(a, b, grid_.points[f.second]);
        };
        double best = -1;
        for (std::size_t i = 0; i < borders.size(); ++i)
            for (std::size_t j = i + 1; j < borders.size(); ++j) {
                const Edge &e = borders[i], &f = borders[j];
                if (parallel(e, f)) continue;
                const double sine = norm(cross(direction(e), direction(f)));
                if (sine <= best) continue;
                if (best < 0) {
                    made_[point] = static_cast<int>(vertices_.size());
                    vertices_.emplace_back();
                }
                best = sine;
                vertices_.back() =
                    meeting(caller(e.first), caller(e.second), caller(f.first), caller(f.second));
            }
    }

    bool is_kept(int point) const {
        return point < static_cast<int>(grid_.points.size()) || made_[point] >= 0;
    }

    // The border with straight passages through points that are left out joined.
    Edges joined(const Edges& edges) const {
        std::map<int, int> onward;  // from points that are left out
        for (const DirectedEdge& e : edges)
            if (!is_kept(e.from)) onward[e.from] = e.to;
        Edges result;
        for (DirectedEdge e : edges) {
            if (!is_kept(e.from)) continue;
            while (!is_kept(e.to)) e.to = onward.at(e.to);
            result.push_back(e);
        }
        return result;
    }

    Edges border_of(const Contact& contact) const {
        Edges edges;
        for (const int p : contact.pieces) append_loop(pieces_[p].polygon.corners, edges);
        return without_opposites(std::move(edges));
    }

    void append_loop(const std::vector<int>& corners, Edges& out) const {
        for (std::size_t i = 0; i < corners.size(); ++i)
            splits_.for_parts(corners[i], corners[(i + 1) % corners.size()], [&](int u, int v) {
                out.push_back({u, v});
            });
    }

    // Both sides at once.
    void fill_contact(Complex& complex, const Contact& contact, Imprint& out) {
        const int front = pieces_[contact.pieces.front()].front,
                  back = pieces_[contact.pieces.front()].back;
        const PlaneView view(complex.points, complex.facets[front].key);
        std::vector<PointId> inner;
        for (const int p : contact.pieces)
            for (const int facet : {pieces_[p].front, pieces_[p].back})
                for (const int v : complex.facets[facet].polygon.corners)
                    if (covers(complex, contact, v)) inner.push_back(v);
        for (const PlanarTriangle& t :
             triangles_of_region(joined(border_of(contact)), view, inner)) {
            add(out, {t[0], t[1], t[2]}, front);
            add(out, {t[0], t[2], t[1]}, back);
        }
    }

    bool covers(Complex& complex, const Contact& contact, int point) const {
        return std::any_of(contact.pieces.begin(), contact.pieces.end(), [&](int p) {
            const std::vector<int>& beyond = pieces_[p].polygon.beyond;
            return std::all_of(beyond.begin(), beyond.end(), [&](int key) {
                return key_sign(key) * complex.points.side(point, plane_of(key)) <= 0;
            });
        });
    }

    // What the contacts leave of each facet that is divided.
    void fill_rests(Complex& complex, Imprint& out) {
        std::map<int, std::vector<int>> triangles;
        for (std::size_t t = 0; t < owners_.size(); ++t)
            if (divide_[owners_[t]]) triangles[owners_[t]].push_back(static_cast<int>(t));
        std::map<int, std::vector<const Contact*>> contacts;
        for (const Contact& c : contacts_)
            for (const int owner : {c.front, c.back}) contacts[owner].push_back(&c);
        for (const auto& [owner, list] : triangles)
            fill_rest(complex, list, contacts.at(owner), out);
    }

    void fill_rest(Complex& complex, const std::vector<int>& triangles,
                   const std::vector<const Contact*>& contacts, Imprint& out) {
        Edges edges;
        std::vector<PointId> inner;
        for (const int t : triangles) {
            append_loop(complex.facets[t].polygon.corners, edges);
            for (const int v : complex.facets[t].polygon.corners)
                if (std::none_of(contacts.begin(), contacts.end(),
                                 [&](const Contact* c) { return covers(complex, *c, v); }))
                    inner.push_back(v);
        }
        const int owner = owners_[triangles.front()];
        for (const Contact* c : contacts)
            for (DirectedEdge e : border_of(*c)) {
                if (owner == c->front) std::swap(e.from, e.to);
                edges.push_back(e);
            }
        edges = joined(without_opposites(std::move(edges)));
        if (edges.empty()) return;
        const PlaneView view(complex.points, complex.facets[triangles.front()].key);
        for (const PlanarTriangle& t : triangles_of_region(edges, view, inner))
            add(out, {t[0], t[1], t[2]}, triangles.front());
    }

    // Triangles of all other facets; their borders may be divided.
    void keep_others(const Complex& complex, Imprint& out) const {
        for (std::size_t t = 0; t < owners_.size(); ++t) {
            if (divide_[owners_[t]]) continue;
            Edges edges;
            append_loop(complex.facets[t].polygon.corners, edges);
            edges = joined(edges);
            const PlaneView view(complex.points, complex.facets[t].key);
            for (const PlanarTriangle& part : triangles_of_convex(edges, view))
                add(out, {part[0], part[1], part[2]}, static_cast<int>(t));
        }
    }

    void add(Imprint& out, const Triangle& corners, int triangle) const {
        Triangle t = corners;
        for (int& p : t) p = made_[p] >= 0 ? made_[p] : grid_.point_source[p];
        const int source = grid_.triangle_source[triangle];
        out.surface.triangles.push_back(t);
        out.surface.solid.push_back(input_.solid[source]);
        if (!input_.face.empty()) out.surface.face.push_back(input_.face[source]);
        out.source.push_back(source);
    }

    static void find_contacts(Imprint& out) {
        const std::vector<Triangle>& triangles = out.surface.triangles;
        std::map<Triangle, std::vector<int>> sides;
        for (std::size_t t = 0; t < triangles.size(); ++t) {
            Triangle key = triangles[t];
            std::sort(key.begin(), key.end());
            sides[key].push_back(static_cast<int>(t));
        }
        out.contact.assign(triangles.size(), -1);
        for (const auto& [key, list] : sides) {
            if (list.size() != 2) continue;
            const int a = list[0], b = list[1];
            if (out.surface.solid[a] == out.surface.solid[b]) continue;
            out.contact[a] = b;
            out.contact[b] = a;
        }
    }

    const TetInput& input_;
    Progress& progress_;
    GridSolid grid_;
    std::vector<int> owners_;  // per triangle of the grid, which is also its facet in the complex
    std::vector<Piece> pieces_;
    std::vector<Contact> contacts_;
    std::vector<char> divide_;  // per owner
    Splits splits_;
    std::vector<int> made_;  // new vertex of each point of the overlay, or -1
    std::vector<Vec3d> vertices_;
};

}  // namespace

bool Imprint::any() const {
    return std::any_of(contact.begin(), contact.end(), [](int c) { return c >= 0; });
}

Imprint imprint_contacts(const TetInput& input, Progress& progress) {
    Imprinter imprinter(input, progress);
    const bool several =
        !input.solid.empty() && std::any_of(input.solid.begin(), input.solid.end(),
                                            [&](int s) { return s != input.solid.front(); });
    return several ? imprinter.run() : imprinter.as_given();
}

}  // namespace tetra
