// SPDX-License-Identifier: LGPL-2.1-or-later
// One mesh of several solids: each is made on the contact triangles of those before it.
#pragma once

#include <array>
#include <map>
#include <set>

#include "tetra/assemble/imprint_contacts.h"
#include "tetrahedralize_solid.h"

namespace tetra {

// What one solid is meshed from.
struct SolidSurface {
    TetInput input;            // vertices of the whole assembly
    std::vector<int> origin;   // per triangle: of the imprinted surface
    std::vector<int> old_row;  // the skin row of an earlier solid on its other side, or -1
};

// Solids are added one after the other. The contact triangles of a solid with earlier ones are
// those of their meshes, each a face of its own, so that no stage exchanges its edges; on contacts
// with later ones it is free. A Steiner point that it still needs on a contact is put into the
// earlier meshes: their tetrahedra there are divided, exactly alike on both sides.
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

    Imprint imprint_;
    std::map<std::array<int, 3>, int> patch_;  // (face, solid and face beyond) -> face of contact
    int next_face_ = 0;
    std::set<int> finished_;
    std::vector<int> vertex_of_point_;  // -1 away from contacts
    std::map<Vec3d, int> known_;        // points of finished solids by place
    TetResult result_;
};

}  // namespace tetra
