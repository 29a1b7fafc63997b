// SPDX-License-Identifier: LGPL-2.1-or-later
// Convex cells by fences: columns over convex pieces of the base regions (DESIGN 3.5).
#pragma once

#include <cstdint>

#include "tetra/exact/plane.h"
#include "tetra/fence/fence_off.h"

namespace tetra {

// Facet f has the points facet_points[facet_offsets[f]] .. [facet_offsets[f+1]-1], counter-
// clockwise seen from outside, no three in a row on a line, and lies in the plane facet_planes[f]
// with its outward normal. Cell c has the facets cell_offsets[c] .. cell_offsets[c+1]-1, all of
// different planes: a floor, a ceiling and walls.
//
// Every plane is that of an input triangle or holds an input edge and the fence direction; every
// point is an input point or the meeting of a facet with two such vertical planes.
struct FenceCells {
    std::vector<HPoint> points;
    std::vector<int> point_source;  // input point or -1
    std::vector<std::int64_t> facet_offsets{0};
    std::vector<int> facet_points;
    std::vector<Plane> facet_planes;
    std::vector<int> facet_source;  // an input triangle in the same oriented plane, or -1
    std::vector<std::int64_t> cell_offsets{0};
    std::vector<int> cell_solid;
    int bases = 0;   // (floor, ceiling) pairs
    int chords = 0;  // cuts that made base regions convex
};

// Convex cells that cover each solid once. They need not meet face to face: two cells may share
// a part of a wall only. `input.keep` is not used: cells have corners only.
//
// \pre as fence_off.
// \throw InvalidSolid, Cancelled as fence_off.
FenceCells cells_from_fences(const FenceInput& input, Progress& progress);

}  // namespace tetra
