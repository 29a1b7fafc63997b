// SPDX-License-Identifier: LGPL-2.1-or-later
// Voxel solids cut into fine Kuhn tetrahedra whose extra points are all removable, and exact
// checks.
#pragma once

#include <array>
#include <cstdint>
#include <set>
#include <string>
#include <vector>

#include "tetra/solid/exact_mesh.h"
#include "tetra/solid/grid_solid.h"

namespace tetra::testing_support {

using Voxel = std::array<int, 3>;

struct RefinedOptions {
    int parts = 2;             // fine cells per voxel and axis
    std::int64_t spacing = 4;  // grid units per voxel before the map; parts need not divide it
    bool uneven = false;       // fine coordinates not evenly spaced (parts <= spacing)
    std::array<Vec3i, 3> map{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};  // columns, determinant > 0
};

struct Refined {
    GridSolid solid;
    ExactMesh mesh;
};

Refined refined_voxels(const std::set<Voxel>& voxels, const RefinedOptions& options = {});

std::set<Voxel> box_voxels(int x, int y, int z);

// Random voxels of a cube of so many; may hang together by edges and corners only.
std::set<Voxel> random_voxels(std::uint64_t seed, int size, int percent);

// Exact: positive tetrahedra, pairing, skin = triangles on one tetrahedron, volume and the area
// vector of each plane and side equal to the solid's (modulo 2^61 - 1). Empty when all holds.
std::string flaw_of(const ExactMesh& mesh, const GridSolid& solid);

}  // namespace tetra::testing_support
