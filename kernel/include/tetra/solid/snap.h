// SPDX-License-Identifier: LGPL-2.1-or-later
// Puts a caller's closed surface on an integer grid, repairing the triangles that turn flat there.
#pragma once

#include <span>
#include <vector>

#include "tetra/errors.h"
#include "tetra/solid/grid_solid.h"

namespace tetra {

struct SnapReport {
    int merged_points = 0;      // used vertices that share the grid place of an earlier one
    int dropped_triangles = 0;  // collapsed to an edge or folded onto their opposite
    int flipped_edges = 0;      // long edges of flat triangles exchanged with their neighbour's
};

// The caller's surface; `triangle_source` and `solid` may be empty (identity, all 0).
// Triangles of different `solid` never exchange edges.
struct SurfaceView {
    std::span<const Vec3d> vertices;
    std::span<const Triangle> triangles;
    std::span<const int> triangle_source;
    std::span<const int> solid;
};

// Snaps the used vertices, merges equal grid points and drops triangles with two equal corners.
// Flat triangles with three distinct corners stay. Points are ordered by `point_source`, the
// lowest vertex of each place. Vertices must be finite. O(n log n).
GridSolid merge_on_grid(const SurfaceView& surface, int bits, SnapReport* report = nullptr);

// Removes flat triangles by exchanging their long edge with the neighbour across it, which keeps
// every point, the surface as a set, its volume and its closedness; then cancels opposite
// coincident triangles that share an edge with nobody else (walls and gaps of no thickness).
// The surface must be closed and its points distinct: throws InvalidSolid (degenerate_triangle)
// when a long edge has no neighbour. O(n log n) for the few flat triangles of a real surface.
GridSolid repair_flat_triangles(GridSolid solid, SnapReport* report = nullptr);

// Both steps, with the closedness of the result checked: InvalidSolid (open_edge,
// inconsistent_orientation, degenerate_triangle, flat_solid) when it can't be had.
GridSolid build_grid_solid(const SurfaceView& surface, int bits, SnapReport* report = nullptr);

}  // namespace tetra
