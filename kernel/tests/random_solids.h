// SPDX-License-Identifier: LGPL-2.1-or-later
// Small solids on the integer grid for tests: named ones, and random ones full of contacts.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "tetra/exact/wide_int.h"
#include "tetra/solid/grid_solid.h"

namespace tetra::testing {

// A closed, outward oriented triangle surface that does not cross itself. Contacts at edges and
// vertices are shared points (Bajaj-Dey types 2 and 3); two shells never share part of a face.
struct TestSolid {
    std::vector<Vec3i> points;
    std::vector<Triangle> triangles;
};

// A deterministic stream of numbers, the same on every machine (splitmix64).
class Random {
  public:
    explicit Random(std::uint64_t seed) : state_(seed) {}
    std::uint64_t next();
    // Uniform in first..last, both included.
    int between(int first, int last);
    bool chance(int numerator, int denominator) { return between(1, denominator) <= numerator; }

  private:
    std::uint64_t state_;
};

enum class VoxelMap {
    any,            // one of the following, drawn
    aligned,        // even steps along the axes
    uneven,         // axis-parallel, every grid plane at a place of its own
    sheared,        // a unimodular integer map
    mapped,         // a general integer map of positive determinant
    jitter_z,       // each vertex moved along z: vertical faces stay vertical
    jitter_sparse,  // one vertex in four moved
    jitter,         // each vertex moved: every quad becomes two triangles of different planes
    jitter_mapped   // moved, then a general integer map
};

struct VoxelOptions {
    int min_size = 2, max_size = 4;  // cells along each axis
    VoxelMap map = VoxelMap::any;
    int max_bits = 20;      // |coordinate| <= 2^max_bits; at least 10
    bool cavities = false;  // a closed crust around the random cells
};

// A random union of grid cells, never empty. Equal arguments give equal solids.
TestSolid random_voxel_solid(std::uint64_t seed, const VoxelOptions& options = {});

// The hull-like solid of a random convex lattice shape: cut corners of a box (all notch-free).
TestSolid random_convex_solid(std::uint64_t seed, int points);

// A random voxel solid standing on one vertex inside a top face of another (type 1).
TestSolid random_type1_solid(std::uint64_t seed, const VoxelOptions& options = {});

// Small voxel solids of all kinds: some with cavities, some of type 1.
TestSolid small_random_solid(std::uint64_t seed);

// Cells given as layers from below, each a list of rows (y) of characters (x); '#' is solid.
// Grid planes at steps of `step`.
TestSolid voxel_solid(const std::vector<std::vector<std::string>>& layers, std::int64_t step = 4);

// Union of two surfaces without looking at their points: they stay apart in topology.
TestSolid join(const TestSolid& first, const TestSolid& second);

// Equal places become one point; used ones only.
TestSolid weld(const TestSolid& solid);

// p -> matrix p + shift; a negative determinant turns the triangles over.
using Matrix3 = std::array<Vec3i, 3>;
TestSolid map(const TestSolid& solid, const Matrix3& matrix, const Vec3i& shift = {0, 0, 0});

// Random order of points and triangles, and of the corners within each triangle.
TestSolid shuffle(const TestSolid& solid, std::uint64_t seed);

// Six times the volume, exact.
Int256 volume6(const TestSolid& solid);

// As the kernel takes it: one solid id for all, step 1, every triangle its own source.
GridSolid grid_solid(const TestSolid& solid);

std::string to_off(const TestSolid& solid);

struct NamedSolid {
    const char* name;
    TestSolid solid;
    int cells;  // convex pieces that exact notch cutting with merging gives; 0 = not stated
};

// cube, L, boss, cavity, frame, three-way frame, touching cubes, touching cavities, vertex on a
// face, stairs, octahedron, Schoenhardt's prism, plate with holes, wall with windows, spike cup.
std::vector<NamedSolid> named_solids();

TestSolid cube(std::int64_t size = 4);
TestSolid octahedron(std::int64_t size = 4);
TestSolid schoenhardt();
TestSolid plate_with_holes(int rows, int columns);
TestSolid chazelle(int notches, int inverse_gap = 2);  // ALGORITHMS 2.5: N and M

}  // namespace tetra::testing
