// SPDX-License-Identifier: LGPL-2.1-or-later
// The conditions of a peel: without the area rules the skin can fold.
#include "peel.h"

#include <algorithm>
#include <cmath>

#include "tetra/assemble/tet_quality.h"
#include "vec3.h"

namespace tetra {
namespace {

std::size_t at(int i) { return static_cast<std::size_t>(i); }

// The pairs (first, second) of faces seen from outside the quadrangle must tile it alike.
bool same_area(const std::array<Vec3d, 4>& corner, const std::array<int, 2>& old_faces,
               const std::array<int, 2>& new_faces, double tolerance) {
    double area[2] = {0, 0};
    Vec3d sum[2] = {{0, 0, 0}, {0, 0, 0}};
    for (int pair = 0; pair < 2; ++pair)
        for (int face : pair == 0 ? old_faces : new_faces) {
            const int* f = kFace[face];
            const Vec3d n = normal_of(corner[at(f[0])], corner[at(f[1])], corner[at(f[2])]);
            area[pair] += norm(n);
            for (std::size_t k = 0; k < 3; ++k) sum[pair][k] += n[k];
        }
    const double least = area[0] * (1 - tolerance), most = area[0] * (1 + tolerance);
    return area[1] >= least && area[1] <= most && norm(sum[0]) >= least && norm(sum[1]) >= least;
}

// Least height of a triangle.
double altitude(const Vec3d& a, const Vec3d& b, const Vec3d& c) {
    const double longest = std::max({norm(minus(b, a)), norm(minus(c, b)), norm(minus(a, c))});
    return longest > 0 ? norm(normal_of(a, b, c)) / longest : 0;
}

bool on_skin(TetComplex& mesh, int a, int b) {
    for (int t : mesh.star_of(a)) {
        const Tet& v = mesh.tet(t);
        if (!TetComplex::contains(v, b)) continue;
        for (int i = 0; i < 4; ++i)
            if (v[at(i)] != a && v[at(i)] != b && mesh.neighbour(t, i) < 0) return true;
    }
    return false;
}

}  // namespace

bool may_peel(TetComplex& mesh, int t, const std::vector<Vec3d>& places) {
    std::array<int, 2> skin, inner;
    std::size_t skins = 0, inners = 0;
    for (int i = 0; i < 4; ++i) {
        if (mesh.neighbour(t, i) < 0) {
            if (skins == 2) return false;
            skin[skins++] = i;
        } else {
            if (inners == 2) return false;
            inner[inners++] = i;
        }
    }
    const FacetClass& one = mesh.facet_class(~mesh.neighbour(t, skin[0]));
    const FacetClass& two = mesh.facet_class(~mesh.neighbour(t, skin[1]));
    if (one.face != two.face) return false;
    const Tet& v = mesh.tet(t);
    std::array<Vec3d, 4> caller, grid;
    for (std::size_t k = 0; k < 4; ++k) {
        caller[k] = places[at(v[k])];
        grid[k] = mesh.grid_place(v[k]);
    }
    const double least = 1e-3 * mesh.grid().step;
    const auto flat = [&](const Tet& u) {
        return std::fabs(least_height(places[at(u[0])], places[at(u[1])], places[at(u[2])],
                                      places[at(u[3])])) < least;
    };
    if (!flat(v)) return false;
    // No tetrahedron has a volume on a triangle whose corners are in one line.
    for (int i : inner) {
        const int* f = kFace[i];
        if (altitude(caller[at(f[0])], caller[at(f[1])], caller[at(f[2])]) < least) return false;
    }
    // A flat neighbour with three skin faces would be left: nothing could free its tip.
    for (int i : inner) {
        const int below = mesh.neighbour(t, i) / 4;
        int skin_faces = 1;
        for (int k = 0; k < 4; ++k) skin_faces += mesh.neighbour(below, k) < 0;
        if (skin_faces > 2 && flat(mesh.tet(below))) return false;
    }
    if (!same_area(caller, skin, inner, 1e-9) || !same_area(grid, skin, inner, 1e-4)) return false;
    // The skin faces miss one corner each: these two corners make the new edge.
    return !on_skin(mesh, v[at(skin[0])], v[at(skin[1])]);
}

}  // namespace tetra
