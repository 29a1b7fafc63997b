// SPDX-License-Identifier: LGPL-2.1-or-later
// The stages in order, and their result as an exact mesh.
#include "cell_tets.h"

#include <algorithm>

#include "cell_tets_stages.h"
#include "emit_cups_carriers.h"

namespace tetra {
namespace {

using namespace cells;

void add_polygon(const Polygon& polygon, int key, Splits& splits) {
    for (std::size_t i = 0; i < polygon.corners.size(); ++i)
        splits.add(polygon.corners[i], polygon.corners[(i + 1) % polygon.corners.size()],
                   plane_of(key), plane_of(polygon.beyond[i]));
}

Splits find_splits(Complex& complex, const std::vector<Piece>& pieces, const std::vector<Rim>& rims,
                   const Slits& slits, Progress& progress) {
    Splits splits;
    for (const Facet& f : complex.facets) add_polygon(f.polygon, f.key, splits);
    for (const Piece& p : pieces) add_polygon(p.polygon, complex.facets[p.front].key, splits);
    for (const Rim& r : rims) splits.add(r.from, r.to, plane_of(r.key), -1);
    for (std::size_t f = 0; f < complex.facets.size(); ++f)
        for (const Segment& s : slits.of_facet[f])
            splits.add(s[0], s[1], plane_of(complex.facets[f].key), -1);
    for (std::size_t p = 0; p < pieces.size(); ++p)
        for (const Segment& s : slits.of_piece[p])
            splits.add(s[0], s[1], plane_of(complex.facets[pieces[p].front].key), -1);
    splits.find(complex, progress);
    return splits;
}

// Leaves out points that no tetrahedron uses.
void fill_mesh(const Complex& complex, const std::vector<Face>& faces, ConeTets&& cones,
               const std::vector<int>& owner_triangle, ExactMesh& mesh) {
    const int made = complex.points.points();
    std::vector<int> id(static_cast<std::size_t>(made) + cones.cone_points.size(), -1);
    std::vector<int> source, owner;
    for (const auto& t : cones.tets)
        for (const int p : t) id[p] = 0;
    for (int p = 0; p < static_cast<int>(id.size()); ++p) {
        if (id[p] < 0) continue;
        id[p] = static_cast<int>(mesh.points.size());
        mesh.points.push_back(p < made ? complex.points.exact(p) : cones.cone_points[p - made]);
        source.push_back(p < complex.points.inputs() ? p : -1);
    }
    for (const auto& t : cones.tets) mesh.tets.push_back({id[t[0]], id[t[1]], id[t[2]], id[t[3]]});
    mesh.tet_solid = std::move(cones.tet_solid);
    for (const Face& f : faces) {
        if (f.owner < 0) continue;
        mesh.skin.push_back({id[f.corners[0]], id[f.corners[1]], id[f.corners[2]]});
        mesh.skin_source.push_back(owner_triangle[f.owner]);
        owner.push_back(f.owner);
    }
    mesh.carriers = skin_carriers(mesh, owner, source);
}

}  // namespace

ExactMesh tets_of_cells(const GridSolid& solid, const std::vector<int>& owners,
                        const std::vector<Polyhedra>& cells, const std::vector<int>& solid_ids,
                        CellTetCounts& counts, Progress& progress) {
    Complex complex = make_complex(solid, cells, solid_ids);
    const std::vector<Rim> rims = find_rims(complex, solid, owners);
    const std::vector<Piece> pieces = overlay(complex, progress);
    const Slits slits = clip_rims(complex, pieces, rims);
    const Splits splits = find_splits(complex, pieces, rims, slits, progress);
    const std::vector<Face> faces =
        triangulate_faces(complex, pieces, rims, slits, splits, solid, progress);
    ConeTets cones = make_cones(complex, faces, progress);
    counts.cells = static_cast<int>(complex.cell_solid.size());
    counts.pieces = static_cast<int>(pieces.size());
    counts.cone_cells = static_cast<int>(cones.cone_points.size());
    std::vector<int> owner_triangle;
    for (std::size_t t = 0; t < owners.size(); ++t)
        if (owners[t] >= static_cast<int>(owner_triangle.size()))
            owner_triangle.push_back(static_cast<int>(t));
    ExactMesh mesh;
    fill_mesh(complex, faces, std::move(cones), owner_triangle, mesh);
    return mesh;
}

}  // namespace tetra
