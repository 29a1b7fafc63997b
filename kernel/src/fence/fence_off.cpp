// SPDX-License-Identifier: LGPL-2.1-or-later
// The stages of the fence-off, solid by solid, and their result as an exact mesh.
#include "tetra/fence/fence_off.h"

#include <algorithm>

#include "skin_area.h"
#include "solids.h"
#include "wall_skin.h"

namespace tetra {
namespace {

using fence::at;

// Appends the decomposition of one solid; `triangles` are its triangles' ids in the whole input.
class Appender {
  public:
    Appender(FenceResult& result, std::vector<int>& point_of_input)
        : result_(result), point_of_input_(point_of_input) {}

    void append(const fence::Plan& plan, const fence::Joints& joints, const fence::Columns& columns,
                const std::vector<int>& triangles, int solid) {
        add_marks(plan, joints, columns, triangles);
        ExactMesh& mesh = result_.mesh;
        for (const auto& t : columns.tets) {
            mesh.tets.push_back({id(t[0]), id(t[1]), id(t[2]), id(t[3])});
            mesh.tet_solid.push_back(solid);
        }
        for (std::size_t i = 0; i < columns.skin.size(); ++i) {
            const Triangle& t = columns.skin[i];
            mesh.skin.push_back({id(t[0]), id(t[1]), id(t[2])});
            const int facet = columns.skin_facet[i];
            mesh.skin_source.push_back(at(triangles, at(plan.facets, facet).triangle));
        }
    }

  private:
    int id(int mark) const { return at(id_, mark); }

    int new_point(const HPoint& place, const Carrier& carrier, int source) {
        result_.mesh.points.push_back(place);
        result_.mesh.carriers.push_back(carrier);
        result_.point_source.push_back(source);
        return static_cast<int>(result_.mesh.points.size()) - 1;
    }

    // Marks that no tetrahedron uses are left out.
    void add_marks(const fence::Plan& plan, const fence::Joints& joints,
                   const fence::Columns& columns, const std::vector<int>& triangles) {
        const auto marks = static_cast<int>(joints.marks.size());
        id_.assign(static_cast<std::size_t>(marks) + columns.cone_points.size(), -1);
        for (const auto& t : columns.tets)
            for (const int m : t) at(id_, m) = 0;
        for (int m = 0; m < static_cast<int>(id_.size()); ++m) {
            if (id(m) < 0) continue;
            if (m >= marks) {
                at(id_, m) = new_point(at(columns.cone_points, m - marks), {}, -1);
                continue;
            }
            const fence::Mark& mark = at(joints.marks, m);
            Carrier carrier = mark.carrier;
            if (carrier.kind == CarrierKind::vertex) {
                int& known = at(point_of_input_, carrier.first);
                if (known < 0)
                    known = new_point(fence::place_of(plan, mark), carrier, carrier.first);
                at(id_, m) = known;
                continue;
            }
            if (carrier.kind == CarrierKind::facet)
                carrier.first = at(triangles, fence::triangle_under(plan, mark, carrier.first));
            at(id_, m) = new_point(fence::place_of(plan, mark), carrier, -1);
        }
    }

    FenceResult& result_;
    std::vector<int>& point_of_input_;
    std::vector<int> id_;
};

void add_counts(FenceCounts& counts, const fence::Plan& plan, const fence::Joints& joints,
                const fence::Bases& bases, const fence::Columns& columns) {
    counts.facets += plan.facet_count();
    counts.sharp_edges += static_cast<int>(plan.edges.size());
    counts.lines += static_cast<int>(plan.lines.size());
    counts.cells += static_cast<int>(bases.bases.size());
    counts.wall_sides += static_cast<int>(bases.edges.size());
    counts.base_triangles += columns.base_triangles;
    counts.cyclic_columns += columns.cyclic;
    counts.propagated += joints.propagated;
}

void fence_one_solid(const fence::SolidPart& part, std::vector<int>& point_of_input,
                     FenceResult& result, Progress& progress) {
    fence::Plan plan = fence::make_plan(part.input);
    fence::Walls walls = fence::sweep_walls(plan, progress);
    std::vector<fence::InnerPoint> inner = fence::locate_flat_points(plan, walls);
    const fence::Joints joints = fence::join_walls(plan, walls, inner, progress);
    const fence::Bases bases = fence::collect_bases(walls, std::move(inner));
    fence::Columns columns = fence::build_columns(plan, walls, joints, bases, progress);
    fence::add_wall_skin(plan, walls, joints, bases, columns, progress);
    fence::check_skin_area(plan, joints, columns);
    Appender(result, point_of_input).append(plan, joints, columns, part.triangles, part.solid);
    add_counts(result.counts, plan, joints, bases, columns);
}

}  // namespace

FenceResult fence_off(const FenceInput& input, Progress& progress) {
    FenceResult result;
    std::vector<int> point_of_input(input.points.size(), -1);
    fence::for_each_solid(input, [&](const fence::SolidPart& part) {
        fence_one_solid(part, point_of_input, result, progress);
    });
    result.counts.steiner_points =
        static_cast<int>(std::count(result.point_source.begin(), result.point_source.end(), -1));
    return result;
}

}  // namespace tetra
