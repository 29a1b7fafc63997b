// SPDX-License-Identifier: LGPL-2.1-or-later
// Walks up the three vertical lines of each column in an order that its walls share.
#include "columns.h"

#include <algorithm>
#include <cassert>
#include <optional>

#include "tetra/errors.h"

namespace tetra::fence {
namespace {

// One vertical line of a column: marks low .. high, as ids of the result.
struct Corner {
    int point, low, high;
    int segments() const { return high - low; }
};

class Builder {
  public:
    Builder(const Plan& plan, const Walls& walls, const Joints& joints, const Bases& bases,
            const ConePointFinder& find_cone_point)
        : plan_(plan),
          walls_(walls),
          joints_(joints),
          bases_(bases),
          find_cone_point_(find_cone_point) {}

    Columns run(Progress& progress) {
        const auto n = static_cast<double>(bases_.bases.size());
        for (const Base& base : bases_.bases) {
            progress.poll("columns", 0.7 + 0.25 * static_cast<double>(done_++) / n);
            build_base(base);
        }
        return std::move(out_);
    }

  private:
    void build_base(const Base& base) {
        base_ = &base;
        const std::vector<PlanarTriangle> triangles = triangulate_base(plan_, bases_, base);
        const int failed = fill_base(triangles);
        if (failed < 0) return;
        for (std::size_t k = 0; k < 3; ++k)
            if (const auto other = flipped(triangles, failed, k); other && fill_base(*other) < 0)
                return;
        throw VerificationFailed(
            "a column of the fence-off is too thin to hold a point; try another direction or "
            "a coarser grid (near triangle " +
            std::to_string(at(plan_.facets, base.floor).triangle) + ")");
    }

    // The first triangle whose column can't be filled, or -1 when all are.
    int fill_base(const std::vector<PlanarTriangle>& triangles) {
        const Sizes before = sizes();
        for (std::size_t i = 0; i < triangles.size(); ++i) {
            const PlanarTriangle& t = triangles[i];
            ++out_.base_triangles;
            for (std::size_t k = 0; k < 3; ++k) {
                corner_[k] = {t[k], joints_.mark_of(t[k], base_->floor),
                              joints_.mark_of(t[k], base_->ceiling)};
                edge_[k] = edge_between(t[k], t[(k + 1) % 3]);
            }
            if (build_column()) continue;
            go_back_to(before);
            return static_cast<int>(i);
        }
        return -1;
    }

    // With the edge from corner k of triangle t exchanged, if it is an inner edge of a strictly
    // convex quadrilateral.
    std::optional<std::vector<PlanarTriangle>> flipped(std::vector<PlanarTriangle> triangles, int t,
                                                       std::size_t k) const {
        PlanarTriangle& one = at(triangles, t);
        const int a = one[k], b = one[(k + 1) % 3], c = one[(k + 2) % 3];
        for (PlanarTriangle& other : triangles)
            for (std::size_t i = 0; i < 3; ++i) {
                if (other[i] != b || other[(i + 1) % 3] != a) continue;
                const int d = other[(i + 2) % 3];
                if (edge_between(a, b) >= 0 || edge_between(b, a) >= 0 ||
                    plan_.points.orient(c, a, d) <= 0 || plan_.points.orient(d, b, c) <= 0)
                    return std::nullopt;
                one = {c, a, d};
                other = {c, d, b};
                return triangles;
            }
        return std::nullopt;
    }

    struct Sizes {
        std::size_t tets, cone_points, skin, walls;
        int base_triangles, cyclic;
    };
    Sizes sizes() const {
        return {out_.tets.size(),  out_.cone_points.size(), out_.skin.size(),
                out_.walls.size(), out_.base_triangles,     out_.cyclic};
    }
    void go_back_to(const Sizes& s) {
        out_.tets.resize(s.tets);
        out_.cone_points.resize(s.cone_points);
        out_.skin.resize(s.skin);
        out_.skin_facet.resize(s.skin);
        out_.walls.resize(s.walls);
        out_.base_triangles = s.base_triangles;
        out_.cyclic = s.cyclic;
    }

    // The base edge from -> to, or -1 for a diagonal.
    int edge_between(int from, int to) const {
        const auto first = bases_.edges.begin() + base_->edge_first;
        const auto last = bases_.edges.begin() + base_->edge_last;
        const auto place = std::lower_bound(
            first, last, std::pair(from, to),
            [](const BaseEdge& e, auto key) { return std::pair(e.from, e.to) < key; });
        if (place == last || place->from != from || place->to != to) return -1;
        return static_cast<int>(place - bases_.edges.begin());
    }

    // Rule R10: chain edges of wall k (corner k to k+1) at or below a mark of corner c.
    int slab(std::size_t k, std::size_t c, int mark) const {
        const std::vector<int>& chain = chain_marks_[k][c == k ? 0 : 1];
        return static_cast<int>(std::upper_bound(chain.begin(), chain.end(), mark) - chain.begin());
    }

