// SPDX-License-Identifier: LGPL-2.1-or-later
// Restoring: the caller's coordinates for every input vertex after compaction (COMPACT.md B).
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "tetra/exact/grid.h"
#include "tetra/progress.h"
#include "tetra/solid/exact_mesh.h"

namespace tetra {

struct RestoreOptions {
    std::uint64_t seed = 1;
    int walks = 40;            // random walks per vertex that stays blocked
    int attempts = 8;          // runs, each from a mesh shaken by more flips, until none is left
    double quality_below = 0;  // flip away tetrahedra of lower mean ratio; 0 = leave them
};

struct RestoreStats {
    int attempts = 0;
    int input_vertices = 0;    // grid points of the solid that are in the mesh
    int vertices_on_grid = 0;  // of these, not at the caller's coordinates in the end
    int steiner_points = 0;
    int steiner_on_grid = 0;    // of these, not on the caller's edge or triangle in the end
    int steiner_off_plane = 0;  // of those, over 1e-7 from there
    int put_back = 0;           // points that could not go with all the others
    int flips = 0;              // that unblocked points
    int walks = 0;              // points that needed a walk
    int peeled = 0;             // flat skin tetrahedra deleted
    int collapses = 0;          // Steiner points removed since they were in the way
    int inserted = 0;           // Steiner points put inside since nothing else helped
    int slivers = 0;            // tetrahedra lower than 1e-6 grid steps in the end
    int quality_flips = 0;
    std::vector<int> left;  // the caller's vertices that stay on the grid
    double seconds = 0;
};

struct Restored {
    std::vector<Vec3d> points;  // per point of the mesh, in the caller's units
    // Facet of each triangle of the GridSolid, as compact() has them, those joined that exchanged
    // skin by a peel: what verify_mesh() compares areas by.
    std::vector<int> facet_of_triangle;
    RestoreStats stats;
};

// Places for all points of `mesh` such that every tetrahedron is positive in doubles: grid point k
// at vertices[solid.point_source[k]] bit for bit, edge points on the caller's edges, facet points
// at the same barycentric place of the caller's triangle. Connectivity of `mesh` may change by
// flips and peels within one face; `faces` as in compact().
//
// Throws VerificationFailed when some tetrahedron is positive neither there nor on the grid.
Restored restore(ExactMesh& mesh, const GridSolid& solid, const std::vector<Vec3d>& vertices,
                 std::span<const int> faces, const RestoreOptions& options, Progress& progress);

}  // namespace tetra
