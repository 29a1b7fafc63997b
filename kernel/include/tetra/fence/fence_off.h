// SPDX-License-Identifier: LGPL-2.1-or-later
// Fence-off: exact conforming tetrahedra of any valid solid, by vertical fences and staircases.
#pragma once

#include <vector>

#include "tetra/progress.h"
#include "tetra/solid/exact_mesh.h"

namespace tetra {

// What is fenced. Fences are parallel to z; another direction is laid on z by the caller (see
// directions.h). Coordinates may not exceed 2^26 in magnitude.
struct FenceInput {
    std::vector<Vec3i> points;
    std::vector<Triangle> triangles;  // outward, closed; several solids may stand side by side
    std::vector<int> owner;  // per triangle; coplanar neighbours merge only within one owner
    std::vector<int> solid;  // per triangle, copied to the tetrahedra; empty = all 0
    // Per point: must it be a vertex of the result even where it is flat or in the middle of a
    // straight edge? Empty = every point of a triangle must.
    std::vector<char> keep;
};

struct FenceCounts {
    int facets = 0, sharp_edges = 0, lines = 0;
    int cells = 0;           // distinct (floor, ceiling) pairs
    int base_triangles = 0;  // columns
    int steiner_points = 0;  // points of the result that are no input points
    int cyclic_columns = 0;  // columns that needed a cone point
    int wall_sides = 0;      // base edges with the region on one side
    int propagated = 0;      // wall incidences split by rules R7 and R7b alone
};

// mesh.points starts with no particular order; point_source gives the input point or -1.
// mesh.skin_source and facet carriers name triangles of the FenceInput.
struct FenceResult {
    ExactMesh mesh;
    std::vector<int> point_source;
    FenceCounts counts;
};

// Face-to-face tetrahedra of each solid of the input. Different solids share input points and
// nothing else: their contacts are not made conforming.
//
// \pre no flat triangle; each directed edge as often as its reverse within a solid.
// \throw InvalidSolid when floors and ceilings do not alternate along some vertical line, naming
//        triangles of the facets at fault; VerificationFailed when a cyclic column has no cone
//        point; Cancelled.
// Complexity: O((n + k) log n) for k walls met by sharp edges, and what they bound.
FenceResult fence_off(const FenceInput& input, Progress& progress);

}  // namespace tetra
