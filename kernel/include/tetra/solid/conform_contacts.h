// SPDX-License-Identifier: LGPL-2.1-or-later
// Makes edge contacts conforming: an edge lying on a face becomes an edge of that face.
#pragma once

#include "tetra/solid/grid_solid.h"

namespace tetra {

// Divides the triangles of a valid surface until no vertex lies inside an edge of its solid and
// no edge runs through a triangle of its solid: such contacts then are shared edges and vertices
// (Bajaj-Dey types 2 and 3), which radial pairing resolves. A vertex alone inside a face (type 1)
// stays as it is. No point is made; coplanar triangles are only divided at existing points and
// their inner diagonals exchanged, so that surface and volume stay equal; parts keep the source
// of a triangle of their plane. Where such a solid touches itself in faces, these become equal
// opposite triangles and go: a gap of no thickness is none. O(n log n) for each round; without
// contacts there is one.
//
// \throw InvalidSolid (edge_contact) when two edges cross in a point inside both.
GridSolid conform_contacts(GridSolid surface);

}  // namespace tetra
