// SPDX-License-Identifier: LGPL-2.1-or-later
// Components, volumes, and containment by parity along a vertical ray.
#include "tetra/solid/shells.h"

#include <cassert>
#include <map>

#include "tetra/exact/predicates.h"
#include "tetra/solid/edges.h"

namespace tetra {
namespace {

Int256 magnitude(const Int256& v) { return v.negative() ? -v : v; }

struct Normal {
    Int128 x, y, z;
};

// The ray starts at the centroid of a triangle ("base"), shifted by (e, e^2) in x and y within its
// plane and by a still smaller amount to the inner side of the triangle (the outer side if
// `outside`), and goes up.
class Ray {
  public:
    Ray(const GridSolid& s, int base, bool outside) : s_(s), base_(base), normal_(normal(base)) {
        starts_above_ = (sign_of(normal_.z) > 0) == outside;
        for (std::size_t k = 0; k < 3; ++k)
            sum_[k] = corner(base, 0)[k] + corner(base, 1)[k] + corner(base, 2)[k];
    }

    // Box of all triangles that can be met.
    Box reach(const Box& all) const {
        Box b = all;
        for (std::size_t k = 0; k < 2; ++k) {
            b.low[k] = floor_third(sum_[k]);
            b.high[k] = b.low[k] + 1;
        }
        b.low[2] = floor_third(sum_[2]);
        return b;
    }

    // +1 when the ray leaves the oriented triangle's solid through it, -1 when it enters, 0 when
    // it does not meet it.
    int crosses(int t) const {
        const Int128 nz = normal(t).z;
        if (nz == 0 || !covers(t, sign_of(nz))) return 0;
        return above(t) ? sign_of(nz) : 0;
    }

  private:
    const Vec3i& corner(int t, int i) const {
        return s_.points[static_cast<std::size_t>(
            s_.triangles[static_cast<std::size_t>(t)][static_cast<std::size_t>(i % 3)])];
    }
    Normal normal(int t) const {
        const Vec3i &a = corner(t, 0), &b = corner(t, 1), &c = corner(t, 2);
        const Int128 ux = b[0] - a[0], uy = b[1] - a[1], uz = b[2] - a[2];
        const Int128 vx = c[0] - a[0], vy = c[1] - a[1], vz = c[2] - a[2];
        return {uy * vz - uz * vy, uz * vx - ux * vz, ux * vy - uy * vx};
    }
    static std::int64_t floor_third(std::int64_t v) { return v >= 0 ? v / 3 : -((2 - v) / 3); }

    // Is the shifted start strictly left of the edge p -> q in the plan, all turned by `turn`?
    bool left_of(const Vec3i& p, const Vec3i& q, int turn) const {
        const std::int64_t dx = q[0] - p[0], dy = q[1] - p[1];
        const Int128 cross = static_cast<Int128>(dx) * (sum_[1] - 3 * p[1]) -
                             static_cast<Int128>(dy) * (sum_[0] - 3 * p[0]);
        // d(cross)/d(shift) = (-dy, dx) for the shift (e, e^2).
        const int side =
            cross != 0 ? sign_of(cross) : (dy != 0 ? (dy < 0 ? 1 : -1) : (dx > 0 ? 1 : -1));
        return side * turn > 0;
    }
    bool covers(int t, int turn) const {
        return left_of(corner(t, 0), corner(t, 1), turn) &&
               left_of(corner(t, 1), corner(t, 2), turn) &&
               left_of(corner(t, 2), corner(t, 0), turn);
    }

    // Is t above the start on the ray?
    bool above(int t) const {
        const Normal n = normal(t);
        Int128 height = 0;  // of the centroid over the plane of t, times 3 |n|
        for (int i = 0; i < 3; ++i)
            height += det3_of_points(corner(t, 0), corner(t, 1), corner(t, 2), corner(base_, i));
        int side = sign_of(height);
        // Moving by dx = 1 (dy = 1) in the plane of the base changes the height by
        // (n.x m.z - n.z m.x) / m.z, and likewise in y.
        if (side == 0) side = slope(n.x, n.z, normal_.x, normal_.z) * sign_of(normal_.z);
        if (side == 0) side = slope(n.y, n.z, normal_.y, normal_.z) * sign_of(normal_.z);
        if (side == 0) return !starts_above_;  // coplanar with the base, or the base itself
        return side * sign_of(n.z) < 0;
    }
    static int slope(Int128 na, Int128 nz, Int128 ma, Int128 mz) {
        return (multiply<4>(WideInt<2>(na), WideInt<2>(mz)) -
                multiply<4>(WideInt<2>(nz), WideInt<2>(ma)))
            .sign();
    }

