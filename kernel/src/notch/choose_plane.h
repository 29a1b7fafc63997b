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

// The assigned planes of a piece's notches, best first: fewest notches crossed, then most
// resolved (NOTCHES 6.2). Empty when the piece has no notch. `plain` gives the lowest notch's
// plane first; `random` any order.
std::vector<int> ranked_planes(PointTable& points, const HalfEdges& edges, const Piece& piece,
                               const std::vector<Notch>& notches, Rule rule, std::uint64_t& state);

// A splitmix64 step.
std::uint64_t next_random(std::uint64_t& state);

}  // namespace tetra::notch
