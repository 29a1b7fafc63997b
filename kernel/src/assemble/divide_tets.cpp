// SPDX-License-Identifier: LGPL-2.1-or-later
// Faces first, by a rule that both sides share; then a cone.
#include "divide_tets.h"

#include <algorithm>

#include "tet_complex.h"
#include "tetra/assemble/double_predicates.h"
#include "tetra/errors.h"

namespace tetra {
namespace {

std::pair<int, int> edge(int u, int v) { return {std::min(u, v), std::max(u, v)}; }

Triangle ascending(Triangle t) {
    std::sort(t.begin(), t.end());
    return t;
}

bool contains(const Triangle& t, int p) { return t[0] == p || t[1] == p || t[2] == p; }

// Fans over the first divided edge (by ids), then the same for the parts.
void divide_triangle(const Triangle& t, const Division& division, std::vector<Triangle>& parts) {
    std::size_t first = 3;
    for (std::size_t k = 0; k < 3; ++k) {
        if (!division.on_edge.contains(edge(t[k], t[(k + 1) % 3]))) continue;
        if (first == 3 || edge(t[k], t[(k + 1) % 3]) < edge(t[first], t[(first + 1) % 3]))
            first = k;
    }
    if (first == 3) {
        parts.push_back(t);
        return;
    }
    const int a = t[first], b = t[(first + 1) % 3], c = t[(first + 2) % 3];
    std::vector<int> chain = division.on_edge.at(edge(a, b));
    if (a > b) std::reverse(chain.begin(), chain.end());
    chain.push_back(b);
    int last = a;
    for (const int v : chain) divide_triangle({std::exchange(last, v), v, c}, division, parts);
}

}  // namespace

bool Division::touches(const Triangle& t) const {
    for (std::size_t k = 0; k < 3; ++k)
        if (on_edge.contains(edge(t[k], t[(k + 1) % 3]))) return true;
    return faces.contains(ascending(t));
}

std::vector<Triangle> Division::parts_of(const Triangle& triangle) const {
    const auto given = faces.find(ascending(triangle));
    if (given != faces.end()) return given->second;
    std::vector<Triangle> parts;
    divide_triangle(triangle, *this, parts);
    return parts;
}

std::vector<std::array<int, 4>> divided(const std::array<int, 4>& tet, const Division& division,
                                        std::vector<Vec3d>& points) {
    std::vector<Triangle> sides;
    std::array<bool, 4> fanned{true, true, true, true};
    for (int i = 0; i < 4; ++i) {
        const Triangle face{tet[kFace[i][0]], tet[kFace[i][1]], tet[kFace[i][2]]};
        for (const Triangle& part : division.parts_of(face)) {
            sides.push_back(part);
            for (int c = 0; c < 4; ++c)
                if (c != i && !contains(part, tet[c])) fanned[c] = false;
        }
    }
    const auto corner = std::find(fanned.begin(), fanned.end(), true);
    int apex = -1;
    if (corner != fanned.end()) {
        apex = tet[corner - fanned.begin()];
    } else {
        Vec3d middle{0, 0, 0};
        for (const int p : tet)
            for (std::size_t k = 0; k < 3; ++k) middle[k] += points[p][k] / 4;
        apex = static_cast<int>(points.size());
        points.push_back(middle);
    }
    std::vector<std::array<int, 4>> parts;
    for (const Triangle& t : sides) {
        if (contains(t, apex)) continue;
        if (orient3d(points[t[0]], points[t[2]], points[t[1]], points[apex]) <= 0)
            throw VerificationFailed("a tetrahedron at a contact of solids is too thin to divide");
        parts.push_back({t[0], t[2], t[1], apex});
    }
    return parts;
}

}  // namespace tetra
