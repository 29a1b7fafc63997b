// SPDX-License-Identifier: LGPL-2.1-or-later
// Cutting a piece along a traced section: splitting, splicing, and the pieces that come of it.
#pragma once

#include "section.h"

namespace tetra::notch {

// Cuts along the used components of the section. The piece is consumed; its parts are returned,
// each a set of surfaces that may hang together through holes or cavities (NOTCHES 3.6, 3.10,
// 3.12). No reflex edge arises that was none; notches on the used components are gone.
std::vector<Piece> cut_piece(PointTable& points, HalfEdges& edges, Piece&& piece,
                             const Section& section, Workspace& work);

}  // namespace tetra::notch
