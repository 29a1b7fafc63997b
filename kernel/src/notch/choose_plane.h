// SPDX-License-Identifier: LGPL-2.1-or-later
// Which plane cuts a piece: a cover of all notches by facet planes, few crossings and halves first.
#pragma once

#include <cstdint>

#include "build_piece.h"

namespace tetra::notch {

enum class Rule { cover, plain, random };

// Greedy vertex cover on the graph of facet planes with a link per notch (ALGORITHMS 5); `plain`
// takes each notch's first facet plane. `seed` != 0 breaks ties of the cover at random.
void assign_notches(std::vector<Notch>& notches, Rule rule, std::uint64_t seed);

// Where to cut a piece; plane -1: nowhere.
struct Choice {
    int plane = -1;
    bool whole = false;  // all of the plane's section, not only what carries a notch
};

// A plane that notches of the piece are assigned to and that is not in `excluded`; one that
// crosses few notches and halves what is left (docs/decisions/0004). Counted in floats: a choice,
// not a decision. `plain` gives the lowest notch's plane, `random` any. O(notches of the piece), at
// most kChoiceBudget products more.
Choice choose_plane(const PointTable& points, const HalfEdges& edges, const Piece& piece,
                    const std::vector<Notch>& notches, Rule rule, const std::vector<int>& excluded,
                    std::uint64_t& state, Workspace& work);

// A splitmix64 step.
std::uint64_t next_random(std::uint64_t& state);

}  // namespace tetra::notch
