// SPDX-License-Identifier: LGPL-2.1-or-later
// Bookkeeping of points, skins and contacts between the meshes of solids.
#include "tetrahedralize_contacts.h"

#include <algorithm>
#include <numeric>
#include <utility>

#include "tetra/errors.h"

namespace tetra {
namespace {

template <class T>
void append(std::vector<T>& list, const std::vector<T>& more) {
    list.insert(list.end(), more.begin(), more.end());
}

std::vector<std::size_t> order_by(const std::vector<int>& keys) {
    std::vector<std::size_t> order(keys.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return keys[a] < keys[b]; });
    return order;
}

template <class T>
std::vector<T> permuted(const std::vector<T>& list, const std::vector<std::size_t>& order) {
    std::vector<T> result;
    result.reserve(list.size());
    for (const std::size_t i : order) result.push_back(list[i]);
    return result;
}

Triangle ascending(Triangle t) {
    std::sort(t.begin(), t.end());
    return t;
}

// Per skin triangle the one of another solid with the same corners, or -1.
std::vector<int> skin_twins(const std::vector<Triangle>& skin) {
    std::vector<std::pair<Triangle, int>> sorted;
    for (std::size_t s = 0; s < skin.size(); ++s) {
        sorted.emplace_back(ascending(skin[s]), static_cast<int>(s));
    }
    std::sort(sorted.begin(), sorted.end());
    std::vector<int> twin(skin.size(), -1);
    for (std::size_t i = 0; i + 1 < sorted.size(); ++i)
        if (sorted[i].first == sorted[i + 1].first) {
            twin[sorted[i].second] = sorted[i + 1].second;
            twin[sorted[i + 1].second] = sorted[i].second;
        }
    return twin;
}

}  // namespace

bool keeps_contacts(const SolidSurface& surface, const GridSolid& grid) {
    auto left = std::count(surface.contact.begin(), surface.contact.end(), 1);
    for (std::size_t t = 0; t < grid.triangles.size(); ++t) {
        const int source = grid.triangle_source[t];
        if (!surface.contact[source]) continue;
        --left;
        for (std::size_t k = 0; k < 3; ++k)
            if (grid.point_source[grid.triangles[t][k]] != surface.input.triangles[source][k])
                return false;
    }
    return left == 0;
}

Assembly::Assembly(Imprint imprint) : imprint_(std::move(imprint)) {
    std::vector<int>& face = imprint_.surface.face;
    if (!imprint_.any()) return;
    if (face.empty()) face.assign(imprint_.surface.triangles.size(), 0);
    next_face_ = 1 + *std::max_element(face.begin(), face.end());
    for (std::size_t t = 0; t < face.size(); ++t) {
        const int other = imprint_.contact[t];
        if (other < 0) continue;
        const auto [place, fresh] =
            patch_.try_emplace({face[t], imprint_.surface.solid[other], face[other]}, next_face_);
        next_face_ += fresh;
    }
}

int Assembly::twin_solid(int triangle) const {
    const int other = imprint_.contact[triangle];
    return other < 0 ? -1 : imprint_.surface.solid[other];
}

SolidSurface Assembly::surface_of(int solid) const {
    const TetInput& all = imprint_.surface;
    SolidSurface out;
    out.input.vertices = all.vertices;
    const auto add = [&](const Triangle& t, int origin, int row, int face) {
        out.input.triangles.push_back(t);
        out.input.solid.push_back(solid);
        if (!all.face.empty()) out.input.face.push_back(face);
        out.origin.push_back(origin);
        out.old_row.push_back(row);
        out.contact.push_back(imprint_.contact[origin] >= 0);
    };
    const Division division = divided_edges();
    for (int t = 0; t < static_cast<int>(all.triangles.size()); ++t) {
        if (!all.solid.empty() && all.solid[t] != solid) continue;
        const int other = imprint_.contact[t];
        if (other >= 0 && finished_.contains(all.solid[other])) continue;
        const int face = other >= 0 ? patch_.at({all.face[t], all.solid[other], all.face[other]})
                                    : (all.face.empty() ? 0 : all.face[t]);
        for (const Triangle& part : division.parts_of(all.triangles[t])) add(part, t, -1, face);
    }
    int own_face = next_face_;
    for (std::size_t s = 0; s < meshes_.parts.skin.size(); ++s) {
        const int source = meshes_.parts.skin_source[s];
        if (twin_solid(source) != solid) continue;
        const Triangle& t = meshes_.parts.skin[s];
        add({meshes_.vertex_of_point[t[0]], meshes_.vertex_of_point[t[2]],
             meshes_.vertex_of_point[t[1]]},
            imprint_.contact[source], static_cast<int>(s), own_face++);
    }
    return out;
}

