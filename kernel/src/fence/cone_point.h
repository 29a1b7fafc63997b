// SPDX-License-Identifier: LGPL-2.1-or-later
// A point strictly inside a column, on doubles so that rounding never moves it.
#pragma once

#include <array>
#include <optional>

#include "plan.h"

namespace tetra::fence {

// Inside the column over a counter-clockwise triangle of plan points, between two facets.
std::optional<HPoint> point_in_column(const Plan& plan, const std::array<int, 3>& base, int floor,
                                      int ceiling);

}  // namespace tetra::fence
