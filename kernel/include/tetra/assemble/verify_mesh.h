// SPDX-License-Identifier: LGPL-2.1-or-later
// The kernel's own check of finished tetrahedra: signs, pairing, skin, volume, vertices (P6).
#pragma once

#include <span>
#include <vector>

#include "tetra/exact/grid.h"
#include "tetra/progress.h"
#include "tetra/solid/grid_solid.h"

namespace tetra {

// What is to be checked, in the caller's units.
struct MeshUnderTest {
    std::span<const Vec3d> points;
    std::span<const std::array<int, 4>> tets;
    std::span<const int> tet_solid;            // or empty
    std::span<const Triangle> skin;
    std::span<const int> skin_source;          // input triangle of each skin triangle
    std::span<const int> point_source;         // per point the input vertex or -1; or empty
};

// What it is checked against: oriented triangles of the input.
struct SurfaceUnderTest {
    std::span<const Vec3d> vertices;
    std::span<const Triangle> triangles;
    std::span<const int> faces;                // face of each triangle, or empty
    std::span<const int> required;             // vertices that must be points; or empty
};

struct MeshCheck {
    double volume = 0, volume_error = 0;       // error relative to the input's volume
    double area = 0, area_error = 0;           // relative
    double skin_distance = 0;                  // of skin points from their source's plane
    int vertices_moved = 0;                    // required, but not bit for bit there
};

struct CheckTolerance {
    double relative = 1e-9;      // volume, area and area vectors, plus what moved vertices explain
    double distance = 0;         // allowed skin_distance; 0 = 2^-22 of the diagonal
};

// Orientation by exact signs of the doubles; every triangle on one tetrahedron or on two with
// opposite sides (of one solid); those on one are exactly the skin; the skin is closed, lies on the
// planes of its sources, and has the area vector of each face and the area of the input; volumes
// agree; no two points are equal; required vertices are points. Linear but for a sort of faces.
//
// Throws VerificationFailed with what failed and where; Cancelled.
MeshCheck verify_mesh(const MeshUnderTest& mesh, const SurfaceUnderTest& surface,
                      const CheckTolerance& tolerance, Progress& progress);

}  // namespace tetra
