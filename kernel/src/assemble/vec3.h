// SPDX-License-Identifier: LGPL-2.1-or-later
// Vector arithmetic in doubles, for what is measured rather than decided.
#pragma once

#include <cmath>

#include "tetra/exact/grid.h"

namespace tetra {

inline Vec3d minus(const Vec3d& a, const Vec3d& b) {
    return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
inline double dot(const Vec3d& a, const Vec3d& b) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
inline Vec3d cross(const Vec3d& a, const Vec3d& b) {
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
inline double norm(const Vec3d& v) { return std::sqrt(dot(v, v)); }

// Of twice the triangle's area.
inline Vec3d normal_of(const Vec3d& a, const Vec3d& b, const Vec3d& c) {
    return cross(minus(b, a), minus(c, a));
}

}  // namespace tetra
