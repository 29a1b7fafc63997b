// SPDX-License-Identifier: LGPL-2.1-or-later
// Each solid is laid on z for its fences, its cells are laid back and merged.
#include "tetra/assemble/cells_of_fences.h"

#include <algorithm>
#include <cmath>
#include <exception>
#include <optional>

#include "tetra/fence/cells_from_fences.h"
#include "tetra/notch/merge_polyhedra.h"
#include "tetrahedralize_solid.h"

namespace tetra {
namespace {

// Directions of much more walls than the best one hardly catch up by merging.
constexpr std::size_t kFrames = 3;
constexpr double kCostTried = 1.35;

// Walls per cell before merging, and what merging leaves of cells at best (seen: 0.4).
constexpr double kWallsPerCell = 3.3, kLeftByMerging = 0.4;

struct Framed {
    GridSolid solid;
    std::vector<FenceDirection> frames;  // worth trying, best first
};

// The same plane before the map: n' . M p = (M^T n') . p, primitive as before since det M = 1.
Plane plane_from_frame(const FenceDirection& frame, const Plane& plane) {
    const auto component = [&](std::size_t k) {
        return frame.matrix[0][k] * plane.a + frame.matrix[1][k] * plane.b +
               frame.matrix[2][k] * plane.c;
    };
    return {component(0), component(1), component(2), plane.d};
}

Polyhedra polyhedra_of(const GridSolid& solid, const FenceDirection& frame, Progress& progress) {
    FenceInput input;
    input.points = to_frame(frame, solid.points);
    input.triangles = solid.triangles;
    input.owner.assign(solid.triangles.size(), 0);
    FenceCells fenced = cells_from_fences(input, progress);
    Polyhedra result;
    for (const HPoint& p : fenced.points) result.points.push_back(from_frame(frame, p));
    for (const Plane& p : fenced.facet_planes)
        result.facet_planes.push_back(plane_from_frame(frame, p));
    result.point_source = std::move(fenced.point_source);
    result.facet_offsets = std::move(fenced.facet_offsets);
    result.facet_points = std::move(fenced.facet_points);
    result.cell_offsets = std::move(fenced.cell_offsets);
    return result;
}

void append_offsets(std::vector<std::int64_t>& all, const std::vector<std::int64_t>& more) {
    const std::int64_t base = all.back();
    for (std::size_t i = 1; i < more.size(); ++i) all.push_back(base + more[i]);
}

template <class T>
void append_all(std::vector<T>& all, const std::vector<T>& more) {
    all.insert(all.end(), more.begin(), more.end());
}

void append(ConvexCells& all, const ConvexCells& more) {
    const int base = static_cast<int>(all.points.size());
    append_all(all.points, more.points);
    append_all(all.point_source, more.point_source);
    append_all(all.exact, more.exact);
    append_offsets(all.facet_offsets, more.facet_offsets);
    for (const int v : more.facet_vertices) all.facet_vertices.push_back(base + v);
    append_all(all.facet_source, more.facet_source);
    append_offsets(all.cell_offsets, more.cell_offsets);
    append_all(all.cell_solid, more.cell_solid);
    all.stats.notches += more.stats.notches;
    all.stats.raw_cells += more.stats.raw_cells;
    all.stats.volume += more.stats.volume;
    all.stats.solid_volume += more.stats.solid_volume;
}

Framed choose(GridSolid&& solid, bool in_haste, Progress& progress) {
    std::vector<DirectionTrial> trials;
    const std::vector<int> owners(solid.triangles.size(), 0);
    Framed result{std::move(solid), {}};
    result.frames = choose_frames(result.solid, owners, {}, HUGE_VAL, trials, progress);
    const double most = kCostTried * result.frames.front().cost;
    if (in_haste)
        std::erase_if(result.frames, [&](const FenceDirection& f) { return f.cost > most; });
    if (result.frames.size() > kFrames) result.frames.resize(kFrames);
    return result;
}

void add_solid(const Framed& framed, const std::vector<Vec3d>& vertices, bool merge,
               Progress& progress, FencedCells& result) {
    const GridSolid& solid = framed.solid;
    std::optional<ConvexCells> best;
    std::string direction;
    std::exception_ptr trouble;
    for (const FenceDirection& frame : framed.frames) {
        const auto attempt = [&] {
            const Polyhedra polyhedra = polyhedra_of(solid, frame, progress);
            ConvexCells cells = merge_polyhedra(solid, vertices, polyhedra, merge, progress);
            if (best && best->cell_solid.size() <= cells.cell_solid.size()) return;
            best = std::move(cells);
            direction = frame.name;
        };
        try {
            attempt();
        } catch (const VerificationFailed&) {
            trouble = std::current_exception();
        } catch (const InvalidSolid&) {
            trouble = std::current_exception();
        }
    }
    if (!best) std::rethrow_exception(trouble);
    append(result.cells, *best);
    result.directions.push_back(direction);
}

}  // namespace

std::optional<FencedCells> cells_of_fences(const GridSolid& solid,
                                           const std::vector<Vec3d>& vertices, bool merge,
                                           std::optional<std::size_t> beat, Progress& progress) {
    std::vector<int> ids = solid.solid;
    std::sort(ids.begin(), ids.end());
    ids.erase(std::unique(ids.begin(), ids.end()), ids.end());
    std::vector<Framed> framed;
    double walls = 0;
    for (const int id : ids) {
        framed.push_back(choose(solid_in_order(solid, id), beat.has_value(), progress));
        walls += framed.back().frames.front().cost;
    }
    if (beat && walls / kWallsPerCell * kLeftByMerging > static_cast<double>(*beat))
        return std::nullopt;
    FencedCells result;
    for (const Framed& one : framed) add_solid(one, vertices, merge, progress, result);
    return result;
}

}  // namespace tetra
