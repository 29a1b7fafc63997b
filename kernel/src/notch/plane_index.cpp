// SPDX-License-Identifier: LGPL-2.1-or-later
// Bounds on positions and normals for a slab query.
#include "plane_index.h"

#include <cmath>

namespace tetra::notch {
namespace {

// The sine of the angle between a plane and a triangle within `delta` of it is at most 2 delta
// over the triangle's least height; unit normals differ by less than 1.5 times the sine.
double slack_of(const std::vector<Vec3i>& points, const Triangle& t, double delta) {
    Vec3d e[3];
    double longest = 0;
    for (int i = 0; i < 3; ++i) {
        const Vec3i &a = points[t[i]], &b = points[t[(i + 1) % 3]];
        double square = 0;
        for (int k = 0; k < 3; ++k) {
            e[i][k] = static_cast<double>(b[k] - a[k]);
            square += e[i][k] * e[i][k];
        }
        longest = std::max(longest, square);
    }
    double area = 0;
    for (int k = 0; k < 3; ++k) {
        const int u = (k + 1) % 3, v = (k + 2) % 3;
        const double c = e[0][u] * e[1][v] - e[0][v] * e[1][u];
        area += c * c;
    }
    const double height = std::sqrt(area / longest);
    return 3 * delta / height + 1e-9;
}

}  // namespace

PlaneIndex::PlaneIndex(const std::vector<Vec3i>& points, const std::vector<Triangle>& triangles,
                       const std::vector<Unit>& units, double delta)
    : delta_(delta), tree_(build_box_tree(points, triangles)) {
    for (const BoxTree::Node& node : tree_.nodes) {
        Spread s;
        const Unit& first = units[static_cast<std::size_t>(tree_.order[node.begin])];
        for (int k = 0; k < 3; ++k) s.low[k] = s.high[k] = first[k];
        for (int i = node.begin; i < node.end; ++i) {
            const auto t = static_cast<std::size_t>(tree_.order[i]);
            const Unit& n = units[t];
            const double sign = n[0] * first[0] + n[1] * first[1] + n[2] * first[2] < 0 ? -1 : 1;
            for (int k = 0; k < 3; ++k) {
                s.low[k] = std::min(s.low[k], sign * n[k]);
                s.high[k] = std::max(s.high[k], sign * n[k]);
            }
            s.slack = std::max(s.slack, slack_of(points, triangles[t], delta));
        }
        spreads_.push_back(s);
    }
}

bool PlaneIndex::Spread::may_hold(const Unit& plane) const {
    for (const double sign : {1.0, -1.0}) {
        double square = 0;
        for (int k = 0; k < 3; ++k) {
            const double n = sign * plane[k];
            const double gap = std::max({low[k] - n, n - high[k], 0.0});
            square += gap * gap;
        }
        if (square <= slack * slack) return true;
    }
    return false;
}

bool PlaneIndex::meets_slab(const Box& box, const Unit& plane) const {
    double centre = plane[3], reach = delta_;
    for (int k = 0; k < 3; ++k) {
        const auto low = static_cast<double>(box.low[k]), high = static_cast<double>(box.high[k]);
        centre += plane[k] * (low + high) / 2;
        reach += std::fabs(plane[k]) * (high - low) / 2;
    }
    return std::fabs(centre) <= reach;
}

}  // namespace tetra::notch
