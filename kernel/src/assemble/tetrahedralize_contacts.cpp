// SPDX-License-Identifier: LGPL-2.1-or-later
// Bookkeeping of points, skins and contacts between the meshes of solids.
#include "tetrahedralize_contacts.h"

#include <algorithm>
#include <utility>

#include "divide_tets.h"
#include "tetra/errors.h"
#include "vec3.h"

namespace tetra {
namespace {

// The mesh of one solid on its way into the whole.
class Joining {
  public:
    Joining(const TetResult& whole, const std::vector<int>& vertex_of_point,
            const std::map<Vec3d, int>& known, const SolidSurface& surface, const SolidTets& part,
            const GridSolid& grid)
        : whole_(whole), known_(known), surface_(surface), part_(part), grid_(grid) {
        points = whole.points;
        point_source = whole.point_source;
        for (std::size_t p = 0; p < vertex_of_point.size(); ++p)
            if (vertex_of_point[p] >= 0) point_of_vertex_[vertex_of_point[p]] = static_cast<int>(p);
    }

    void run() {
        for (std::size_t p = 0; p < part_.points.size(); ++p) id.push_back(point_of(p));
        find_division();
    }

    std::vector<Vec3d> points;
    std::vector<int> point_source, id;
    Division division;  // of the earlier meshes
    int shared = 0, divided_at = 0;

  private:
    int point_of(std::size_t p) {
        const Vec3d& place = part_.points[p];
        const int vertex = part_.point_source[p];
        if (vertex >= 0) {
            if (const auto at = point_of_vertex_.find(vertex); at != point_of_vertex_.end()) {
                if (points[at->second] != place)
                    throw VerificationFailed("a vertex of a contact can't be kept in its place");
                ++shared;
                return at->second;
            }
        }
        if (const auto at = known_.find(place); at != known_.end()) {
            ++shared;
            if (point_source[at->second] < 0) point_source[at->second] = vertex;
            return at->second;
        }
        points.push_back(place);
        point_source.push_back(vertex);
        return static_cast<int>(points.size()) - 1;
    }

    // Where the new mesh divides triangles that it took over.
    void find_division() {
        std::map<int, std::vector<Triangle>> parts;  // per earlier skin row, its way round
        std::vector<char> done(part_.points.size(), 0);
        for (std::size_t s = 0; s < part_.mesh.skin.size(); ++s) {
            const int row = surface_.old_row[grid_.triangle_source[part_.mesh.skin_source[s]]];
            if (row < 0) continue;
            const Triangle& t = part_.mesh.skin[s];
            parts[row].push_back({id[t[0]], id[t[2]], id[t[1]]});
            for (const int p : t)
                if (part_.point_source[p] < 0 && !std::exchange(done[p], 1)) note_point(p);
        }
        for (auto& [edge, list] : division.on_edge) {
            const Vec3d& start = points[edge.first];
            const auto distance = [&](int p) {
                const Vec3d d = minus(points[p], start);
                return dot(d, d);
            };
            std::sort(list.begin(), list.end(),
                      [&](int p, int q) { return distance(p) < distance(q); });
        }
        for (auto& [row, list] : parts) {
            if (list.size() == 1) continue;
            Triangle key = whole_.skin[row];
            std::sort(key.begin(), key.end());
            division.faces[key] = std::move(list);
        }
    }

    void note_point(int p) {
        ++divided_at;
        const Carrier& carrier = part_.mesh.carriers[p];
        if (carrier.kind != CarrierKind::edge) return;
        const int u = point_of_vertex_.at(grid_.point_source[carrier.first]),
                  v = point_of_vertex_.at(grid_.point_source[carrier.second]);
        division.on_edge[{std::min(u, v), std::max(u, v)}].push_back(id[p]);
    }

