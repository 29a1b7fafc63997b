// SPDX-License-Identifier: LGPL-2.1-or-later
// The hindered test: live vertices in the closed cup, edges inside a plane face of the dome.
#include <algorithm>
#include <array>
#include <cmath>

#include "pull_off_crown.h"
#include "tetra/exact/predicates.h"

namespace tetra {
namespace {

using Normal = std::array<double, 3>;

// The cup of apex v as a convex cone of lateral planes and the tetrahedra of its dome.
class ClosedCup {
  public:
    ClosedCup(const PullSurface& surface, int v, const std::vector<int>& ring,
              const std::vector<Triangle>& dome)
        : s_(surface), v_(v), ring_(ring), dome_(dome), box_{surface.point(v), surface.point(v)} {
        for (const int c : ring)
            for (std::size_t k = 0; k < 3; ++k) {
                box_.lo[k] = std::min(box_.lo[k], surface.point(c)[k]);
                box_.hi[k] = std::max(box_.hi[k], surface.point(c)[k]);
            }
    }

    // False only if the box holds no point of the closed cup.
    bool may_meet(const GridBox& box) const {
        for (std::size_t k = 0; k < 3; ++k)
            if (box.hi[k] < box_.lo[k] || box.lo[k] > box_.hi[k]) return false;
        // More planes than this cost more than the boxes they exclude.
        const std::size_t planes = std::min<std::size_t>(ring_.size(), 16);
        for (std::size_t i = 0; i < planes; ++i) {
            if (i == normals_.size())
                normals_.push_back(lateral_normal(ring_[i], ring_[(i + 1) % ring_.size()]));
            if (surely_outside(normals_[i], box)) return false;
        }
        return true;
    }

    bool holds(int p) const {
        const Vec3i& q = s_.point(p);
        for (std::size_t k = 0; k < 3; ++k)
            if (q[k] < box_.lo[k] || q[k] > box_.hi[k]) return false;
        if (p == v_ || std::find(ring_.begin(), ring_.end(), p) != ring_.end()) return false;
        for (std::size_t i = 0; i < ring_.size(); ++i)
            if (orient3d(s_.point(v_), corner(static_cast<int>(i)),
                         corner(static_cast<int>((i + 1) % ring_.size())), q) > 0)
                return false;
        return std::any_of(dome_.begin(), dome_.end(),
                           [&](const Triangle& t) { return in_tetrahedron(t, q); });
    }

  private:
    const Vec3i& corner(int i) const { return s_.point(ring_[static_cast<std::size_t>(i)]); }

    bool in_tetrahedron(const Triangle& t, const Vec3i& q) const {
        const Vec3i &a = corner(t[0]), &b = corner(t[1]), &c = corner(t[2]), &v = s_.point(v_);
        return orient3d(a, b, c, q) >= 0 && orient3d(v, a, b, q) <= 0 &&
               orient3d(v, b, c, q) <= 0 && orient3d(v, c, a, q) <= 0;
    }

    Normal lateral_normal(int a, int b) const {
        Normal p, q;
        for (std::size_t k = 0; k < 3; ++k) {
            p[k] = static_cast<double>(s_.point(a)[k] - s_.point(v_)[k]);
            q[k] = static_cast<double>(s_.point(b)[k] - s_.point(v_)[k]);
        }
        return {p[1] * q[2] - p[2] * q[1], p[2] * q[0] - p[0] * q[2], p[0] * q[1] - p[1] * q[0]};
    }

    // The margin is far above the rounding of the products, relative to the size of the cup.
    bool surely_outside(const Normal& n, const GridBox& box) const {
        double least = 0, size = 0;
        for (std::size_t k = 0; k < 3; ++k) {
            const double lo = static_cast<double>(box.lo[k] - s_.point(v_)[k]);
            const double hi = static_cast<double>(box.hi[k] - s_.point(v_)[k]);
            least += std::min(n[k] * lo, n[k] * hi);
            size += std::max(std::abs(lo), std::abs(hi));
        }
        double extent = 0;
        for (std::size_t k = 0; k < 3; ++k)
            extent = std::max(extent, static_cast<double>(box_.hi[k] - box_.lo[k]));
        return least > 1e-12 * extent * extent * size;
    }

