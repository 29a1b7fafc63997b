// SPDX-License-Identifier: LGPL-2.1-or-later
// Planes through three grid points, primitive and hash-consed, so that coplanar is equal ids.
#pragma once

#include <unordered_map>
#include <vector>

#include "tetra/exact/predicates.h"

namespace tetra {

// a x + b y + c z + d = 0 with gcd 1. |a|,|b|,|c| < 2^(2b+3), |d| < 2^(3b+3); b <= 30.
struct Plane {
    std::int64_t a = 0, b = 0, c = 0;
    Int128 d = 0;
    friend bool operator==(const Plane&, const Plane&) = default;
};

// The primitive plane of an oriented triangle, its normal (q-p)x(r-p). The triangle must not be
// flat.
Plane plane_through(const Vec3i& p, const Vec3i& q, const Vec3i& r);

Plane opposite(const Plane& plane);

// a x + b y + c z + d at a grid point, exact (3b+5 bits).
Int128 plane_value(const Plane& plane, const Vec3i& point);

// An interned plane and the orientation in which it is meant: side +1 as stored, -1 reversed.
struct PlaneKey {
    int id = -1;
    int side = 1;
    friend bool operator==(const PlaneKey&, const PlaneKey&) = default;
    friend auto operator<=>(const PlaneKey&, const PlaneKey&) = default;
};

// Stores each plane once, in the orientation whose first non-zero normal component is positive.
// Ids are given in order of first use.
class PlaneTable {
  public:
    PlaneKey intern(const Plane& plane);
    const Plane& operator[](int id) const { return planes_[static_cast<std::size_t>(id)]; }
    int size() const { return static_cast<int>(planes_.size()); }

  private:
    struct Hash {
        std::size_t operator()(const Plane& p) const;
    };
    std::vector<Plane> planes_;
    std::unordered_map<Plane, int, Hash> ids_;
};

// Greatest common divisor of magnitudes; gcd(0, 0) = 0.
UInt128 gcd(UInt128 a, UInt128 b);

}  // namespace tetra
