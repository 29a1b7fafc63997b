// SPDX-License-Identifier: LGPL-2.1-or-later
// Meshes of solids in contact: each contact triangle stays whole, or is divided alike on both
// sides.
#pragma once

#include "imprint_contacts.h"
#include "tetrahedralize_solid.h"

namespace tetra {

// A Steiner point that the mesh of one solid needs on a contact: on the edge from u to v of the
// imprinted surface, or (u < 0) inside its triangle.
struct ContactPoint {
    int u = -1, v = -1, triangle = -1;
    Vec3d place{};
};

// The surface with a face of its own for each pair of contact triangles, so that no stage
// exchanges their edges.
TetInput with_contact_faces(const Imprint& imprint);

// Points that the mesh of one solid has on contacts; `part` as made from imprint's surface.
void find_contact_points(const SolidTets& part, const GridSolid& grid, const Imprint& imprint,
                         std::vector<ContactPoint>& points);

// Makes them vertices of the surface, on both sides of each contact; of several in one triangle
// the first only.
void add_contact_points(std::vector<ContactPoint> points, Imprint& imprint);

// Per skin triangle the one of another solid with the same corners, or -1.
std::vector<int> skin_twins(const std::vector<Triangle>& skin);

}  // namespace tetra
