// SPDX-License-Identifier: LGPL-2.1-or-later
// Cuts runs at their splits, gathers them by cell and triangulates.
#include "bases.h"

#include <algorithm>
#include <tuple>

#include "tetra/errors.h"
#include "tetra/polygon/delaunay.h"
#include "tetra/polygon/triangulate.h"

namespace tetra::fence {
namespace {

struct KeyedEdge {
    int floor, ceiling;
    BaseEdge edge;
    auto key() const { return std::tuple(floor, ceiling, edge.from, edge.to); }
};

std::vector<KeyedEdge> cut_runs(const Walls& walls) {
    std::vector<KeyedEdge> list;
    for (int r = 0; r < static_cast<int>(walls.runs.size()); ++r) {
        const Run& run = at(walls.runs, r);
        int last = -1;
        for (const int w : walls.run_points[r]) {
            if (!at(walls.points, w).active) continue;
            if (last >= 0) {
                int from = at(walls.points, last).point, to = at(walls.points, w).point;
                if (!run.left) std::swap(from, to);
                list.push_back(
                    {run.floor, run.ceiling, {from, to, r, at(walls.points, last).chain}});
            }
            last = w;
        }
    }
    std::sort(list.begin(), list.end(),
              [](const KeyedEdge& a, const KeyedEdge& b) { return a.key() < b.key(); });
    return list;
}

}  // namespace

Bases collect_bases(const Walls& walls, std::vector<InnerPoint> inner) {
    const std::vector<KeyedEdge> list = cut_runs(walls);
    const auto inner_key = [](const InnerPoint& i) {
        return std::tuple(i.floor, i.ceiling, i.point);
    };
    std::sort(inner.begin(), inner.end(), [&](const InnerPoint& a, const InnerPoint& b) {
        return inner_key(a) < inner_key(b);
    });
    Bases out;
    out.edges.reserve(list.size());
    for (const KeyedEdge& e : list) {
        const auto n = static_cast<int>(out.edges.size());
        if (out.bases.empty() || out.bases.back().floor != e.floor ||
            out.bases.back().ceiling != e.ceiling) {
            const auto first =
                std::ranges::lower_bound(inner, std::tuple(e.floor, e.ceiling, -1), {}, inner_key);
            out.bases.push_back({e.floor, e.ceiling, n, n, static_cast<int>(out.inner.size()), 0});
            for (auto i = first; i != inner.end() && i->floor == e.floor && i->ceiling == e.ceiling;
                 ++i)
                out.inner.push_back(i->point);
            out.bases.back().inner_last = static_cast<int>(out.inner.size());
        }
        out.edges.push_back(e.edge);
        out.bases.back().edge_last = n + 1;
    }
    return out;
}

std::vector<PlanarTriangle> triangulate_base(const Plan& plan, const Bases& bases,
                                             const Base& base) {
    std::vector<DirectedEdge> boundary;
    for (int e = base.edge_first; e < base.edge_last; ++e)
        boundary.push_back({at(bases.edges, e).from, at(bases.edges, e).to});
    if (boundary.size() == 3 && base.inner_first == base.inner_last) {
        const bool second = boundary[1].from == boundary[0].to;
        return {{boundary[0].from, boundary[0].to, boundary[second ? 1 : 2].to}};
    }
    try {
        const std::span<const PointId> inner(bases.inner.data() + base.inner_first,
                                             bases.inner.data() + base.inner_last);
        return flip_towards_delaunay(triangulate_region(boundary, plan.points, inner), {},
                                     plan.points, [&](PointId i) {
                                         return std::array{plan.points[i].x, plan.points[i].y};
                                     });
    } catch (const InvalidRegion& error) {
        throw InvalidSolid(
            {{"self_crossing",
              {},
              {at(plan.facets, base.floor).triangle, at(plan.facets, base.ceiling).triangle},
              std::string("the space between two facets is bounded by no closed fence (") +
                  error.what() + "): the surface crosses or touches itself near them"}});
    }
}

}  // namespace tetra::fence
