// SPDX-License-Identifier: LGPL-2.1-or-later
// The kernel's own check of finished tetrahedra: signs, pairing, skin, volume, vertices (P6).
#pragma once

#include <span>
#include <vector>

#include "tetra/exact/grid.h"
#include "tetra/progress.h"
#include "tetra/solid/grid_solid.h"

namespace tetra {

// What is to be checked, in the caller's units. Tetrahedra of different solids may share points.
struct MeshUnderTest {
    std::span<const Vec3d> points;
    std::span<const std::array<int, 4>> tets;
    std::span<const int> tet_solid;     // or empty: one solid
    std::span<const Triangle> skin;     // outward
    std::span<const int> skin_source;   // a triangle of the surface, of the same facet
    std::span<const int> point_source;  // per point the vertex of the surface it stands for, or -1
};

// The oriented surface it is checked against.
struct SurfaceUnderTest {
    std::span<const Vec3d> vertices;
    std::span<const Triangle> triangles;
    std::span<const int> facets;    // facet of each triangle (Restored::facet_of_triangle)
    std::span<const int> required;  // vertices that must be points
};

struct CheckTolerance {
    double relative = 1e-9;  // of the volume, and of the area for each facet's area vector
    double distance = 0;     // of Steiner points from the surface; 0 = 2^-22 of the diagonal
    double step = 0;         // how far a point may be from its vertex (a grid step)
};

struct MeshCheck {
    double volume = 0, volume_error = 0;  // the error relative to the volume of the surface
    double area = 0, area_error = 0;      // likewise
    double steiner_distance = 0;          // of Steiner points on the skin from their facets
    int vertices_moved = 0;               // required, but not bit for bit where they were
};

// Exact: the sign of each tetrahedron in doubles; that each triangle is on one tetrahedron of a
// solid, or on two with opposite sides; that those on one are the skin; that no two points are
// equal; that required vertices are points. Numeric: each facet's area vector and area, the
// volume, and the distance of Steiner points from their facets. A facet that is not flat in the
// caller's numbers widens the tolerance of the volume by its area times its unevenness.
//
// Throws VerificationFailed with what failed and where; Cancelled. Linear but for sorting.
MeshCheck verify_mesh(const MeshUnderTest& mesh, const SurfaceUnderTest& surface,
                      const CheckTolerance& tolerance, Progress& progress);

}  // namespace tetra
