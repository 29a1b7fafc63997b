// SPDX-License-Identifier: LGPL-2.1-or-later
// A changing triangle soup with owners, searchable from each vertex.
#pragma once

#include <vector>

#include "tetra/solid/grid_solid.h"

namespace tetra {

// star[v] lists the live triangles at v. Dead triangles keep their data so that a change can be
// taken back.
struct PullSurface {
    PullSurface(const std::vector<Vec3i>& grid_points, const std::vector<Triangle>& input,
                const std::vector<int>& input_owners);

    int add(const Triangle& triangle, int owner);
    void remove(int id);
    void revive(int id);

    bool has_edge(int a, int b) const;
    // The live triangle with the directed edges ab, bc, ca; -1 if there is none.
    int find(int a, int b, int c) const;
    // Sharp unless exactly two coplanar triangles of one owner meet there; false without triangle.
    bool is_sharp(int a, int b) const;

    const Vec3i& point(int id) const { return points[static_cast<std::size_t>(id)]; }
    const std::vector<int>& star_of(int v) const { return star[static_cast<std::size_t>(v)]; }
    const Triangle& triangle(int id) const { return triangles[static_cast<std::size_t>(id)]; }
    int owner(int id) const { return owners[static_cast<std::size_t>(id)]; }

    const std::vector<Vec3i>& points;
    std::vector<Triangle> triangles;
    std::vector<int> owners;
    std::vector<char> alive;
    std::vector<std::vector<int>> star;
};

}  // namespace tetra
