// SPDX-License-Identifier: LGPL-2.1-or-later
// Points of the plan: grid points and crossings of projected edges, each with one id.
#pragma once

#include <vector>

#include "tetra/exact/wide_int.h"
#include "tetra/polygon/region.h"

namespace tetra::fence {

// (X / w, Y / w) with w > 0 and gcd(X, Y, w) = 1. |X|, |Y| < 2^84, w < 2^57 on a grid of 26 bits.
struct PlanPoint {
    Int128 X = 0, Y = 0;
    std::int64_t w = 1;
    double x = 0, y = 0;  // relative error below 2^-51
};

// Equal points have equal ids; ids are given in order of first use.
class PlanPoints final : public PointOracle {
  public:
    int vertex(std::int64_t x, std::int64_t y) { return intern(x, y, 1); }
    int crossing(Int128 X, Int128 Y, std::int64_t w);

    const PlanPoint& operator[](int id) const { return points_[static_cast<std::size_t>(id)]; }
    int size() const { return static_cast<int>(points_.size()); }

    // Sign of the difference i - j of one coordinate (0 = x, 1 = y).
    int compare_axis(int axis, int i, int j) const;
    int compare(PointId i, PointId j) const override;
    int orient(PointId i, PointId j, PointId k) const override;

  private:
    int intern(Int128 X, Int128 Y, std::int64_t w);
    void grow();

    std::vector<PlanPoint> points_;
    std::vector<int> slots_;  // open addressing, -1 = free
};

}  // namespace tetra::fence