    const TetResult& whole_;
    const std::map<Vec3d, int>& known_;
    const SolidSurface& surface_;
    const SolidTets& part_;
    const GridSolid& grid_;
    std::map<int, int> point_of_vertex_;
};

// The tetrahedra and the skin of the earlier solids, divided.
void divide_mesh(const Division& division, std::vector<Vec3d>& points, TetResult& mesh) {
    std::vector<std::array<int, 4>> tets;
    std::vector<int> solid;
    for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
        const std::array<int, 4>& v = mesh.tets[t];
        const bool touched =
            division.touches({v[1], v[2], v[3]}) || division.touches({v[0], v[3], v[2]}) ||
            division.touches({v[0], v[1], v[3]}) || division.touches({v[0], v[2], v[1]});
        const std::vector<std::array<int, 4>> parts =
            touched ? divided(v, division, points) : std::vector{v};
        tets.insert(tets.end(), parts.begin(), parts.end());
        solid.insert(solid.end(), parts.size(), mesh.tet_solid[t]);
    }
    std::vector<Triangle> skin;
    std::vector<int> source;
    for (std::size_t s = 0; s < mesh.skin.size(); ++s)
        for (const Triangle& part : division.parts_of(mesh.skin[s])) {
            skin.push_back(part);
            source.push_back(mesh.skin_source[s]);
        }
    mesh.tets = std::move(tets);
    mesh.tet_solid = std::move(solid);
    mesh.skin = std::move(skin);
    mesh.skin_source = std::move(source);
}

// Per skin triangle the one of another solid with the same corners, or -1.
std::vector<int> skin_twins(const std::vector<Triangle>& skin) {
    std::vector<std::pair<Triangle, int>> sorted;
    for (std::size_t s = 0; s < skin.size(); ++s) {
        Triangle t = skin[s];
        std::sort(t.begin(), t.end());
        sorted.emplace_back(t, static_cast<int>(s));
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
    };
    for (int t = 0; t < static_cast<int>(all.triangles.size()); ++t) {
        if (!all.solid.empty() && all.solid[t] != solid) continue;
        const int other = imprint_.contact[t];
        if (other < 0)
            add(all.triangles[t], t, -1, all.face.empty() ? 0 : all.face[t]);
        else if (!finished_.contains(all.solid[other]))
            add(all.triangles[t], t, -1,
                patch_.at({all.face[t], all.solid[other], all.face[other]}));
    }
    int own_face = next_face_;
    for (std::size_t s = 0; s < result_.skin.size(); ++s) {
        const int source = result_.skin_source[s];
        if (twin_solid(source) != solid) continue;
        const Triangle& t = result_.skin[s];
        add({vertex_of_point_[t[0]], vertex_of_point_[t[2]], vertex_of_point_[t[1]]},
            imprint_.contact[source], static_cast<int>(s), own_face++);
    }
    return out;
}

void Assembly::add(const SolidSurface& surface, SolidTets part, const GridSolid& grid) {
    Joining joining(result_, vertex_of_point_, known_, surface, part, grid);
    joining.run();
    if (!joining.division.on_edge.empty() || !joining.division.faces.empty())
        divide_mesh(joining.division, joining.points, result_);
    const auto placed = [&](auto ids) {
        for (int& p : ids) p = joining.id[p];
        return ids;
    };
    for (const auto& tet : part.mesh.tets) result_.tets.push_back(placed(tet));
    result_.tet_solid.insert(result_.tet_solid.end(), part.mesh.tet_solid.begin(),
                             part.mesh.tet_solid.end());
    for (std::size_t s = 0; s < part.mesh.skin.size(); ++s) {
        result_.skin.push_back(placed(part.mesh.skin[s]));
        result_.skin_source.push_back(
            surface.origin[grid.triangle_source[part.mesh.skin_source[s]]]);
    }
    result_.points = std::move(joining.points);
    result_.point_source = std::move(joining.point_source);
    result_.point_source.resize(result_.points.size(), -1);
    result_.report.shared_points += joining.shared;
    result_.report.contact_points += joining.divided_at;
    finished_.insert(part.report.solid);
    result_.report.solids.push_back(std::move(part.report));
    if (!imprint_.surface.solid.empty())
        for (const int p : joining.id) known_.try_emplace(result_.points[p], p);
    // Points on contacts are vertices for the solids to come.
    vertex_of_point_.resize(result_.points.size(), -1);
    std::vector<Vec3d>& vertices = imprint_.surface.vertices;
    for (std::size_t s = 0; s < result_.skin.size(); ++s) {
        if (imprint_.contact[result_.skin_source[s]] < 0) continue;
        for (const int p : result_.skin[s]) {
            int& vertex = vertex_of_point_[p];
            if (vertex >= 0) continue;
            vertex = result_.point_source[p];
            if (vertex < 0) {
                vertex = static_cast<int>(vertices.size());
                vertices.emplace_back();
            }
            vertices[vertex] = result_.points[p];
        }
    }
}

TetResult Assembly::take(std::size_t vertices_of_caller) {
    result_.skin_twin = skin_twins(result_.skin);
    int open = 0;
    for (std::size_t s = 0; s < result_.skin.size(); ++s)
        open += twin_solid(result_.skin_source[s]) >= 0 && result_.skin_twin[s] < 0;
    if (open > 0)
        throw VerificationFailed("solids in contact have different triangles on " +
                                 std::to_string(open) + " places of their common faces");
    for (int& t : result_.skin_source) t = imprint_.source[t];
    for (int& v : result_.point_source)
        if (v >= static_cast<int>(vertices_of_caller)) v = -1;
    result_.report.snap.merged_points += imprint_.merged_points;
    return std::move(result_);
}

}  // namespace tetra
