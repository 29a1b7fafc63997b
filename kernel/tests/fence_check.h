// SPDX-License-Identifier: LGPL-2.1-or-later
// An exact judge of the fence-off: orientation, pairing, skin, volume, vertices and carriers.
#pragma once

#include <string>

#include "tetra/fence/fence_off.h"

namespace tetra::testing {

// Empty when the result is a conforming partition of the input, else what is wrong first.
// Signs are exact; areas and volumes are compared modulo 2^61 - 1.
std::string fence_fault(const FenceInput& input, const FenceResult& result);

}  // namespace tetra::testing
