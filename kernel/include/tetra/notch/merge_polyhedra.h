// SPDX-License-Identifier: LGPL-2.1-or-later
// Convex cells from any exact partition into convex polyhedra, by the merging of notch cutting.
#pragma once

#include "tetra/notch/convex_cells.h"

namespace tetra {

// One solid with points and triangles in an order that does not depend on the caller's.
GridSolid solid_in_order(const GridSolid& all, int solid);

// Facet f has the points facet_points[facet_offsets[f] .. f+1), counter-clockwise seen from
// outside, no three in a row on a line, in the plane facet_planes[f] with its outward normal; cell
// c the facets cell_offsets[c] .. c+1, all of different planes.
struct Polyhedra {
    std::vector<HPoint> points;
    std::vector<int> point_source;  // point of the grid solid or -1
    std::vector<std::int64_t> facet_offsets{0};
    std::vector<int> facet_points;
    std::vector<Plane> facet_planes;
    std::vector<std::int64_t> cell_offsets{0};
};

// Joins neighbours with a whole facet in common whose union is convex (`merge`) and evaluates the
// points in the caller's coordinates, `vertices`. The result is verified as that of convex_cells,
// exactly. `solid` is a single solid on at most 26 bits that the polyhedra cover once.
//
// \throw VerificationFailed, Cancelled.
// Complexity: O(n) facets and joins.
ConvexCells merge_polyhedra(const GridSolid& solid, const std::vector<Vec3d>& vertices,
                            const Polyhedra& polyhedra, bool merge, Progress& progress);

}  // namespace tetra
