// SPDX-License-Identifier: LGPL-2.1-or-later
// Exact predicates on points with double coordinates.
#pragma once

#include <array>
#include <span>

#include "tetra/polygon/region.h"

namespace tetra {

/// Oracle over an array of points; id i is the point i. Keeps a view, not a copy.
///
/// Orientation is decided by the rounded determinant l - r when |l - r| > 2^-51 (|l| + |r|)
/// (Shewchuk 1997: the error is below (3 + 2^-49) 2^-53 (|l| + |r|)), otherwise by the exact sum
/// of its six products as an expansion of twelve doubles. Nothing over- or underflows there for
/// coordinates that are 0 or of a magnitude between 2^-400 and 2^400.
class DoublePoints final : public PointOracle {
  public:
    /// \throw InvalidRegion with the points that are not finite or outside of that range.
    explicit DoublePoints(std::span<const std::array<double, 2>> points);

    int compare(PointId i, PointId j) const override;
    int orient(PointId i, PointId j, PointId k) const override;

  private:
    std::span<const std::array<double, 2>> points_;
};

}  // namespace tetra
