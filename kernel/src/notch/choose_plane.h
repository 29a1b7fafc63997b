// SPDX-License-Identifier: LGPL-2.1-or-later
// Which plane cuts a piece: a cover of all notches by facet planes, fewest crossings first.
#pragma once

#include <cstdint>

#include "build_piece.h"

namespace tetra::notch {

enum class Rule { cover, plain, random };

// Greedy vertex cover on the graph of facet planes with a link per notch (ALGORITHMS 5); `plain`
// takes each notch's first facet plane. `seed` != 0 breaks ties of the cover at random.
void assign_notches(std::vector<Notch>& notches, Rule rule, std::uint64_t seed);

// The assigned plane of a piece's notches that crosses fewest notches, of those the one that is
// assigned most (NOTCHES 6.2), counted in doubles with ends within `reach` grid steps as on the
// plane: a choice, not a decision. Fills piece.clear_planes when those it has are used up. -1 when
// the piece has no notch or all its planes are in `excluded`. `plain` gives the lowest notch's
// plane, `random` any.
int choose_plane(PointTable& points, const HalfEdges& edges, Piece& piece,
                 const std::vector<Notch>& notches, Rule rule, double reach,
                 const std::vector<int>& excluded, std::uint64_t& state, Workspace& work);

// Gives a part what is known of the piece it came from; `split` notch edges were cut in two.
void inherit_bounds(const Piece& parent, const HalfEdges& edges, int split, Piece& part);

// A splitmix64 step.
std::uint64_t next_random(std::uint64_t& state);

}  // namespace tetra::notch
