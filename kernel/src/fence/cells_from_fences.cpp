// SPDX-License-Identifier: LGPL-2.1-or-later
// Lifts convex base polygons to cells between one floor and one ceiling.
#include "tetra/fence/cells_from_fences.h"

#include <algorithm>
#include <tuple>

#include "convex_base.h"
#include "solids.h"

namespace tetra {
namespace {

using namespace fence;

// Points of the cells: one id per place.
class Places {
  public:
    Places(const Plan& plan, std::vector<int>& point_of_input, FenceCells& out)
        : plan_(plan), point_of_input_(point_of_input), out_(out) {
        vertices_at_ = group_by(plan.point_of, plan.points.size());
    }

    int over(int point, int surface) {
        if (static_cast<std::size_t>(point) >= known_.size())
            known_.resize(static_cast<std::size_t>(plan_.points.size()));
        const PlanPoint& p = plan_.points[point];
        const Surface& s = at(plan_.surfaces, surface);
        for (const auto& [other, id] : at(known_, point))
            if (other == surface || compare_heights(s, at(plan_.surfaces, other), p) == 0)
                return id;
        const int id = new_point(point, surface);
        at(known_, point).emplace_back(surface, id);
        return id;
    }

  private:
    int new_point(int point, int surface) {
        const PlanPoint& p = plan_.points[point];
        const Surface& s = at(plan_.surfaces, surface);
        if (point < static_cast<int>(vertices_at_.offset.size()) - 1)
            for (const int v : vertices_at_[point]) {
                if (compare_heights(s, vertex_surface(plan_.at(v)), p) != 0) continue;
                int& known = at(point_of_input_, v);
                if (known < 0) known = append(hpoint(plan_.at(v)), v);
                return known;
            }
        const WideInt<1> c(s.plane.c);
        return append({multiply<4>(WideInt<2>(p.X), c), multiply<4>(WideInt<2>(p.Y), c),
                       height_numerator(s, p), multiply<4>(WideInt<1>(p.w), c)},
                      -1);
    }

    int append(const HPoint& place, int source) {
        out_.points.push_back(place);
        out_.point_source.push_back(source);
        return static_cast<int>(out_.points.size()) - 1;
    }

    const Plan& plan_;
    std::vector<int>& point_of_input_;
    FenceCells& out_;
    Lists vertices_at_;
    std::vector<std::vector<std::pair<int, int>>> known_;  // per plan point: surface, id
};

class CellMaker {
  public:
    CellMaker(const SolidPart& part, std::vector<int>& point_of_input, FenceCells& out)
        : part_(part), point_of_input_(point_of_input), out_(out) {}

    void run(Progress& progress) {
        plan_ = make_plan(part_.input);
        walls_ = sweep_walls(plan_, progress);
        Places places(plan_, point_of_input_, out_);
        places_ = &places;
        const std::vector<int> runs = runs_by_cell();
        for (std::size_t i = 0; i < runs.size();) {
            progress.poll("cells",
                          0.5 + 0.5 * static_cast<double>(i) / static_cast<double>(runs.size()));
            std::size_t j = i + 1;
            while (j < runs.size() && cell_of(runs[j]) == cell_of(runs[i])) ++j;
            const Run run = at(walls_.runs, runs[i]);
            ++out_.bases;
            for (const ConvexPolygon& polygon :
                 convex_polygons(plan_, region({runs.data() + i, j - i}), out_.chords))
                add_cell(run.floor, run.ceiling, polygon);
            i = j;
        }
    }

  private:
    std::pair<int, int> cell_of(int run) const {
        return {at(walls_.runs, run).floor, at(walls_.runs, run).ceiling};
    }

    std::vector<int> runs_by_cell() const {
        std::vector<int> runs(walls_.runs.size());
        for (std::size_t i = 0; i < runs.size(); ++i) runs[i] = static_cast<int>(i);
        std::stable_sort(runs.begin(), runs.end(),
                         [&](int a, int b) { return cell_of(a) < cell_of(b); });
        return runs;
    }

    // Runs, split where another run of the same cell ends on them.
    std::vector<LineEdge> region(std::span<const int> runs) const {
        std::vector<int> ends;
        for (const int r : runs) {
            ends.push_back(at(walls_.points, walls_.run_points[r].front()).point);
            ends.push_back(at(walls_.points, walls_.run_points[r].back()).point);
        }
        std::sort(ends.begin(), ends.end());
        std::vector<LineEdge> edges;
        for (const int r : runs) {
            const Run& run = at(walls_.runs, r);
            int last = -1;
            for (const int w : walls_.run_points[r]) {
                const int p = at(walls_.points, w).point;
                if (!std::binary_search(ends.begin(), ends.end(), p)) continue;
                if (last >= 0)
                    edges.push_back(run.left ? LineEdge{last, p, run.line, true}
                                             : LineEdge{p, last, run.line, false});
                last = p;
            }
        }
        return edges;
    }

    void add_cell(int floor, int ceiling, const ConvexPolygon& polygon) {
        low_.clear();
        high_.clear();
        for (const LineEdge& e : polygon) {
            low_.push_back(places_->over(e.from, floor));
            high_.push_back(places_->over(e.from, ceiling));
        }
        add_facet({low_.rbegin(), low_.rend()}, at(plan_.facets, floor).plane, floor);
        add_facet(high_, at(plan_.facets, ceiling).plane, ceiling);
        for (std::size_t k = 0; k < polygon.size(); ++k) {
            const std::size_t l = (k + 1) % polygon.size();
            std::vector<int> wall{low_[k], low_[l]};
            if (high_[l] != low_[l]) wall.push_back(high_[l]);
            if (high_[k] != low_[k]) wall.push_back(high_[k]);
            if (wall.size() < 3) continue;
            const Plane plane = wall_plane(polygon[k]);
            add_facet(wall, plane, facet_in(polygon[k].line, plane));
        }
        out_.cell_offsets.push_back(static_cast<std::int64_t>(out_.facet_source.size()));
        out_.cell_solid.push_back(part_.solid);
    }

    void add_facet(const std::vector<int>& points, const Plane& plane, int facet) {
        out_.facet_points.insert(out_.facet_points.end(), points.begin(), points.end());
        out_.facet_offsets.push_back(static_cast<std::int64_t>(out_.facet_points.size()));
        out_.facet_planes.push_back(plane);
        out_.facet_source.push_back(
            facet < 0 ? -1 : at(part_.triangles, at(plan_.facets, facet).triangle));
    }

    // Outward is right of the edge.
    Plane wall_plane(const LineEdge& e) const {
        const Line& line = at(plan_.lines, e.line);
        const Plane right{line.dy, -line.dx, 0, line.c};
        return e.forward ? right : opposite(right);
    }

    int facet_in(int line, const Plane& plane) const {
        for (const int f : plan_.line_facets[line])
            if (at(plan_.facets, f).plane == plane) return f;
        return -1;
    }

    const SolidPart& part_;
    std::vector<int>& point_of_input_;
    FenceCells& out_;
    Plan plan_;
    Walls walls_;
    Places* places_ = nullptr;
    std::vector<int> low_, high_;
};

}  // namespace

FenceCells cells_from_fences(const FenceInput& input, Progress& progress) {
    FenceCells cells;
    std::vector<int> point_of_input(input.points.size(), -1);
    for_each_solid(input, [&](const SolidPart& part) {
        CellMaker(part, point_of_input, cells).run(progress);
    });
    return cells;
}

}  // namespace tetra
