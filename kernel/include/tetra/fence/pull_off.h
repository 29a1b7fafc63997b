// SPDX-License-Identifier: LGPL-2.1-or-later
// Pull-off (Chazelle-Palios 1990, 2): cuts unhindered pointed vertices off as cups.
#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include "tetra/progress.h"
#include "tetra/solid/grid_solid.h"

namespace tetra {

// all: every favourable vertex, smallest crown first. crossings: only cups that lower the number
// of proper crossings of sharp edges seen along z, or keep it and lower the number of sharp edges.
enum class PullMode { all, crossings };

struct PullOptions {
    int degree_cap = 25;
    PullMode mode = PullMode::all;
};

// A removed vertex with what it took along. Lateral triangle i is (apex, crown[i], crown[i+1]),
// outward, of owner lateral_owner[i]. Dome triangles are outward for what remains:
// orient3d(dome, apex) > 0, so the tetrahedra of the cup are (dome[j], apex), crown.size() - 2.
struct Cup {
    int apex = -1;
    std::vector<int> crown;
    std::vector<int> lateral_owner;
    std::vector<Triangle> dome;
};

// The dome of `cup`, one triangle, met a triangle of `owner` back to back: both vanished.
// `triangle` is oriented as the dome triangle.
struct ClosingPair {
    int cup = -1;
    int owner = -1;
    Triangle triangle{};
};

struct PullStatistics {
    int removed = 0;
    int tries = 0;
    int flips = 0;
    int refused_owner = 0;   // a flip would join two owners
    int refused_degree = 0;  // crown above the cap
    int refused_gain = 0;    // mode crossings: nothing gained
    int hindered_by_vertex = 0;
    int hindered_by_edge = 0;
    int without_dome = 0;
    std::vector<int> crowns_by_degree;  // index = crown size
};

// What is left of the surface and how to put the cups back. Owner ids below first_cup are those
// of the input; first_cup + i is the dome of cups[i].
struct PullOff {
    std::vector<Triangle> triangles;
    std::vector<int> owners;
    std::vector<Cup> cups;
    std::vector<ClosingPair> closings;
    std::vector<int> keep;  // straight crown vertices: must stay vertices of any subdivision
    int first_cup = 0;
    // In mode crossings: projected_crossings() before and after; else -1.
    std::int64_t crossings_before = -1, crossings_after = -1;
    PullStatistics statistics;
};

// Rules P1 to P10 of PULLOFF.md. `triangles` is a closed outward surface without flat triangles,
// any genus and shells; `owners` one id >= 0 per triangle: triangles of different owners are
// never joined. |coordinates| < 2^30. All decisions are signs of grid points.
// Post: signed volumes of cups and remainder sum to the input's; the remainder is as valid as the
// input. O((n + tries * degree^2) log n) in practice.
PullOff pull_off(const std::vector<Vec3i>& points, const std::vector<Triangle>& triangles,
                 const std::vector<int>& owners, const PullOptions& options, Progress& progress);

// Number of pairs of sharp edges whose projections along z cross properly (PULLOFF A1). Sharp:
// not between two coplanar triangles of one owner; vertical edges don't count. With more edges than
// `sampled` the number is estimated from so many of them.
std::int64_t projected_crossings(const std::vector<Vec3i>& points,
                                 const std::vector<Triangle>& triangles,
                                 const std::vector<int>& owners, Progress& progress,
                                 int sampled = std::numeric_limits<int>::max());

// One id per triangle: two triangles have the same one when they are joined over edges of exactly
// two coplanar, equally oriented triangles of one `face` (empty = all 0) and one `solid` (same).
// Ids are dense and ascend with the first triangle of each.
std::vector<int> facet_owners(const std::vector<Vec3i>& points,
                              const std::vector<Triangle>& triangles, const std::vector<int>& face,
                              const std::vector<int>& solid);

enum class PulledKind {
    unused,
    nonmanifold,
    flat,
    reflex,
    mixed_owners,
    hindered_by_vertex,
    hindered_by_edge,
    without_dome,
    favourable,
};

// What each vertex of a surface is before anything is removed, at any degree.
std::vector<PulledKind> classify_vertices(const std::vector<Vec3i>& points,
                                          const std::vector<Triangle>& triangles,
                                          const std::vector<int>& owners);

}  // namespace tetra
