// SPDX-License-Identifier: LGPL-2.1-or-later
// The stage's own check: the skin covers each facet exactly once.
#pragma once

#include "columns.h"

namespace tetra::fence {

// Compares areas facet by facet, exactly modulo a prime.
// \throw InvalidSolid naming facets that are covered too little or too much: two shells share
//        part of a face, or the surface crosses itself.
void check_skin_area(const Plan& plan, const Joints& joints, const Columns& columns);

}  // namespace tetra::fence
