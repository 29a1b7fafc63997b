// SPDX-License-Identifier: LGPL-2.1-or-later
// The cells with one id per point and plane, each edge knowing the facet beyond it.
#include <algorithm>
#include <cmath>
#include <tuple>

#include "cell_tets_stages.h"
#include "tetra/errors.h"

namespace tetra::cells {
namespace {

class Filler {
  public:
    Filler(Complex& out, const Polyhedra& given, int solid)
        : out_(out), given_(given), solid_(solid) {
        for (std::size_t p = 0; p < given.points.size(); ++p)
            point_.push_back(given.point_source[p] >= 0 ? given.point_source[p]
                                                        : out.points.add_point(given.points[p]));
    }

    void fill() {
        for (std::size_t c = 0; c + 1 < given_.cell_offsets.size(); ++c) add_cell(c);
    }

  private:
    void add_cell(std::size_t c) {
        const int cell = static_cast<int>(out_.cell_solid.size());
        open_.clear();
        for (std::int64_t f = given_.cell_offsets[c]; f < given_.cell_offsets[c + 1]; ++f)
            add_facet(static_cast<std::size_t>(f), cell);
        out_.cell_solid.push_back(solid_);
        out_.first_facet.push_back(static_cast<int>(out_.facets.size()));
        pair_up();
    }

    void add_facet(std::size_t f, int cell) {
        const int key = out_.points.add_plane(given_.facet_planes[f]);
        const int id = static_cast<int>(out_.facets.size());
        Facet facet{cell, key, {}};
        for (std::int64_t i = given_.facet_offsets[f]; i < given_.facet_offsets[f + 1]; ++i) {
            const int p = point_[given_.facet_points[static_cast<std::size_t>(i)]];
            out_.points.set_on(p, plane_of(key));
            facet.polygon.corners.push_back(p);
        }
        const std::vector<int>& corners = facet.polygon.corners;
        facet.polygon.beyond.assign(corners.size(), -1);
        for (std::size_t i = 0; i < corners.size(); ++i) {
            const int a = corners[i], b = corners[(i + 1) % corners.size()];
            open_.emplace_back(std::min(a, b), std::max(a, b), id, static_cast<int>(i));
        }
        out_.on_plane.resize(static_cast<std::size_t>(out_.points.planes()));
        out_.on_plane[plane_of(key)].push_back(id);
        out_.facets.push_back(std::move(facet));
    }

    void pair_up() {
        std::sort(open_.begin(), open_.end());
        for (std::size_t i = 0; i + 1 < open_.size(); i += 2) {
            const auto& [a, b, f, k] = open_[i];
            const auto& [a2, b2, g, l] = open_[i + 1];
            if (a != a2 || b != b2) throw VerificationFailed("tetrahedra of cells: an open cell");
            out_.facets[f].polygon.beyond[k] = out_.facets[g].key;
            out_.facets[g].polygon.beyond[l] = out_.facets[f].key;
        }
    }

    Complex& out_;
    const Polyhedra& given_;
    int solid_;
    std::vector<int> point_;
    std::vector<std::tuple<int, int, int, int>> open_;  // edge, facet, place in its polygon
};

}  // namespace

Complex make_complex(const GridSolid& solid, const std::vector<Polyhedra>& cells,
                     const std::vector<int>& solid_ids) {
    Complex complex(solid.grid.bits);
    for (const Vec3i& p : solid.points) complex.points.add_input(p);
    for (std::size_t s = 0; s < cells.size(); ++s) Filler(complex, cells[s], solid_ids[s]).fill();
    return complex;
}

bool clip(PointTable& points, Polygon& polygon, int key_here, int key) {
    const std::size_t n = polygon.corners.size();
    std::vector<int> side(n);
    int outside = 0, inside = 0;
    for (std::size_t i = 0; i < n; ++i) {
        side[i] = key_sign(key) * points.side(polygon.corners[i], plane_of(key));
        outside += side[i] > 0;
        inside += side[i] < 0;
    }
    if (inside == 0) return false;
    if (outside == 0) return true;
    Polygon kept;
    const auto push = [&](int corner, int beyond) {
        kept.corners.push_back(corner);
        kept.beyond.push_back(beyond);
    };
    for (std::size_t i = 0; i < n; ++i) {
        const std::size_t j = (i + 1) % n;
        const int beyond = polygon.beyond[i];
        if (side[i] <= 0) push(polygon.corners[i], side[i] == 0 && side[j] > 0 ? key : beyond);
        if (side[i] * side[j] >= 0) continue;
        const int line = points.plane_line(plane_of(key_here), plane_of(beyond));
        const int crossing = points.meet(line, plane_of(key), plane_of(key_here), plane_of(beyond));
        push(crossing, side[i] < 0 ? key : beyond);
    }
    polygon = std::move(kept);
    return true;
}

Box box_of(const PointTable& points, const std::vector<int>& ids) {
    Box box{};
    for (std::size_t i = 0; i < ids.size(); ++i) {
        const Vec3d& p = points.approx(ids[i]);
        for (std::size_t k = 0; k < 3; ++k) {
            const auto low = static_cast<std::int64_t>(std::floor(p[k])) - 1;
            const auto high = static_cast<std::int64_t>(std::ceil(p[k])) + 1;
            box.low[k] = i ? std::min(box.low[k], low) : low;
            box.high[k] = i ? std::max(box.high[k], high) : high;
        }
    }
    return box;
}

}  // namespace tetra::cells
