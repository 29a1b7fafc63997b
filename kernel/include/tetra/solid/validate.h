// SPDX-License-Identifier: LGPL-2.1-or-later
// Exact validation of a caller's surface: is it the boundary of solids, and which?
#pragma once

#include <vector>

#include "tetra/errors.h"
#include "tetra/progress.h"
#include "tetra/solid/measure.h"
#include "tetra/solid/snap.h"

namespace tetra {

// Fine enough to stand for the doubles themselves, and the finest with exact orient3d.
inline constexpr int validation_bits = 40;

struct ValidateOptions {
    int bits = validation_bits;
    std::size_t max_crossings = 100;  // crossing pairs named
};

struct Validation {
    std::vector<Defect> defects;       // empty: the surface bounds solids
    std::vector<Triangle> triangles;   // the caller's vertices, outward, none flat
    std::vector<int> triangle_source;  // the caller's triangle
    std::vector<int> shell;            // per triangle
    std::vector<int> solid;            // per triangle: an outer shell and its cavities, from 0
    std::vector<int> turned;           // shells that faced the wrong way
    Counts counts;

    SurfaceView surface(const std::vector<Vec3d>& vertices) const {
        return {vertices, triangles, triangle_source, solid};
    }
};

// `solid` labels the caller's triangles by B-rep solid and may be empty. Solids are closed and
// nested each by itself; they may touch but not overlap. Within a solid shells at even depth face
// outward and those at odd depth inward: others are turned, and told. Flat triangles are repaired
// (snap.h), never moved. Nothing is thrown for a bad solid: defects name ids of the caller.
// O(n log n).
Validation validate(const std::vector<Vec3d>& vertices, const std::vector<Triangle>& triangles,
                    const std::vector<int>& solid, const ValidateOptions& options,
                    Progress& progress);

// The same for a surface that is on its grid already, without turning: defects only.
std::vector<Defect> find_defects(const GridSolid& surface, Progress& progress,
                                 std::size_t max_crossings = 100);

struct GridChoice {
    GridSolid solid;
    SnapReport report;
    std::vector<int> rejected;  // grids that were too coarse, in bits
};

// The coarsest grid in lowest..highest bits on which all points of the valid surface stay distinct,
// and it neither crosses itself nor has facets in contact that it had not. When there is none, the
// coarsest that does not cross. Throws InvalidSolid (self_crossing) when there is none either.
GridChoice choose_grid(const std::vector<Vec3d>& vertices, const Validation& valid, int lowest,
                       int highest, Progress& progress);

// The same for triangles that were validated before; `facet_contacts` is what validation counted.
GridChoice choose_grid(const SurfaceView& valid, int facet_contacts, int lowest, int highest,
                       Progress& progress);

}  // namespace tetra
