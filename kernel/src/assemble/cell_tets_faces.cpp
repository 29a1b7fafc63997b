// SPDX-License-Identifier: LGPL-2.1-or-later
// Face-first triangulation: each common part of two facets once, each rest of a facet as skin.
#include <algorithm>
#include <set>

#include "cell_tets_stages.h"
#include "plane_regions.h"
#include "tetra/errors.h"

namespace tetra::cells {
namespace {

std::pair<int, int> undirected(int a, int b) { return {std::min(a, b), std::max(a, b)}; }

class FaceMaker {
  public:
    FaceMaker(Complex& complex, const std::vector<Piece>& pieces, const Slits& slits,
              const Splits& splits, const GridSolid& solid)
        : c_(complex), pieces_(pieces), slits_(slits), splits_(splits), solid_(solid) {
        std::vector<Triangle> items;
        for (int p = 0; p < static_cast<int>(solid.points.size()); ++p) items.push_back({p, p, p});
        input_points_ = build_box_tree(solid.points, items);
        pieces_of_.resize(c_.facets.size());
        for (std::size_t p = 0; p < pieces.size(); ++p)
            for (const int f : {pieces[p].front, pieces[p].back})
                pieces_of_[f].push_back(static_cast<int>(p));
    }

    std::vector<Face> run(Progress& progress) {
        for (std::size_t p = 0; p < pieces_.size(); ++p) {
            if (p % 256 == 0) progress.poll("overlay", 0.5);
            add_piece(p);
        }
        for (std::size_t f = 0; f < c_.facets.size(); ++f) {
            if (f % 256 == 0) progress.poll("overlay", 0.6);
            add_rest(static_cast<int>(f));
        }
        return std::move(faces_);
    }

    // Faces that are skin, or may be when skin lies on both sides of the plane.
    std::vector<int> candidates;

  private:
    void append_loop(const Polygon& polygon, Edges& out) const {
        const std::vector<int>& c = polygon.corners;
        for (std::size_t i = 0; i < c.size(); ++i)
            splits_.for_parts(c[i], c[(i + 1) % c.size()], [&](int u, int v) {
                out.push_back({u, v});
            });
    }

    bool two_sided(int facet) const { return slits_.two_sided[plane_of(c_.facets[facet].key)]; }

    // Input points inside the polygon, not on its border.
    std::vector<PointId> points_inside(const Polygon& polygon, int key) {
        std::vector<PointId> inside;
        for_boxes_touching(input_points_, box_of(c_.points, polygon.corners), [&](int p) {
            if (c_.points.side(p, plane_of(key)) == 0 && is_inside(p, polygon)) inside.push_back(p);
        });
        std::sort(inside.begin(), inside.end());
        return inside;
    }

    bool is_inside(int point, const Polygon& polygon) {
        return std::all_of(polygon.beyond.begin(), polygon.beyond.end(), [&](int key) {
            return key_sign(key) * c_.points.side(point, plane_of(key)) < 0;
        });
    }

    void append_slits(const std::vector<Segment>& segments,
                      const std::set<std::pair<int, int>>& without, Edges& out) const {
        std::set<std::pair<int, int>> done;
        for (const Segment& s : segments)
            splits_.for_parts(s[0], s[1], [&](int u, int v) {
                if (without.contains(undirected(u, v)) || !done.insert(undirected(u, v)).second)
                    return;
                out.push_back({u, v});
                out.push_back({v, u});
            });
    }

    void add_piece(std::size_t p) {
        const Piece& piece = pieces_[p];
        const int key = c_.facets[piece.front].key;
        const PlaneView view(c_.points, key);
        Edges edges;
        append_loop(piece.polygon, edges);
        std::vector<PointId> inner;
        const std::size_t border = edges.size();
        const bool both = two_sided(piece.front);
        if (both) {
            append_slits(slits_.of_piece[p], {}, edges);
            inner = points_inside(piece.polygon, key);
        }
        const bool plain = edges.size() == border && inner.empty();
        for (const PlanarTriangle& t :
             plain ? triangles_of_convex(edges, view) : triangles_of_region(edges, view, inner)) {
            add({t[0], t[1], t[2]}, piece.front, both);
            add({t[0], t[2], t[1]}, piece.back, both);
        }
    }

    void add(const Triangle& t, int facet, bool candidate) {
        if (candidate) candidates.push_back(static_cast<int>(faces_.size()));
        faces_.push_back({t, facet, -1});
    }

    // What no facet on the other side covers: skin.
    void add_rest(int f) {
        const Facet& facet = c_.facets[f];
        const std::vector<int>& covering = pieces_of_[f];
        Edges edges;
        append_loop(facet.polygon, edges);
        std::set<std::pair<int, int>> taken;
        if (!covering.empty()) edges = rest_of(facet, std::move(edges), covering, taken);
        if (edges.empty()) return;
        const PlaneView view(c_.points, facet.key);
        const std::size_t border = edges.size();
        append_slits(slits_.of_facet[f], taken, edges);
        std::vector<PointId> inner = points_inside(facet.polygon, facet.key);
        std::erase_if(inner, [&](PointId p) { return is_covered(p, covering); });
        const bool plain = covering.empty() && edges.size() == border && inner.empty();
        for (const PlanarTriangle& t :
             plain ? triangles_of_convex(edges, view) : triangles_of_region(edges, view, inner))
            add({t[0], t[1], t[2]}, f, true);
    }

