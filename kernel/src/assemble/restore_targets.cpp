// SPDX-License-Identifier: LGPL-2.1-or-later
// The surface edge or triangle that holds a Steiner point on the grid, and its image.
#include "restore_targets.h"

#include <algorithm>
#include <limits>
#include <unordered_set>
#include <utility>

#include "vec3.h"

namespace tetra {
namespace {

std::size_t at(int i) { return static_cast<std::size_t>(i); }

Vec3d blend(const Vec3d& a, double ta, const Vec3d& b, double tb) {
    return {a[0] * ta + b[0] * tb, a[1] * ta + b[1] * tb, a[2] * ta + b[2] * tb};
}

class Locator {
  public:
    Locator(const GridSolid& solid, const FacetClasses& classes, const std::vector<Vec3d>& vertices)
        : solid_(solid), classes_(classes), vertices_(vertices), members_(classes.classes.size()) {
        for (std::size_t k = 0; k < classes.of_triangle.size(); ++k) {
            members_[at(classes.of_triangle[k])].push_back(static_cast<int>(k));
            const Triangle& t = solid.triangles[k];
            for (std::size_t i = 0; i < 3; ++i) edges_.insert(key(t[i], t[(i + 1) % 3]));
        }
    }

    bool is_edge(int a, int b) const { return edges_.count(key(a, b)) || edges_.count(key(b, a)); }

    // Where p is on the surface edge from a to b.
    Vec3d between(const Vec3d& p, int a, int b) const {
        if (a > b) std::swap(a, b);  // the same image whatever the order
        const Vec3d pa = corner(a), ab = minus(corner(b), pa);
        const double t = std::clamp(dot(minus(p, pa), ab) / dot(ab, ab), 0.0, 1.0);
        return blend(caller(a), 1, minus(caller(b), caller(a)), t);
    }

    const Vec3d& caller(int grid_point) const {
        return vertices_[at(solid_.point_source[at(grid_point)])];
    }

    // Of the edges of all triangles of the classes the one nearest to p that p projects into.
    Vec3d on_edge(const Vec3d& p, const std::vector<int>& classes) const {
        double best = std::numeric_limits<double>::infinity();
        int best_a = -1, best_b = -1;
        for (int c : classes)
            for (int k : members_[at(c)]) {
                const Triangle& tri = solid_.triangles[at(k)];
                for (std::size_t i = 0; i < 3; ++i) {
                    const int a = tri[i], b = tri[(i + 1) % 3];
                    const Vec3d pa = corner(a), ab = minus(corner(b), pa);
                    const double t = std::clamp(dot(minus(p, pa), ab) / dot(ab, ab), 0.0, 1.0);
                    const Vec3d off = minus(p, blend(pa, 1, ab, t));
                    if (dot(off, off) >= best) continue;
                    best = dot(off, off);
                    best_a = a;
                    best_b = b;
                }
            }
        return between(p, best_a, best_b);
    }

    // In the triangle of the facet of `hint` in which p lies deepest; `hint` itself if it holds p.
    Vec3d in_facet(const Vec3d& p, int hint) const {
        Vec3d weights = barycentric(p, hint);
        double best = std::min({weights[0], weights[1], weights[2]});
        int found = hint;
        for (int k : members_[at(classes_.of_triangle[at(hint)])]) {
            if (best >= 0) break;
            const Vec3d w = barycentric(p, k);
            const double depth = std::min({w[0], w[1], w[2]});
            if (depth <= best) continue;
            best = depth;
            weights = w;
            found = k;
        }
        const Triangle& t = solid_.triangles[at(found)];
        const Vec3d a = caller(t[0]);
        const Vec3d ab = blend(a, 1, minus(caller(t[1]), a), weights[1]);
        return blend(ab, 1, minus(caller(t[2]), a), weights[2]);
    }

  private:
    Vec3d corner(int grid_point) const {
        const Vec3i& p = solid_.points[at(grid_point)];
        return {static_cast<double>(p[0]), static_cast<double>(p[1]), static_cast<double>(p[2])};
    }

    Vec3d barycentric(const Vec3d& p, int k) const {
        const Triangle& t = solid_.triangles[at(k)];
        const Vec3d a = corner(t[0]), b = corner(t[1]), c = corner(t[2]);
        const Vec3d n = cross(minus(b, a), minus(c, a));
        const double nn = dot(n, n);
        const double u = dot(cross(minus(b, p), minus(c, p)), n) / nn;
        const double v = dot(cross(minus(c, p), minus(a, p)), n) / nn;
        return {u, v, 1 - u - v};
    }

    const GridSolid& solid_;
    const FacetClasses& classes_;
    const std::vector<Vec3d>& vertices_;
    static std::uint64_t key(int a, int b) {
        return static_cast<std::uint64_t>(a) << 32 | static_cast<std::uint32_t>(b);
    }

    std::vector<std::vector<int>> members_;
    std::unordered_set<std::uint64_t> edges_;
};

std::vector<int> classes_at(TetComplex& mesh, int p) {
    std::vector<int> classes;
    for (int t : mesh.star_of(p))
        for (int i = 0; i < 4; ++i)
            if (mesh.neighbour(t, i) < 0 && mesh.tet(t)[at(i)] != p)
                classes.push_back(~mesh.neighbour(t, i));
    std::sort(classes.begin(), classes.end());
    classes.erase(std::unique(classes.begin(), classes.end()), classes.end());
    return classes;
}

}  // namespace

RestoreTargets restore_targets(TetComplex& mesh, const GridSolid& solid,
                               const FacetClasses& classes, const std::vector<Vec3d>& vertices) {
    const Locator locator(solid, classes, vertices);
    RestoreTargets out;
    for (int p = 0; p < mesh.point_count(); ++p) {
        const Carrier& c = mesh.carrier(p);
        Vec3d place = mesh.place(p);
        const bool used = c.kind == CarrierKind::vertex || !mesh.star_of(p).empty();
        if (c.kind == CarrierKind::vertex) {
            place = locator.caller(c.first);
        } else if (used && c.kind == CarrierKind::facet) {
            place = locator.in_facet(mesh.grid_place(p), c.first);
        } else if (used && c.kind == CarrierKind::edge) {
            place = locator.is_edge(c.first, c.second)
                        ? locator.between(mesh.grid_place(p), c.first, c.second)
                        : locator.on_edge(mesh.grid_place(p), classes_at(mesh, p));
        }
        out.place.push_back(place);
        out.bound.push_back(used && c.kind != CarrierKind::inner);
    }
    return out;
}

}  // namespace tetra
