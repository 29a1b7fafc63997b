// SPDX-License-Identifier: LGPL-2.1-or-later
// The common parts of the facets on both sides of each plane, and what of the surface's own edges
// runs through them.
#include <algorithm>

#include "cell_tets_stages.h"
#include "tetra/solid/edges.h"

namespace tetra::cells {
namespace {

// A box tree over anything that has boxes.
class Boxes {
  public:
    void add(const Box& box) {
        const int n = static_cast<int>(corners_.size());
        corners_.push_back(box.low);
        corners_.push_back(box.high);
        items_.push_back({n, n + 1, n + 1});
    }
    BoxTree build() const { return build_box_tree(corners_, items_); }

  private:
    std::vector<Vec3i> corners_;
    std::vector<Triangle> items_;
};

class Overlay {
  public:
    explicit Overlay(Complex& complex) : c_(complex) {}

    std::vector<Piece> run(Progress& progress) {
        const std::size_t n = c_.on_plane.size();
        for (std::size_t plane = 0; plane < n; ++plane) {
            progress.poll("overlay", 0.3 * static_cast<double>(plane) / static_cast<double>(n));
            overlay_plane(c_.on_plane[plane]);
        }
        return std::move(out_);
    }

  private:
    bool is_front(int facet) const { return key_sign(c_.facets[facet].key) > 0; }
    int solid_of(int facet) const { return c_.cell_solid[c_.facets[facet].cell]; }

    void overlay_plane(const std::vector<int>& facets) {
        const auto fronts =
            std::count_if(facets.begin(), facets.end(), [&](int f) { return is_front(f); });
        if (fronts == 0 || fronts == static_cast<std::ptrdiff_t>(facets.size())) return;
        Boxes boxes;
        for (const int f : facets) boxes.add(box_of(c_.points, c_.facets[f].polygon.corners));
        std::vector<std::pair<int, int>> pairs;
        for_touching_boxes(boxes.build(), [&](int i, int j) {
            int front = facets[i], back = facets[j];
            if (is_front(front) == is_front(back)) return;
            if (c_.between_solids_only && solid_of(front) == solid_of(back)) return;
            if (!is_front(front)) std::swap(front, back);
            pairs.emplace_back(front, back);
        });
        std::sort(pairs.begin(), pairs.end());
        for (const auto& [front, back] : pairs) intersect(front, back);
    }

    void intersect(int front, int back) {
        const Facet &f = c_.facets[front], &g = c_.facets[back];
        Polygon polygon = f.polygon;
        for (const int key : g.polygon.beyond)
            if (!clip(c_.points, polygon, f.key, key)) return;
        out_.push_back({front, back, std::move(polygon)});
    }

    Complex& c_;
    std::vector<Piece> out_;
};

class RimFinder {
  public:
    RimFinder(Complex& complex, const GridSolid& solid, const std::vector<int>& owners)
        : c_(complex), solid_(solid), owners_(owners) {
        for (const Triangle& t : solid.triangles)
            key_.push_back(c_.points.add_plane(
                plane_through(solid.points[t[0]], solid.points[t[1]], solid.points[t[2]])));
        c_.on_plane.resize(static_cast<std::size_t>(c_.points.planes()));
    }

    std::vector<Rim> run() {
        const EdgeTable edges = build_edges(solid_.triangles, solid_.solid);
        for (std::size_t e = 0; e < edges.edges.size(); ++e) {
            const auto sides = edges.of(e);
            if (sides.size() == 2 && owners_[sides[0] / 3] == owners_[sides[1] / 3]) continue;
            for (const int h : sides) {
                const auto goes_on = [&](int other) {
                    return other != h && key_[other / 3] == key_[h / 3];
                };
                out_.push_back({key_[h / 3], edges.edges[e].solid, tail_of(solid_.triangles, h),
                                head_of(solid_.triangles, h), owners_[h / 3],
                                std::any_of(sides.begin(), sides.end(), goes_on)});
            }
        }
        return std::move(out_);
    }

