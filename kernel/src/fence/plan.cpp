// SPDX-License-Identifier: LGPL-2.1-or-later
// Finds facets, sharp edges and lines of a solid.
#include "plan.h"

#include <algorithm>
#include <cstdlib>
#include <numeric>
#include <stdexcept>
#include <tuple>

#include "coplanar.h"

namespace tetra::fence {
namespace {

constexpr std::int64_t kLargestCoordinate = std::int64_t{1} << 26;

struct Side {  // one triangle's side, undirected
    int u, v, triangle;
};

// By u, v and triangle: one bucket for each u, which holds a handful.
std::vector<Side> sorted_sides(const FenceInput& input) {
    std::vector<int> next(input.points.size() + 1, 0);
    const auto for_each_side = [&](auto visit) {
        for (int t = 0; t < static_cast<int>(input.triangles.size()); ++t) {
            const Triangle& tri = at(input.triangles, t);
            for (int k = 0; k < 3; ++k) {
                const auto [u, v] = std::minmax(at(tri, k), at(tri, (k + 1) % 3));
                visit(Side{u, v, t});
            }
        }
    };
    for_each_side([&](const Side& s) { ++at(next, s.u + 1); });
    std::partial_sum(next.begin(), next.end(), next.begin());
    std::vector<Side> sides(3 * input.triangles.size());
    for_each_side([&](const Side& s) { at(sides, at(next, s.u)++) = s; });
    for (auto first = sides.begin(); first != sides.end();) {
        const auto last = sides.begin() + at(next, first->u);
        std::sort(first, last, [](const Side& s, const Side& t) {
            return s.v != t.v ? s.v < t.v : s.triangle < t.triangle;
        });
        first = last;
    }
    return sides;
}

class Union {
  public:
    explicit Union(int n) : parent_(static_cast<std::size_t>(n)) {
        std::iota(parent_.begin(), parent_.end(), 0);
    }
    int find(int i) {
        while (at(parent_, i) != i) i = at(parent_, i) = at(parent_, at(parent_, i));
        return i;
    }
    void join(int i, int j) {
        at(parent_, std::max(find(i), find(j))) = std::min(find(i), find(j));
    }

  private:
    std::vector<int> parent_;
};

template <class Visit>  // visit(first, last) of each run of sides on one edge
void for_each_edge(const std::vector<Side>& sides, Visit visit) {
    for (std::size_t i = 0; i < sides.size();) {
        std::size_t j = i + 1;
        while (j < sides.size() && sides[j].u == sides[i].u && sides[j].v == sides[i].v) ++j;
        visit(&sides[i], &sides[i] + (j - i));
        i = j;
    }
}

class PlanMaker {
  public:
    explicit PlanMaker(const FenceInput& input) : input_(input) { plan_.input = &input; }

    Plan make() {
        check_coordinates();
        sides_ = sorted_sides(input_);
        find_facets();
        find_edges();
        find_lines();
        find_vertical_facets_of_lines();
        find_points();
        make_surfaces();
        return std::move(plan_);
    }

  private:
    int owner(int t) const { return input_.owner.empty() ? 0 : at(input_.owner, t); }
    int triangle_count() const { return static_cast<int>(input_.triangles.size()); }

    void check_coordinates() const {
        for (const Vec3i& p : input_.points)
            for (const std::int64_t x : p)
                if (std::abs(x) > kLargestCoordinate)
                    throw std::out_of_range(
                        "fence_off: coordinates must not exceed 2^26; snap to "
                        "a coarser grid or shear less");
    }

    void find_facets() {
        Union sets(triangle_count());
        for_each_edge(sides_, [&](const Side* first, const Side* last) {
            if (last - first != 2) return;
            const int s = first->triangle, t = first[1].triangle;
            if (owner(s) == owner(t) &&
                coplanar(input_.points, at(input_.triangles, s), at(input_.triangles, t)))
                sets.join(s, t);
        });
        plan_.facet_of.resize(input_.triangles.size());
        for (int t = 0; t < triangle_count(); ++t) {
            const int root = sets.find(t);
            if (root == t) {
                const Triangle& tri = at(input_.triangles, t);
                const Plane plane =
                    plane_through(plan_.at(tri[0]), plan_.at(tri[1]), plan_.at(tri[2]));
                at(plan_.facet_of, t) = plan_.facet_count();
                plan_.facets.push_back({t, (plane.c > 0) - (plane.c < 0), plane});
            } else {
                at(plan_.facet_of, t) = at(plan_.facet_of, root);
            }
        }
        plan_.facet_triangles = group_by(plan_.facet_of, plan_.facet_count());
    }

    void find_edges() {
        for_each_edge(sides_, [&](const Side* first, const Side* last) {
            const bool flat = last - first == 2 && at(plan_.facet_of, first->triangle) ==
                                                       at(plan_.facet_of, first[1].triangle);
            if (flat) return;
            plan_.edges.push_back({first->u, first->v, -1});
            for (const Side* s = first; s < last; ++s)
                plan_.edge_facets.items.push_back(at(plan_.facet_of, s->triangle));
            plan_.edge_facets.offset.push_back(static_cast<int>(plan_.edge_facets.items.size()));
        });
    }

