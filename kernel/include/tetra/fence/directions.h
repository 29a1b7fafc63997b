// SPDX-License-Identifier: LGPL-2.1-or-later
// Directions for the fences: small integer vectors, laid on z exactly, rated by counted walls.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "tetra/progress.h"
#include "tetra/solid/grid_solid.h"

namespace tetra {

// matrix * direction = (0, 0, 1) and det(matrix) = 1, so the map is exact on the grid both ways
// and turns no triangle over. Rows have small entries: coordinates grow by log2(growth) bits.
struct FenceDirection {
    std::string name;  // "x", "y", "z" or "p,q,r"
    Vec3i direction{0, 0, 1};
    std::array<Vec3i, 3> matrix{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
    std::array<Vec3i, 3> inverse{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
    int growth = 1;  // largest sum of magnitudes in a row of the matrix
    // Walls of the fence-off seen this way, estimated on big solids; -1 = not rated. Counting ends
    // where a direction is out of the running: there may be more of them then (see note).
    double cost = -1;
    bool refused = false;  // the solid can't be fenced this way
    std::string note;      // where it comes from, or why it was not rated
};

struct DirectionOptions {
    std::vector<Vec3d> candidates;  // e.g. axes of cylinders; any length
    int from_facets = 4;            // normals of the largest planar faces to be added
    int from_edges = 2;             // commonest exact directions of sharp edges to be added
    int largest_entry = 7;          // of integer directions; a vector is taken to the nearest one
    int sampled_lines = 100;        // plan lines swept to rate one direction
    // Walls per triangle: the first axis with fewer ends the search; other directions than the axes
    // are rated only when no axis has fewer.
    double good = 2;
    double counted_to = 1;  // times the best cost so far, before a count ends
};

// The map for one primitive or scaled integer vector, unrated.
// \throw std::invalid_argument for the zero vector.
FenceDirection lay_on_z(const Vec3i& direction);

// The integer vector with entries up to `largest_entry` nearest in angle.
// \throw std::invalid_argument for a zero or non-finite vector.
Vec3i nearest_integer_direction(const Vec3d& vector, int largest_entry);

// The axes and all candidates, best first, those that were not rated last. An oblique direction has
// to cost a third less than an axis to stand before it. `owner` as in FenceInput.
// \throw InvalidSolid when no direction can be rated; Cancelled.
std::vector<FenceDirection> fence_directions(const std::vector<Vec3i>& points,
                                             const std::vector<Triangle>& triangles,
                                             const std::vector<int>& owner,
                                             const DirectionOptions& options, Progress& progress);

// The rated cost alone, for one direction already laid on z.
double count_walls(const std::vector<Vec3i>& points, const std::vector<Triangle>& triangles,
                   const std::vector<int>& owner, int sampled_lines, Progress& progress);

}  // namespace tetra