  private:
    Complex& c_;
    const GridSolid& solid_;
    const std::vector<int>& owners_;
    std::vector<int> key_;
    std::vector<Rim> out_;
};

class RimClipper {
  public:
    RimClipper(Complex& complex, const std::vector<Piece>& pieces, const std::vector<Rim>& rims)
        : c_(complex), pieces_(pieces) {
        const auto planes = static_cast<std::size_t>(c_.points.planes());
        std::vector<std::array<char, 2>> sides(planes);
        for (const Rim& r : rims) sides[plane_of(r.key)][key_sign(r.key) > 0] = 1;
        for (const auto& s : sides) out_.two_sided.push_back(s[0] && s[1]);
        out_.of_facet.resize(c_.facets.size());
        out_.of_piece.resize(pieces.size());
        rims_on_.resize(planes);
        for (const Rim& r : rims)
            if (r.coplanar || out_.two_sided[plane_of(r.key)])
                rims_on_[plane_of(r.key)].push_back(&r);
    }

    Slits run() {
        for (std::size_t f = 0; f < c_.facets.size(); ++f) {
            const Facet& facet = c_.facets[f];
            clip_to(facet.polygon, facet.key, out_.of_facet[f], [&](const Rim& r) {
                return r.coplanar && r.key == facet.key && r.solid == c_.cell_solid[facet.cell];
            });
        }
        for (std::size_t p = 0; p < pieces_.size(); ++p) {
            const int key = c_.facets[pieces_[p].front].key;
            if (out_.two_sided[plane_of(key)])
                clip_to(pieces_[p].polygon, key, out_.of_piece[p], [](const Rim&) { return true; });
        }
        return std::move(out_);
    }

  private:
    template <class Wanted>
    void clip_to(const Polygon& polygon, int key, std::vector<Segment>& out, Wanted wanted) {
        const std::vector<const Rim*>& rims = rims_on_[plane_of(key)];
        if (rims.empty()) return;
        const Box box = box_of(c_.points, polygon.corners);
        for (const Rim* rim : rims)
            if (wanted(*rim) && boxes_touch(box, box_of(c_.points, {rim->from, rim->to})))
                clip_edge(*rim, polygon, key, out);
        std::sort(out.begin(), out.end());
        out.erase(std::unique(out.begin(), out.end()), out.end());
    }

    // What of the rim lies strictly inside the polygon.
    void clip_edge(const Rim& rim, const Polygon& polygon, int key, std::vector<Segment>& out) {
        int a = std::min(rim.from, rim.to), b = std::max(rim.from, rim.to), line = -1;
        for (const int beyond : polygon.beyond) {
            const int sa = key_sign(beyond) * c_.points.side(a, plane_of(beyond));
            const int sb = key_sign(beyond) * c_.points.side(b, plane_of(beyond));
            if (sa >= 0 && sb >= 0) return;
            if (sa <= 0 && sb <= 0) continue;
            if (line < 0) line = line_of(rim);
            (sa > 0 ? a : b) = c_.points.meet(line, plane_of(beyond), plane_of(key), plane_of(key));
        }
        if (a != b) out.push_back({a, b});
    }

    int line_of(const Rim& rim) {
        const auto [low, high] = std::minmax(rim.from, rim.to);
        const auto [place, fresh] = lines_.try_emplace({low, high}, -1);
        if (fresh) place->second = c_.points.input_line(low, high);
        return place->second;
    }

    Complex& c_;
    const std::vector<Piece>& pieces_;
    std::vector<std::vector<const Rim*>> rims_on_;  // per plane
    std::map<std::pair<int, int>, int> lines_;
    Slits out_;
};

}  // namespace

std::vector<Piece> overlay(Complex& complex, Progress& progress) {
    return Overlay(complex).run(progress);
}

std::vector<Rim> find_rims(Complex& complex, const GridSolid& solid,
                           const std::vector<int>& owners) {
    return RimFinder(complex, solid, owners).run();
}

Slits clip_rims(Complex& complex, const std::vector<Piece>& pieces, const std::vector<Rim>& rims) {
    return RimClipper(complex, pieces, rims).run();
}

}  // namespace tetra::cells