    // Directs the edge along its line and returns the line; gcd 0 marks a vertical edge.
    Line line_of(SharpEdge& e) const {
        std::int64_t dx = plan_.at(e.v)[0] - plan_.at(e.u)[0];
        std::int64_t dy = plan_.at(e.v)[1] - plan_.at(e.u)[1];
        const std::int64_t g = std::gcd(dx, dy);
        if (g == 0) {
            if (plan_.at(e.u)[2] > plan_.at(e.v)[2]) std::swap(e.u, e.v);
            return {};
        }
        const int axis = std::abs(dx) >= std::abs(dy) ? 0 : 1;
        if ((axis == 0 ? dx : dy) < 0) {
            std::swap(e.u, e.v);
            dx = -dx;
            dy = -dy;
        }
        dx /= g;
        dy /= g;
        const Vec3i& u = plan_.at(e.u);
        return {dx, dy, dx * u[1] - dy * u[0], axis};
    }

    void find_lines() {
        struct Entry {
            Line line;
            std::int64_t start;
            int edge;
        };
        std::vector<Entry> entries;
        for (int e = 0; e < static_cast<int>(plan_.edges.size()); ++e) {
            SharpEdge& edge = at(plan_.edges, e);
            const Line line = line_of(edge);
            if (line.dx == 0 && line.dy == 0) continue;
            entries.push_back({line, at(plan_.at(edge.u), line.axis), e});
        }
        const auto key = [](const Entry& e) { return std::tuple(e.line.dx, e.line.dy, e.line.c); };
        std::sort(entries.begin(), entries.end(), [&](const Entry& a, const Entry& b) {
            return std::tuple_cat(key(a), std::tuple(a.start, a.edge)) <
                   std::tuple_cat(key(b), std::tuple(b.start, b.edge));
        });
        for (std::size_t i = 0; i < entries.size(); ++i) {
            if (i == 0 || key(entries[i]) != key(entries[i - 1])) {
                if (i > 0) close_line();
                plan_.lines.push_back(entries[i].line);
            }
            at(plan_.edges, entries[i].edge).line = static_cast<int>(plan_.lines.size()) - 1;
            plan_.line_edges.items.push_back(entries[i].edge);
        }
        if (!entries.empty()) close_line();
    }

    void close_line() {
        plan_.line_edges.offset.push_back(static_cast<int>(plan_.line_edges.items.size()));
    }

    void find_vertical_facets_of_lines() {
        // Any rim of a vertical facet that is not vertical itself lies in the facet's line.
        std::vector<int> line(plan_.facets.size(), -1);
        for (int e = 0; e < static_cast<int>(plan_.edges.size()); ++e) {
            if (at(plan_.edges, e).line < 0) continue;
            for (const int f : plan_.edge_facets[e])
                if (at(plan_.facets, f).side == 0) at(line, f) = at(plan_.edges, e).line;
        }
        plan_.line_facets = group_by(line, static_cast<int>(plan_.lines.size()));
    }

    void find_points() {
        plan_.point_of.assign(input_.points.size(), -1);
        for (const Triangle& t : input_.triangles)
            for (const int v : t)
                if (at(plan_.point_of, v) < 0)
                    at(plan_.point_of, v) = plan_.points.vertex(plan_.at(v)[0], plan_.at(v)[1]);
        std::vector<int> facet(input_.points.size(), -1);
        for (int t = 0; t < triangle_count(); ++t)
            for (const int v : at(input_.triangles, t)) at(facet, v) = at(plan_.facet_of, t);
        for (const SharpEdge& e : plan_.edges) at(facet, e.u) = at(facet, e.v) = -1;
        for (int v = 0; v < static_cast<int>(facet.size()); ++v) {
            if (at(facet, v) < 0 || !plan_.kept(v)) continue;
            plan_.flat_points.push_back(v);
            plan_.flat_point_facet.push_back(at(facet, v));
        }
    }

    void make_surfaces() {
        plan_.surfaces.resize(plan_.facets.size() + plan_.edges.size());
        for (int f = 0; f < plan_.facet_count(); ++f) {
            const Facet& facet = at(plan_.facets, f);
            if (facet.side == 0) continue;
            at(plan_.surfaces, f) =
                facet_surface(facet.plane, plan_.at(at(input_.triangles, facet.triangle)[0]));
        }
        for (int e = 0; e < static_cast<int>(plan_.edges.size()); ++e) {
            const SharpEdge& edge = at(plan_.edges, e);
            if (edge.line < 0) continue;
            at(plan_.surfaces, plan_.edge_surface_id(e)) =
                edge_surface(plan_.at(edge.u), plan_.at(edge.v));
        }
    }

    const FenceInput& input_;
    Plan plan_;
    std::vector<Side> sides_;
};

}  // namespace

Lists group_by(const std::vector<int>& key, int groups) {
    Lists lists;
    lists.offset.assign(static_cast<std::size_t>(groups) + 1, 0);
    for (const int k : key)
        if (k >= 0) ++at(lists.offset, k + 1);
    std::partial_sum(lists.offset.begin(), lists.offset.end(), lists.offset.begin());
    lists.items.resize(static_cast<std::size_t>(lists.offset.back()));
    std::vector<int> next(lists.offset.begin(), lists.offset.end() - 1);
    for (int i = 0; i < static_cast<int>(key.size()); ++i)
        if (at(key, i) >= 0) at(lists.items, at(next, at(key, i))++) = i;
    return lists;
}

Plan make_plan(const FenceInput& input) { return PlanMaker(input).make(); }

}  // namespace tetra::fence
