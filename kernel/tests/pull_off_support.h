// SPDX-License-Identifier: LGPL-2.1-or-later
// Inputs of the pull-off's tests: hulls, spheres, prisms, and the volumes of what it returns.
#pragma once

#include "random_solids.h"
#include "tetra/fence/pull_off.h"

namespace tetra::testing {

// Convex hull by insertion; no four points in a plane with a collinear triple among them.
TestSolid hull_of(const std::vector<Vec3i>& points);

std::vector<Vec3i> random_sphere_points(std::uint64_t seed, int count, double radius);
TestSolid uv_sphere(int meridians, int parallels, double radius);
TestSolid prism(int sides, double radius, std::int64_t height);
TestSolid moment_curve_hull(int count);
// A cube whose faces are grids of cells x cells squares.
TestSolid gridded_cube(int cells, std::int64_t step);

// Moves hull vertex `vertex` towards the origin by the fraction numerator / 16.
TestSolid dented(TestSolid solid, int vertex, int numerator);

// The same surface turned inside out: a void.
TestSolid mirrored(TestSolid solid);

int reflex_edges(const TestSolid& solid);

PullOff pull(const TestSolid& solid, const PullOptions& options = {});

// Exact volumes, closedness, cup sizes and signs of a result.
void expect_sound(const TestSolid& solid, const PullOff& result);

int cup_tets(const PullOff& result);

}  // namespace tetra::testing