    void find_chain_marks() {
        for (std::size_t k = 0; k < 3; ++k) {
            for (std::vector<int>& marks : chain_marks_[k]) marks.clear();
            if (edge_[k] < 0) continue;
            const int chain = at(bases_.edges, edge_[k]).chain;
            if (chain == 0) continue;
            for (const int e : walls_.chains[chain])
                for (std::size_t end = 0; end < 2; ++end)
                    chain_marks_[k][end].push_back(
                        joints_.mark_of(corner_[(k + end) % 3].point, plan_.edge_surface_id(e)));
        }
    }

    // On wall k: does the segment above mark i of corner s come before that above j of corner t?
    bool precedes(std::size_t k, std::size_t s, int i, std::size_t t, int j) const {
        const int slab_s = slab(k, s, i), slab_t = slab(k, t, j);
        if (slab_s != slab_t) return slab_s < slab_t;
        const double mid_s = middle(i), mid_t = middle(j);
        if (mid_s != mid_t) return mid_s < mid_t;
        return corner_[s].point < corner_[t].point;
    }

    double middle(int mark) const {
        return at(joints_.marks, mark).z + at(joints_.marks, mark + 1).z;
    }

    // Is the next segment of corner c first in both its walls?
    bool may_advance(std::size_t c) const {
        if (now_[c] == corner_[c].high) return false;
        for (const std::size_t d : {(c + 1) % 3, (c + 2) % 3}) {
            if (now_[d] == corner_[d].high) continue;
            const std::size_t wall = d == (c + 1) % 3 ? c : d;
            if (!precedes(wall, c, now_[c], d, now_[d])) return false;
        }
        return true;
    }

    // False when it needs a cone point that can't be found.
    bool build_column() {
        find_chain_marks();
        const std::size_t tets_before = out_.tets.size();
        for (std::size_t c = 0; c < 3; ++c) now_[c] = corner_[c].low;
        while (!finished()) {
            std::size_t c = 0;
            while (c < 3 && !may_advance(c)) ++c;
            if (c == 3) {
                out_.tets.resize(tets_before);
                return build_cone();
            }
            out_.tets.push_back({now_[0], now_[1], now_[2], now_[c] + 1});
            ++now_[c];
        }
        add_floor_and_ceiling();
        for (std::size_t k = 0; k < 3; ++k)
            if (edge_[k] >= 0)
                for_each_wall_triangle(k, [&](const std::array<int, 3>& t) {
                    out_.walls.push_back({t, edge_[k]});
                });
        return true;
    }

    bool finished() const {
        return now_[0] == corner_[0].high && now_[1] == corner_[1].high &&
               now_[2] == corner_[2].high;
    }

    Triangle floor_triangle() const { return {corner_[0].low, corner_[2].low, corner_[1].low}; }
    Triangle ceiling_triangle() const {
        return {corner_[0].high, corner_[1].high, corner_[2].high};
    }

    void add_floor_and_ceiling() {
        out_.skin.push_back(floor_triangle());
        out_.skin_facet.push_back(base_->floor);
        out_.skin.push_back(ceiling_triangle());
        out_.skin_facet.push_back(base_->ceiling);
    }

    // Outward triangles of wall k in the order of its segments.
    template <class Visit>
    void for_each_wall_triangle(std::size_t k, Visit visit) const {
        const std::size_t l = (k + 1) % 3;
        int i = corner_[k].low, j = corner_[l].low;
        while (i < corner_[k].high || j < corner_[l].high) {
            const bool first =
                j == corner_[l].high || (i < corner_[k].high && precedes(k, k, i, l, j));
            visit(std::array{i, j, first ? i + 1 : j + 1});
            ++(first ? i : j);
        }
    }

    // Rule R11: the column is convex, any point inside sees all of its boundary.
    bool build_cone() {
        ++out_.cyclic;
        const std::array points{corner_[0].point, corner_[1].point, corner_[2].point};
        const std::optional<HPoint> inside =
            find_cone_point_(plan_, points, base_->floor, base_->ceiling);
        if (!inside) return false;
        const int apex = static_cast<int>(joints_.marks.size() + out_.cone_points.size());
        out_.cone_points.push_back(*inside);
        const auto add = [&](const std::array<int, 3>& t) {
            out_.tets.push_back({t[0], t[2], t[1], apex});
        };
        add(floor_triangle());
        add(ceiling_triangle());
        add_floor_and_ceiling();
        for (std::size_t k = 0; k < 3; ++k)
            for_each_wall_triangle(k, [&](const std::array<int, 3>& t) {
                add(t);
                if (edge_[k] >= 0) out_.walls.push_back({t, edge_[k]});
            });
        return true;
    }

    const Plan& plan_;
    const Walls& walls_;
    const Joints& joints_;
    const Bases& bases_;
    const ConePointFinder& find_cone_point_;
    Columns out_;
    std::size_t done_ = 0;

    const Base* base_ = nullptr;
    std::array<Corner, 3> corner_{};
    std::array<int, 3> edge_{}, now_{};
    std::array<std::array<std::vector<int>, 2>, 3> chain_marks_;  // per wall, at both ends
};

}  // namespace

Columns build_columns(const Plan& plan, const Walls& walls, const Joints& joints,
                      const Bases& bases, Progress& progress,
                      const ConePointFinder& find_cone_point) {
    return Builder(plan, walls, joints, bases, find_cone_point).run(progress);
}

}  // namespace tetra::fence
