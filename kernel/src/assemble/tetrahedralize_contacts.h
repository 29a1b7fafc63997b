// SPDX-License-Identifier: LGPL-2.1-or-later
// One mesh of several solids: each is made on the contact triangles of those before it.
#pragma once

#include <array>
#include <map>
#include <set>

#include "join_meshes.h"
#include "tetra/assemble/imprint_contacts.h"

namespace tetra {

// Whether all triangles of contacts have their corners on the grid, none dropped or exchanged.
bool keeps_contacts(const SolidSurface& surface, const GridSolid& grid);

// Solids are added one after the other. The contact triangles of a solid with earlier ones are
// those of their meshes, each a face of its own, so that no stage exchanges its edges; on contacts
// with later ones it is free. A Steiner point that it still needs on a contact is put into the
// earlier meshes: their tetrahedra there are divided, exactly alike on both sides. A point on an
// edge of a contact goes into all meshes with this edge, the triangles of later solids included.
class Assembly {
  public:
    explicit Assembly(Imprint imprint);

    SolidSurface surface_of(int solid) const;

    // \throw VerificationFailed, leaving all as it was, when a vertex of a contact could not be
    //        kept in place or a divided tetrahedron would not be positive.
    void add(const SolidSurface& surface, SolidTets part, const GridSolid& grid);

    // With the caller's triangles and vertices. \throw VerificationFailed when a skin triangle of
    // a contact has no twin.
    TetResult take(std::size_t vertices_of_caller);

  private:
    int twin_solid(int triangle) const;
    Division divided_edges() const;
    void expect_twins(int solid, const MeshParts& earlier, const MeshParts& fresh) const;
    void name_points_of_contacts();
    void in_order_of_solids();

    Imprint imprint_;
    std::map<std::array<int, 3>, int> patch_;  // (face, solid and face beyond) -> face of contact
    int next_face_ = 0;
    std::set<int> finished_;
    FinishedMeshes meshes_;
    TetReport report_;
};

}  // namespace tetra
