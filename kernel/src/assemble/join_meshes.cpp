// SPDX-License-Identifier: LGPL-2.1-or-later
// Equal places are equal points; what either mesh puts on an edge, the other gets.
#include "join_meshes.h"

#include <algorithm>
#include <utility>

#include "tetra/errors.h"

namespace tetra {
namespace {

// One use, one result.
class Joining {
  public:
    Joining(const FinishedMeshes& finished, const SolidSurface& surface, const SolidTets& part,
            const GridSolid& grid)
        : finished_(finished), surface_(surface), part_(part), grid_(grid) {
        out_.points = finished.points;
        out_.point_source = finished.point_source;
        out_.chains = finished.chains;
        for (std::size_t p = 0; p < finished.vertex_of_point.size(); ++p)
            if (const int vertex = finished.vertex_of_point[p]; vertex >= 0)
                point_of_vertex_[vertex] = static_cast<int>(p);
    }

    Joined run() {
        for (std::size_t p = 0; p < part_.points.size(); ++p) id_.push_back(point_of(p));
        out_.fresh = renamed_part();
        if (note_edges()) {
            find_divided_edges(finished_.parts.skin, true);
            find_divided_edges(out_.fresh.skin, false);
        }
        find_divided_faces();
        return std::move(out_);
    }

  private:
    int point_of(std::size_t p) {
        const Vec3d& place = part_.points[p];
        const int vertex = part_.point_source[p];
        if (vertex >= 0) {
            if (const auto at = point_of_vertex_.find(vertex); at != point_of_vertex_.end()) {
                if (out_.points[at->second] != place)
                    throw VerificationFailed("a vertex of a contact can't be kept in its place");
                ++out_.shared;
                return at->second;
            }
        }
        if (const auto at = finished_.known.find(place); at != finished_.known.end()) {
            ++out_.shared;
            if (out_.point_source[at->second] < 0) out_.point_source[at->second] = vertex;
            return at->second;
        }
        out_.points.push_back(place);
        out_.point_source.push_back(vertex);
        return static_cast<int>(out_.points.size()) - 1;
    }

    MeshParts renamed_part() const {
        const auto placed = [&](auto ids) {
            for (int& p : ids) p = id_[p];
            return ids;
        };
        MeshParts out;
        out.tet_solid = part_.mesh.tet_solid;
        for (const auto& tet : part_.mesh.tets) out.tets.push_back(placed(tet));
        for (const Triangle& t : part_.mesh.skin) out.skin.push_back(placed(t));
        for (const int t : part_.mesh.skin_source)
            out.skin_source.push_back(surface_.origin[grid_.triangle_source[t]]);
        return out;
    }

    // Points that the new mesh puts on edges of contacts. False when there are none.
    bool note_edges() {
        std::map<int, int> point_of_grid;
        for (std::size_t p = 0; p < part_.points.size(); ++p)
            if (const Carrier& c = part_.mesh.carriers[p]; c.kind == CarrierKind::vertex)
                point_of_grid[c.first] = id_[p];
        bool any = false;
        for (std::size_t s = 0; s < part_.mesh.skin.size(); ++s) {
            if (!surface_.contact[grid_.triangle_source[part_.mesh.skin_source[s]]]) continue;
            for (const int p : part_.mesh.skin[s])
                if (const Carrier& c = part_.mesh.carriers[p]; c.kind == CarrierKind::edge)
                    any |= out_.chains.add(point_of_grid.at(c.first), point_of_grid.at(c.second),
                                           id_[p], out_.points);
        }
        return any;
    }

    // Edges of a skin that lack points of other meshes, or of the same where it is pinched.
    void find_divided_edges(const std::vector<Triangle>& skin, bool earlier) {
        for (const Triangle& t : skin)
            for (std::size_t k = 0; k < 3; ++k) {
                const int u = t[k], v = t[(k + 1) % 3];
                if (u > v) continue;  // another triangle has it the other way round
                std::vector<int> missing = out_.chains.between(u, v);
                if (missing.empty()) continue;
                if (earlier) out_.put.insert(missing.begin(), missing.end());
                out_.division.on_edge[{u, v}] = std::move(missing);
            }
    }

    // Where the new mesh divides triangles that it took over.
    void find_divided_faces() {
        std::map<int, std::vector<Triangle>> parts;  // per earlier skin row, its way round
        for (std::size_t s = 0; s < part_.mesh.skin.size(); ++s) {
            const int row = surface_.old_row[grid_.triangle_source[part_.mesh.skin_source[s]]];
            if (row < 0) continue;
            const Triangle& t = out_.fresh.skin[s];
            parts[row].push_back({t[0], t[2], t[1]});
            for (const int p : part_.mesh.skin[s])
                if (part_.point_source[p] < 0) out_.put.insert(id_[p]);
        }
        std::map<Triangle, std::vector<Triangle>> faces;
        for (auto& [row, list] : parts) {
            if (list.size() == 1) continue;
            Triangle key = finished_.parts.skin[row];
            std::sort(key.begin(), key.end());
            std::vector<Triangle>& all = faces[key];
            for (const Triangle& t : list)
                for (const Triangle& part : out_.division.parts_of(t)) all.push_back(part);
        }
        out_.division.faces = std::move(faces);
    }

    const FinishedMeshes& finished_;
    const SolidSurface& surface_;
    const SolidTets& part_;
    const GridSolid& grid_;
    Joined out_;
    std::map<int, int> point_of_vertex_;
    std::vector<int> id_;  // per point of the part
};

}  // namespace

Joined join(const FinishedMeshes& finished, const SolidSurface& surface, const SolidTets& part,
            const GridSolid& grid) {
    return Joining(finished, surface, part, grid).run();
}

MeshParts divided_mesh(const MeshParts& mesh, const Division& division,
                       std::vector<Vec3d>& points) {
    MeshParts out;
    for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
        const std::array<int, 4>& v = mesh.tets[t];
        const bool touched =
            division.touches({v[1], v[2], v[3]}) || division.touches({v[0], v[3], v[2]}) ||
            division.touches({v[0], v[1], v[3]}) || division.touches({v[0], v[2], v[1]});
        const std::vector<std::array<int, 4>> parts =
            touched ? divided(v, division, points) : std::vector{v};
        out.tets.insert(out.tets.end(), parts.begin(), parts.end());
        out.tet_solid.insert(out.tet_solid.end(), parts.size(), mesh.tet_solid[t]);
    }
    for (std::size_t s = 0; s < mesh.skin.size(); ++s)
        for (const Triangle& part : division.parts_of(mesh.skin[s])) {
            out.skin.push_back(part);
            out.skin_source.push_back(mesh.skin_source[s]);
        }
    return out;
}

}  // namespace tetra
