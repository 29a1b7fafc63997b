// SPDX-License-Identifier: LGPL-2.1-or-later
// Joins the mesh of one more solid to those of finished solids, at equal points.
#pragma once

#include <array>
#include <map>
#include <set>
#include <vector>

#include "divide_tets.h"
#include "edge_chains.h"
#include "tetrahedralize_solid.h"

namespace tetra {

// What one solid is meshed from.
struct SolidSurface {
    TetInput input;             // vertices of the whole assembly
    std::vector<int> origin;    // per triangle: of the imprinted surface
    std::vector<int> old_row;   // the skin row of a finished solid on its other side, or -1
    std::vector<char> contact;  // 1 when another solid, finished or not, is on its other side
};

// Tetrahedra and skin of some solids.
struct MeshParts {
    std::vector<std::array<int, 4>> tets;
    std::vector<int> tet_solid;
    std::vector<Triangle> skin;
    std::vector<int> skin_source;  // triangles of the imprinted surface
};

// The finished solids. Each edge of a skin has all points that `chains` knows on it.
struct FinishedMeshes {
    MeshParts parts;
    std::vector<Vec3d> points;
    std::vector<int> point_source;     // vertices or -1
    std::vector<int> vertex_of_point;  // -1 away from contacts
    std::map<Vec3d, int> known;        // points by place
    EdgeChains chains;
};

struct Joined {
    std::vector<Vec3d> points;  // the finished ones, then new ones
    std::vector<int> point_source;
    EdgeChains chains;
    MeshParts fresh;    // of the new solid
    Division division;  // of finished and new meshes alike
    std::set<int> put;  // points that finished meshes get
    int shared = 0;     // points of both
};

// \throw VerificationFailed when a vertex of a contact is out of its place.
Joined join(const FinishedMeshes& finished, const SolidSurface& surface, const SolidTets& part,
            const GridSolid& grid);

// \throw VerificationFailed when a tetrahedron of the result would not be positive.
MeshParts divided_mesh(const MeshParts& mesh, const Division& division, std::vector<Vec3d>& points);

}  // namespace tetra