    const PullSurface& s_;
    int v_;
    const std::vector<int>& ring_;
    const std::vector<Triangle>& dome_;
    GridBox box_;
    mutable std::vector<Normal> normals_;  // as far as they were asked for
};

// Dome triangles grouped into plane faces; result[i] = group of triangle i.
std::vector<int> dome_faces(const PullSurface& s, const std::vector<int>& ring,
                            const std::vector<Triangle>& dome) {
    std::vector<int> group(dome.size());
    for (std::size_t i = 0; i < dome.size(); ++i) group[i] = static_cast<int>(i);
    const auto point = [&](int i) { return s.point(ring[static_cast<std::size_t>(i)]); };
    // The triangle with the reverse of each directed edge, by ring positions.
    const std::size_t n = ring.size();
    std::vector<int> across(n * n, -1);
    const auto slot = [&](int i, int j) {
        return static_cast<std::size_t>(i) * n + static_cast<std::size_t>(j);
    };
    for (std::size_t i = 0; i < dome.size(); ++i)
        for (std::size_t k = 0; k < 3; ++k)
            across[slot(dome[i][k], dome[i][(k + 1) % 3])] = static_cast<int>(i);
    for (std::size_t i = 0; i < dome.size(); ++i) {
        const Triangle& t = dome[i];
        for (std::size_t k = 0; k < 3; ++k) {
            const int other = across[slot(t[(k + 1) % 3], t[k])];
            if (other < static_cast<int>(i)) continue;
            const Triangle& o = dome[static_cast<std::size_t>(other)];
            int apex = o[0];
            for (const int v : o)
                if (v != t[k] && v != t[(k + 1) % 3]) apex = v;
            if (orient3d(point(t[0]), point(t[1]), point(t[2]), point(apex)) != 0) continue;
            const int from = group[static_cast<std::size_t>(other)], to = group[i];
            std::replace(group.begin(), group.end(), from, to);
        }
    }
    return group;
}

}  // namespace

Hindrance hindrance_of(const PullSurface& surface, const PointTree& tree, int v,
                       const std::vector<int>& ring, const std::vector<Triangle>& dome) {
    const int n = static_cast<int>(ring.size());
    if (n > 3) {
        const std::vector<int> group = dome_faces(surface, ring, dome);
        for (std::size_t g = 0; g < dome.size(); ++g) {
            std::vector<int> corners;
            for (std::size_t i = 0; i < dome.size(); ++i)
                if (group[i] == static_cast<int>(g))
                    corners.insert(corners.end(), dome[i].begin(), dome[i].end());
            std::sort(corners.begin(), corners.end());
            corners.erase(std::unique(corners.begin(), corners.end()), corners.end());
            for (std::size_t i = 0; i < corners.size(); ++i)
                for (std::size_t j = i + 1; j < corners.size(); ++j) {
                    const int gap = corners[j] - corners[i];
                    if (gap == 1 || gap == n - 1) continue;
                    const int a = ring[static_cast<std::size_t>(corners[i])];
                    const int b = ring[static_cast<std::size_t>(corners[j])];
                    if (surface.has_edge(a, b)) return {PulledKind::hindered_by_edge, a, b};
                }
        }
    }
    const ClosedCup cup(surface, v, ring, dome);
    const int witness = tree.find([&](const GridBox& box) { return cup.may_meet(box); },
                                  [&](int p) { return cup.holds(p); });
    if (witness >= 0) return {PulledKind::hindered_by_vertex, witness, -1};
    return {};
}

}  // namespace tetra