    const GridSolid& s_;
    int base_;
    Normal normal_;
    bool starts_above_;
    Vec3i sum_;
};

// A triangle of each shell that is not vertical.
std::vector<int> base_triangles(const GridSolid& s, const Shells& shells) {
    std::vector<int> base(shells.volume.size(), -1);
    for (std::size_t t = 0; t < s.triangles.size(); ++t) {
        int& b = base[static_cast<std::size_t>(shells.of[t])];
        const Triangle& c = s.triangles[t];
        if (b < 0 && orient2d(s.points[static_cast<std::size_t>(c[0])],
                              s.points[static_cast<std::size_t>(c[1])],
                              s.points[static_cast<std::size_t>(c[2])]) != 0)
            b = static_cast<int>(t);
    }
    return base;
}

int solid_of(const GridSolid& s, const Shells& shells, int shell) {
    return s
        .solid[static_cast<std::size_t>(shells.first_triangle[static_cast<std::size_t>(shell)])];
}

// Winding number of every shell met by the ray around its start.
std::map<int, int> shells_around(const Ray& ray, const Shells& shells, const BoxTree& tree) {
    std::map<int, int> winding;
    for_boxes_touching(tree, ray.reach(tree.nodes.front().box), [&](int t) {
        if (const int c = ray.crosses(t); c != 0)
            winding[shells.of[static_cast<std::size_t>(t)]] += c;
    });
    return winding;
}

}  // namespace

Shells find_shells(std::span<const Vec3i> points, std::span<const Triangle> triangles,
                   std::span<const int> twin) {
    Shells shells;
    shells.of.assign(triangles.size(), -1);
    std::vector<int> stack;
    for (std::size_t start = 0; start < triangles.size(); ++start) {
        if (shells.of[start] >= 0) continue;
        const int id = static_cast<int>(shells.volume.size());
        shells.first_triangle.push_back(static_cast<int>(start));
        Int256 volume = 0;
        shells.of[start] = id;
        stack.push_back(static_cast<int>(start));
        while (!stack.empty()) {
            const int t = stack.back();
            stack.pop_back();
            const Triangle& c = triangles[static_cast<std::size_t>(t)];
            // The determinant of three points: at most 3b+3 bits.
            volume += Int256(det3_of_points({0, 0, 0}, points[static_cast<std::size_t>(c[0])],
                                            points[static_cast<std::size_t>(c[1])],
                                            points[static_cast<std::size_t>(c[2])]));
            for (int h = 3 * t; h < 3 * t + 3; ++h) {
                const int other = twin[static_cast<std::size_t>(h)] / 3;
                if (shells.of[static_cast<std::size_t>(other)] >= 0) continue;
                shells.of[static_cast<std::size_t>(other)] = id;
                stack.push_back(other);
            }
        }
        shells.volume.push_back(volume);
    }
    return shells;
}

Nesting nest_shells(const GridSolid& surface, const Shells& shells, const BoxTree& tree) {
    const std::size_t n = shells.volume.size();
    Nesting nesting{std::vector<int>(n, -1), std::vector<int>(n, 0)};
    if (n < 2) return nesting;
    const std::vector<int> base = base_triangles(surface, shells);
    for (std::size_t x = 0; x < n; ++x) {
        assert(base[x] >= 0);
        // Inside the region that the shell bounds, whichever way it faces.
        const std::map<int, int> around =
            shells_around({surface, base[x], shells.volume[x].negative()}, shells, tree);
        const Int256 size = magnitude(shells.volume[x]);
        for (const auto& [y, turns] : around) {
            if (turns == 0 || y == static_cast<int>(x)) continue;
            if (solid_of(surface, shells, y) != solid_of(surface, shells, static_cast<int>(x)))
                continue;
            // Of two shells around a point the smaller is in the larger; equal ones by number.
            const Int256 other = magnitude(shells.volume[static_cast<std::size_t>(y)]);
            if (other < size || (other == size && y > static_cast<int>(x))) continue;
            ++nesting.depth[x];
            int& p = nesting.parent[x];
            if (p < 0 || other <= magnitude(shells.volume[static_cast<std::size_t>(p)])) p = y;
        }
    }
    return nesting;
}

std::vector<std::array<int, 2>> find_overlapping_solids(const GridSolid& surface,
                                                        const Shells& shells, const BoxTree& tree) {
    std::vector<std::array<int, 2>> found;
    const std::vector<int> base = base_triangles(surface, shells);
    for (std::size_t x = 0; x < base.size(); ++x) {
        const std::map<int, int> around = shells_around({surface, base[x], false}, shells, tree);
        std::map<int, std::array<int, 2>> solids;  // winding and last shell
        for (const auto& [y, turns] : around) {
            auto& [sum, last] = solids[solid_of(surface, shells, y)];
            sum += turns;
            if (turns > 0) last = y;
        }
        for (const auto& [solid, entry] : solids)
            if (solid != solid_of(surface, shells, static_cast<int>(x)) && entry[0] != 0)
                found.push_back({static_cast<int>(x), entry[1]});
    }
    return found;
}

}  // namespace tetra
