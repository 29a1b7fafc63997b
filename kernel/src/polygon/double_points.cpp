// SPDX-License-Identifier: LGPL-2.1-or-later
// Filtered orientation with error-free transformations behind it.

#include "tetra/polygon/double_points.h"

#include <cmath>
#include <string>
#include <utility>

namespace tetra {

namespace {

constexpr double filter_bound = 0x1p-51;
constexpr double smallest = 0x1p-400;
constexpr double largest = 0x1p400;

/// A sum of doubles without rounding: components of increasing magnitude that do not overlap.
class Expansion {
  public:
    void add_product(double a, double b) {
        const double product = a * b;
        add(std::fma(a, b, -product));
        add(product);
    }

    int sign() const {
        for (int k = size_ - 1; k >= 0; --k) {
            if (parts_[k] != 0.0) {
                return parts_[k] > 0.0 ? 1 : -1;
            }
        }
        return 0;
    }

  private:
    /// Shewchuk's grow-expansion, with Knuth's two-sum.
    void add(double value) {
        for (int k = 0; k < size_; ++k) {
            const double sum = parts_[k] + value;
            const double share = sum - value;
            parts_[k] = (parts_[k] - share) + (value - (sum - share));
            value = sum;
        }
        parts_[size_++] = value;
    }

    std::array<double, 12> parts_{};
    int size_ = 0;
};

using Point = std::array<double, 2>;

int exact_orient(const Point& a, const Point& b, const Point& c) {
    Expansion sum;
    sum.add_product(a[0], b[1]);
    sum.add_product(-a[1], b[0]);
    sum.add_product(b[0], c[1]);
    sum.add_product(-b[1], c[0]);
    sum.add_product(c[0], a[1]);
    sum.add_product(-c[1], a[0]);
    return sum.sign();
}

bool is_usable(double x) { return x == 0.0 || (std::abs(x) >= smallest && std::abs(x) <= largest); }

}  // namespace

DoublePoints::DoublePoints(std::span<const Point> points) : points_(points) {
    std::vector<PointId> bad;
    for (std::size_t i = 0; i < points.size(); ++i) {
        if (!is_usable(points[i][0]) || !is_usable(points[i][1])) {
            bad.push_back(static_cast<PointId>(i));
        }
    }
    if (!bad.empty()) {
        const std::string what = std::to_string(bad.size()) + " points, the first is " +
                                 std::to_string(bad.front()) +
                                 ", have coordinates that are not finite or not between 2^-400 "
                                 "and 2^400; scale or repair them";
        throw InvalidRegion(what, {}, std::move(bad));
    }
}

int DoublePoints::compare(PointId i, PointId j) const {
    const Point& p = points_[i];
    const Point& q = points_[j];
    if (p[0] != q[0]) {
        return p[0] < q[0] ? -1 : 1;
    }
    return p[1] < q[1] ? -1 : (p[1] > q[1] ? 1 : 0);
}

int DoublePoints::orient(PointId i, PointId j, PointId k) const {
    const Point& a = points_[i];
    const Point& b = points_[j];
    const Point& c = points_[k];
    const double left = (a[0] - c[0]) * (b[1] - c[1]);
    const double right = (a[1] - c[1]) * (b[0] - c[0]);
    const double determinant = left - right;
    if (std::abs(determinant) > filter_bound * (std::abs(left) + std::abs(right))) {
        return determinant > 0.0 ? 1 : -1;
    }
    return exact_orient(a, b, c);
}

}  // namespace tetra
