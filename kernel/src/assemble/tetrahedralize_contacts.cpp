// SPDX-License-Identifier: LGPL-2.1-or-later
// Bookkeeping on triangles and edges of the imprinted surface; no geometry is decided here.
#include "tetrahedralize_contacts.h"

#include <algorithm>
#include <map>
#include <tuple>

#include "vec3.h"

namespace tetra {
namespace {

using Edge = std::pair<int, int>;

Edge edge(int u, int v) { return {std::min(u, v), std::max(u, v)}; }

class Divider {
  public:
    explicit Divider(Imprint& imprint) : imprint_(imprint) {}

    void run(const std::vector<ContactPoint>& points) {
        for (const ContactPoint& p : points) {
            if (p.u < 0)
                add_inner(p);
            else
                add_to_edge(p);
        }
        for (auto& [e, list] : on_edge_) {
            const Vec3d& start = imprint_.surface.vertices[e.first];
            std::sort(list.begin(), list.end(),
                      [&](int a, int b) { return distance2(a, start) < distance2(b, start); });
        }
        const Imprint old = imprint_;
        imprint_.surface.triangles.clear();
        imprint_.surface.solid.clear();
        imprint_.surface.face.clear();
        imprint_.source.clear();
        imprint_.contact.clear();
        for (std::size_t t = 0; t < old.surface.triangles.size(); ++t)
            if (old.contact[t] < 0 || static_cast<int>(t) < old.contact[t])
                divide(old, static_cast<int>(t));
    }

  private:
    double distance2(int vertex, const Vec3d& from) const {
        const Vec3d d = minus(imprint_.surface.vertices[vertex], from);
        return dot(d, d);
    }

    int new_vertex(const Vec3d& place) {
        imprint_.surface.vertices.push_back(place);
        return static_cast<int>(imprint_.surface.vertices.size()) - 1;
    }

    void add_inner(const ContactPoint& p) {
        const int t = std::min(p.triangle, imprint_.contact[p.triangle]);
        if (!inner_.contains(t)) inner_[t] = new_vertex(p.place);
    }

    void add_to_edge(const ContactPoint& p) {
        std::vector<int>& list = on_edge_[edge(p.u, p.v)];
        const auto known = [&](int v) { return imprint_.surface.vertices[v] == p.place; };
        if (std::none_of(list.begin(), list.end(), known)) list.push_back(new_vertex(p.place));
    }

    void divide(const Imprint& old, int t) {
        const Triangle& c = old.surface.triangles[t];
        std::vector<Triangle> parts;
        const auto inner = inner_.find(t);
        if (inner == inner_.end()) {
            divide_edges(c, parts);
        } else {
            for (std::size_t k = 0; k < 3; ++k)
                divide_edges({c[k], c[(k + 1) % 3], inner->second}, parts);
        }
        const int twin = old.contact[t];
        for (const Triangle& part : parts) {
            add(old, t, part, twin < 0 ? -1 : static_cast<int>(imprint_.source.size()) + 1);
            if (twin >= 0)
                add(old, twin, {part[0], part[2], part[1]},
                    static_cast<int>(imprint_.source.size()) - 1);
        }
    }

    void add(const Imprint& old, int t, const Triangle& part, int contact) {
        imprint_.surface.triangles.push_back(part);
        imprint_.surface.solid.push_back(old.surface.solid[t]);
        if (!old.surface.face.empty()) imprint_.surface.face.push_back(old.surface.face[t]);
        imprint_.source.push_back(old.source[t]);
        imprint_.contact.push_back(contact);
    }

    void divide_edges(const Triangle& t, std::vector<Triangle>& parts) const {
        for (std::size_t k = 0; k < 3; ++k) {
            const int a = t[k], b = t[(k + 1) % 3], c = t[(k + 2) % 3];
            const auto found = on_edge_.find(edge(a, b));
            if (found == on_edge_.end()) continue;
            std::vector<int> chain = found->second;
            if (a > b) std::reverse(chain.begin(), chain.end());
            chain.push_back(b);
            int last = a;
            for (const int v : chain) divide_edges({std::exchange(last, v), v, c}, parts);
            return;
        }
        parts.push_back(t);
    }

    Imprint& imprint_;
    std::map<Edge, std::vector<int>> on_edge_;
    std::map<int, int> inner_;
};

}  // namespace

TetInput with_contact_faces(const Imprint& imprint) {
    TetInput surface = imprint.surface;
    std::vector<int>& face = surface.face;
    if (face.empty()) face.assign(surface.triangles.size(), 0);
    const int next = 1 + *std::max_element(face.begin(), face.end());
    for (std::size_t t = 0; t < face.size(); ++t)
        if (imprint.contact[t] >= 0)
            face[t] = next + std::min(static_cast<int>(t), imprint.contact[t]);
    return surface;
}

void find_contact_points(const SolidTets& part, const GridSolid& grid, const Imprint& imprint,
                         std::vector<ContactPoint>& points) {
    std::vector<char> done(part.points.size(), 0);
    for (std::size_t s = 0; s < part.mesh.skin.size(); ++s) {
        const int t = grid.triangle_source[part.mesh.skin_source[s]];
        if (imprint.contact[t] < 0) continue;
        for (const int p : part.mesh.skin[s]) {
            if (part.point_source[p] >= 0 || std::exchange(done[p], 1)) continue;
            ContactPoint point;
            point.place = part.points[p];
            const Carrier& carrier = part.mesh.carriers[p];
            if (carrier.kind == CarrierKind::edge) {
                point.u = grid.point_source[carrier.first];
                point.v = grid.point_source[carrier.second];
            } else {
                point.triangle = t;
            }
            points.push_back(point);
        }
    }
}

void add_contact_points(std::vector<ContactPoint> points, Imprint& imprint) {
    Divider(imprint).run(points);
}

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

}  // namespace tetra