    // The border of the facet less that of the pieces; their edges go to `taken`.
    Edges rest_of(const Facet& facet, Edges edges, const std::vector<int>& covering,
                  std::set<std::pair<int, int>>& taken) const {
        const bool front = key_sign(facet.key) > 0;
        for (const int p : covering) {
            Edges loop;
            append_loop(pieces_[p].polygon, loop);
            for (DirectedEdge& e : loop) {
                taken.insert(undirected(e.from, e.to));
                if (front) std::swap(e.from, e.to);
            }
            edges.insert(edges.end(), loop.begin(), loop.end());
            for (const Segment& s : slits_.of_piece[p])
                splits_.for_parts(s[0], s[1],
                                  [&](int u, int v) { taken.insert(undirected(u, v)); });
        }
        return without_opposites(std::move(edges));
    }

    bool is_covered(int point, const std::vector<int>& covering) {
        return std::any_of(covering.begin(), covering.end(), [&](int p) {
            const std::vector<int>& keys = pieces_[p].polygon.beyond;
            return std::all_of(keys.begin(), keys.end(), [&](int key) {
                return key_sign(key) * c_.points.side(point, plane_of(key)) <= 0;
            });
        });
    }

    Complex& c_;
    const std::vector<Piece>& pieces_;
    const Slits& slits_;
    const Splits& splits_;
    const GridSolid& solid_;
    BoxTree input_points_;
    std::vector<std::vector<int>> pieces_of_;  // per facet
    std::vector<Face> faces_;
};

// Owners spread over the triangles of one plane, side and solid from the rims, which they do not
// cross. What they do not reach is no skin.
class OwnerFlood {
  public:
    OwnerFlood(std::vector<Face>& faces, const Splits& splits) : faces_(faces), splits_(splits) {}

    void run(const std::vector<int>& candidates, const std::vector<const Rim*>& rims) {
        std::map<std::pair<int, int>, int> owner_left;
        for (const Rim* rim : rims)
            splits_.for_parts(rim->from, rim->to, [&](int u, int v) {
                owner_left[{u, v}] = rim->owner;
            });
        std::map<std::pair<int, int>, int> face_left;
        for (const int f : candidates)
            for (std::size_t k = 0; k < 3; ++k) face_left[edge(f, k)] = f;
        std::vector<int> stack;
        for (const int f : candidates)
            for (std::size_t k = 0; k < 3; ++k)
                if (const auto at = owner_left.find(edge(f, k)); at != owner_left.end())
                    give(f, at->second, stack);
        while (!stack.empty()) {
            const int f = stack.back();
            stack.pop_back();
            for (std::size_t k = 0; k < 3; ++k) {
                const auto [u, v] = edge(f, k);
                if (owner_left.contains({u, v}) || owner_left.contains({v, u})) continue;
                if (const auto at = face_left.find({v, u}); at != face_left.end())
                    give(at->second, faces_[f].owner, stack);
            }
        }
    }

  private:
    std::pair<int, int> edge(int face, std::size_t k) const {
        const Triangle& t = faces_[face].corners;
        return {t[k], t[(k + 1) % 3]};
    }

    void give(int face, int owner, std::vector<int>& stack) {
        if (faces_[face].owner == owner) return;
        if (faces_[face].owner >= 0)
            throw VerificationFailed("tetrahedra of cells: a triangle of the skin has two faces");
        faces_[face].owner = owner;
        stack.push_back(face);
    }

    std::vector<Face>& faces_;
    const Splits& splits_;
};

}  // namespace

std::vector<Face> triangulate_faces(Complex& complex, const std::vector<Piece>& pieces,
                                    const std::vector<Rim>& rims, const Slits& slits,
                                    const Splits& splits, const GridSolid& solid,
                                    Progress& progress) {
    FaceMaker maker(complex, pieces, slits, splits, solid);
    std::vector<Face> faces = maker.run(progress);
    struct Group {
        std::vector<int> candidates;
        std::vector<const Rim*> rims;
    };
    std::map<std::pair<int, int>, Group> groups;  // by key and solid
    for (const int f : maker.candidates) {
        const Facet& facet = complex.facets[faces[f].facet];
        groups[{facet.key, complex.cell_solid[facet.cell]}].candidates.push_back(f);
    }
    for (const Rim& rim : rims) groups[{rim.key, rim.solid}].rims.push_back(&rim);
    OwnerFlood flood(faces, splits);
    for (const auto& [where, group] : groups) flood.run(group.candidates, group.rims);
    return faces;
}

}  // namespace tetra::cells