void Assembly::add(const SolidSurface& surface, SolidTets part, const GridSolid& grid) {
    Joined joined = join(meshes_, surface, part, grid);
    MeshParts& all = meshes_.parts;
    if (joined.division.any()) {
        MeshParts earlier = divided_mesh(all, joined.division, joined.points);
        joined.fresh = divided_mesh(joined.fresh, joined.division, joined.points);
        expect_twins(part.report.solid, earlier, joined.fresh);
        all = std::move(earlier);
    } else {
        expect_twins(part.report.solid, all, joined.fresh);
    }
    append(all.tets, joined.fresh.tets);
    append(all.tet_solid, joined.fresh.tet_solid);
    append(all.skin, joined.fresh.skin);
    append(all.skin_source, joined.fresh.skin_source);
    if (!imprint_.surface.solid.empty())
        for (std::size_t p = meshes_.points.size(); p < joined.points.size(); ++p)
            meshes_.known.try_emplace(joined.points[p], static_cast<int>(p));
    meshes_.points = std::move(joined.points);
    meshes_.point_source = std::move(joined.point_source);
    meshes_.point_source.resize(meshes_.points.size(), -1);
    meshes_.chains = std::move(joined.chains);
    report_.shared_points += joined.shared;
    report_.contact_points += static_cast<int>(joined.put.size());
    finished_.insert(part.report.solid);
    report_.solids.push_back(std::move(part.report));
    name_points_of_contacts();
}

void Assembly::expect_twins(int solid, const MeshParts& earlier, const MeshParts& fresh) const {
    std::vector<Triangle> there, here;
    for (std::size_t s = 0; s < earlier.skin.size(); ++s)
        if (twin_solid(earlier.skin_source[s]) == solid)
            there.push_back(ascending(earlier.skin[s]));
    for (std::size_t s = 0; s < fresh.skin.size(); ++s)
        if (finished_.contains(twin_solid(fresh.skin_source[s])))
            here.push_back(ascending(fresh.skin[s]));
    std::sort(there.begin(), there.end());
    std::sort(here.begin(), here.end());
    if (there != here)
        throw VerificationFailed("a solid can't keep the triangles of a contact as they are");
}

// They are vertices for the solids to come.
void Assembly::name_points_of_contacts() {
    meshes_.vertex_of_point.resize(meshes_.points.size(), -1);
    std::vector<Vec3d>& vertices = imprint_.surface.vertices;
    for (std::size_t s = 0; s < meshes_.parts.skin.size(); ++s) {
        if (imprint_.contact[meshes_.parts.skin_source[s]] < 0) continue;
        for (const int p : meshes_.parts.skin[s]) {
            int& vertex = meshes_.vertex_of_point[p];
            if (vertex >= 0) continue;
            vertex = meshes_.point_source[p];
            if (vertex < 0) {
                vertex = static_cast<int>(vertices.size());
                vertices.emplace_back();
            }
            vertices[vertex] = meshes_.points[p];
        }
    }
}

// Points of finished meshes on edges, as vertices.
Division Assembly::divided_edges() const {
    Division division;
    for (const auto& [edge, chain] : meshes_.chains.chains()) {
        std::vector<int> vertices;
        for (const int p : chain) vertices.push_back(meshes_.vertex_of_point[p]);
        if (vertices.front() > vertices.back()) std::reverse(vertices.begin(), vertices.end());
        division.on_edge[{vertices.front(), vertices.back()}] = {vertices.begin() + 1,
                                                                 vertices.end() - 1};
    }
    return division;
}

// Solids that had to go first go back to their places.
void Assembly::in_order_of_solids() {
    MeshParts& all = meshes_.parts;
    const auto tets = order_by(all.tet_solid);
    std::vector<int> solid_of_row, solid_of_report;
    for (const int t : all.skin_source)
        solid_of_row.push_back(imprint_.surface.solid.empty() ? 0 : imprint_.surface.solid[t]);
    for (const SolidReport& r : report_.solids) solid_of_report.push_back(r.solid);
    const auto rows = order_by(solid_of_row);
    const auto reports = order_by(solid_of_report);
    all.tets = permuted(all.tets, tets);
    all.tet_solid = permuted(all.tet_solid, tets);
    all.skin = permuted(all.skin, rows);
    all.skin_source = permuted(all.skin_source, rows);
    report_.solids = permuted(report_.solids, reports);
}

TetResult Assembly::take(std::size_t vertices_of_caller) {
    in_order_of_solids();
    TetResult result;
    result.skin_twin = skin_twins(meshes_.parts.skin);
    int open = 0;
    for (std::size_t s = 0; s < result.skin_twin.size(); ++s)
        open += twin_solid(meshes_.parts.skin_source[s]) >= 0 && result.skin_twin[s] < 0;
    if (open > 0)
        throw VerificationFailed("solids in contact have different triangles on " +
                                 std::to_string(open) + " places of their common faces");
    result.points = std::move(meshes_.points);
    result.point_source = std::move(meshes_.point_source);
    for (int& v : result.point_source)
        if (v >= static_cast<int>(vertices_of_caller)) v = -1;
    result.tets = std::move(meshes_.parts.tets);
    result.tet_solid = std::move(meshes_.parts.tet_solid);
    result.skin = std::move(meshes_.parts.skin);
    result.skin_source = std::move(meshes_.parts.skin_source);
    for (int& t : result.skin_source) t = imprint_.source[t];
    result.report = std::move(report_);
    result.report.snap.merged_points += imprint_.merged_points;
    return result;
}

}  // namespace tetra
