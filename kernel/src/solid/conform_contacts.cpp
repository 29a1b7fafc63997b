// SPDX-License-Identifier: LGPL-2.1-or-later
// Splits edges at vertices, then forces edges into the faces they lie on.
#include "tetra/solid/conform_contacts.h"

#include <algorithm>
#include <map>
#include <utility>

#include "tetra/errors.h"
#include "tetra/exact/plane.h"
#include "tetra/exact/predicates.h"
#include "tetra/solid/box_tree.h"

namespace tetra {
namespace {

struct VertexOnEdge {
    int solid, low, high, vertex;
    friend auto operator<=>(const VertexOnEdge&, const VertexOnEdge&) = default;
};

// Edge u-w of a triangle runs through the inside of triangle `face`.
struct EdgeOnFace {
    int u, w, face;
    friend auto operator<=>(const EdgeOnFace&, const EdgeOnFace&) = default;
};

class Conformer {
  public:
    explicit Conformer(GridSolid&& solid) : s_(std::move(solid)) {}

    GridSolid run() {
        for (;;) {
            find_contacts();
            if (!on_edges_.empty()) {
                split_edges();
            } else if (!on_faces_.empty()) {
                insert_edges();
            } else {
                if (changed_) close_gaps();
                return std::move(s_);
            }
            changed_ = true;
        }
    }

  private:
    const Vec3i& point(int v) const { return s_.points[static_cast<std::size_t>(v)]; }
    Triangle& triangle(int t) { return s_.triangles[static_cast<std::size_t>(t)]; }
    const Triangle& triangle(int t) const { return s_.triangles[static_cast<std::size_t>(t)]; }
    int solid(int t) const { return s_.solid[static_cast<std::size_t>(t)]; }
    int vertex(int t, int i) const { return triangle(t)[static_cast<std::size_t>(i % 3)]; }
    bool has(int t, int v) const {
        return vertex(t, 0) == v || vertex(t, 1) == v || vertex(t, 2) == v;
    }
    int side(int t, int v) const {
        return has(t, v) ? 0
                         : orient3d(point(vertex(t, 0)), point(vertex(t, 1)), point(vertex(t, 2)),
                                    point(v));
    }

    // Two coordinates in which the triangle is seen counter-clockwise with an area.
    struct View {
        int u, v;
    };
    View view(int t) const {
        for (const View w : {View{0, 1}, View{1, 2}, View{2, 0}}) {
            const int turn =
                orient2d(point(vertex(t, 0)), point(vertex(t, 1)), point(vertex(t, 2)), w.u, w.v);
            if (turn > 0) return w;
            if (turn < 0) return {w.v, w.u};
        }
        return {0, 1};
    }
    int turn(View w, int a, int b, int c) const {
        return orient2d(point(a), point(b), point(c), w.u, w.v);
    }

    void find_contacts() {
        on_edges_.clear();
        on_faces_.clear();
        for_touching_boxes(build_box_tree(s_.points, s_.triangles), [&](int a, int b) {
            if (solid(a) != solid(b)) return;
            note(a, b);
            note(b, a);
            refuse_crossing(a, b);
        });
        sort_unique(on_edges_);
        sort_unique(on_faces_);
    }

    template <class Item>
    static void sort_unique(std::vector<Item>& list) {
        std::sort(list.begin(), list.end());
        list.erase(std::unique(list.begin(), list.end()), list.end());
    }

    // What of triangle b lies on triangle a.
    void note(int a, int b) {
        std::array<bool, 3> on{};
        int count = 0;
        for (int i = 0; i < 3; ++i) {
            on[static_cast<std::size_t>(i)] = side(a, vertex(b, i)) == 0;
            count += on[static_cast<std::size_t>(i)];
        }
        if (count == 0) return;
        const View w = view(a);
        for (int i = 0; i < 3; ++i) {
            if (!on[static_cast<std::size_t>(i)]) continue;
            note_vertex(a, vertex(b, i), w);
            if (on[static_cast<std::size_t>((i + 1) % 3)])
                note_edge(a, vertex(b, i), vertex(b, i + 1), w);
        }
    }

    bool in_plane(int t, int u, int v) const { return side(t, u) == 0 && side(t, v) == 0; }

    // Edges that cross in a point inside both, neither in the plane of the other's triangle.
    void refuse_crossing(int a, int b) const {
        for (int i = 0; i < 3; ++i)
            for (int j = 0; j < 3; ++j) {
                const int u = vertex(a, i), v = vertex(a, i + 1), x = vertex(b, j),
                          y = vertex(b, j + 1);
                if (u == x || u == y || v == x || v == y) continue;
                if (!spans_touch(point(u), point(v), point(x), point(y))) continue;
                if (orient3d(point(u), point(v), point(x), point(y)) != 0) continue;
                if (in_plane(a, x, y) || in_plane(b, u, v)) continue;
                for (const View w : {View{0, 1}, View{1, 2}, View{2, 0}})
                    if (crosses(w, u, v, x, y)) refuse(x, y, {u, v, a});
            }
    }

    static bool spans_touch(const Vec3i& p, const Vec3i& q, const Vec3i& r, const Vec3i& s) {
        for (std::size_t k = 0; k < 3; ++k)
            if (std::max(p[k], q[k]) < std::min(r[k], s[k]) ||
                std::max(r[k], s[k]) < std::min(p[k], q[k]))
                return false;
        return true;
    }

    void note_vertex(int a, int v, View w) {
        if (has(a, v)) return;
        for (int i = 0; i < 3; ++i) {
            const int p = vertex(a, i), q = vertex(a, i + 1), r = vertex(a, i + 2);
            if (turn(w, p, q, v) == 0 && turn(w, q, r, v) > 0 && turn(w, r, p, v) > 0)
                on_edges_.push_back({solid(a), std::min(p, q), std::max(p, q), v});
        }
    }

    // Segment and triangle have inner points in common unless a line of theirs separates them.
    void note_edge(int a, int u, int v, View w) {
        if (has(a, u) && has(a, v)) return;
        int left = 0, right = 0;
        for (int i = 0; i < 3; ++i) {
            const int p = vertex(a, i), q = vertex(a, i + 1);
            if (turn(w, p, q, u) <= 0 && turn(w, p, q, v) <= 0) return;
            const int s = turn(w, u, v, p);
            left += s > 0;
            right += s < 0;
        }
        if (left && right) on_faces_.push_back({std::min(u, v), std::max(u, v), a});
    }

    void append(const Triangle& t, int like) {
        s_.triangles.push_back(t);
        s_.triangle_source.push_back(s_.triangle_source[static_cast<std::size_t>(like)]);
        s_.solid.push_back(solid(like));
    }

    // One vertex for each edge and one edge for each triangle; the next round finds the rest.
    void split_edges() {
        std::map<std::array<int, 3>, int> vertex_of;
        for (const VertexOnEdge& c : on_edges_)
            vertex_of.try_emplace({c.solid, c.low, c.high}, c.vertex);
        // Only edges whose triangles are all free are split, so that both sides stay equal.
        std::map<std::array<int, 3>, std::vector<std::pair<int, int>>> users;
        const int count = static_cast<int>(s_.triangles.size());
        for (int t = 0; t < count; ++t)
            for (int i = 0; i < 3; ++i) {
                const auto [low, high] = std::minmax({vertex(t, i), vertex(t, i + 1)});
                const std::array<int, 3> key{solid(t), low, high};
                if (vertex_of.contains(key)) users[key].push_back({t, i});
            }
        std::vector<char> busy(static_cast<std::size_t>(count));
        for (const auto& [key, list] : users) {
            const auto taken = [&](const std::pair<int, int>& use) {
                return busy[static_cast<std::size_t>(use.first)] != 0;
            };
            if (std::any_of(list.begin(), list.end(), taken)) continue;
            const int v = vertex_of.at(key);
            for (const auto& [t, i] : list) {
                busy[static_cast<std::size_t>(t)] = 1;
                const int p = vertex(t, i), q = vertex(t, i + 1), r = vertex(t, i + 2);
                triangle(t) = {p, v, r};
                append({v, q, r}, t);
            }
        }
    }

    void insert_edges() {
        index_edges();
        const std::vector<EdgeOnFace> todo = on_faces_;
        bool divided = false;
        for (const EdgeOnFace& c : todo)
            if (still_there(c))
                if (const int v = inner_end(c, view(c.face)); v >= 0) {
                    split_face(c.face, v);
                    divided = true;
                }
        if (divided) return;  // ends first: the next round finds all edges between corners
        for (const EdgeOnFace& c : todo)
            if (still_there(c)) force_edge(c, view(c.face));
    }

    // Earlier insertions may have changed the face; what they leave comes up in the next round.
    bool still_there(const EdgeOnFace& c) {
        if (side(c.face, c.u) != 0 || side(c.face, c.w) != 0) return false;
        on_faces_.clear();
        note_edge(c.face, c.u, c.w, view(c.face));
        return !on_faces_.empty();
    }

    // Faces in contact now consist of opposite equal triangles: the gap between them is nothing.
    void close_gaps() {
        std::map<std::array<int, 4>, std::array<std::vector<int>, 2>> sides;
        const int count = static_cast<int>(s_.triangles.size());
        for (int t = 0; t < count; ++t) {
            Triangle k = triangle(t);
            std::rotate(k.begin(), std::min_element(k.begin(), k.end()), k.end());
            const bool odd = k[1] > k[2];
            if (odd) std::swap(k[1], k[2]);
            sides[{solid(t), k[0], k[1], k[2]}][odd].push_back(t);
        }
        std::vector<char> gone(static_cast<std::size_t>(count));
        for (const auto& [key, lists] : sides)
            for (std::size_t i = 0; i < std::min(lists[0].size(), lists[1].size()); ++i)
                for (const auto& list : lists) gone[static_cast<std::size_t>(list[i])] = 1;
        std::size_t kept = 0;
        for (std::size_t t = 0; t < gone.size(); ++t) {
            if (gone[t]) continue;
            s_.triangles[kept] = s_.triangles[t];
            s_.triangle_source[kept] = s_.triangle_source[t];
            s_.solid[kept++] = s_.solid[t];
        }
        s_.triangles.resize(kept);
        s_.triangle_source.resize(kept);
        s_.solid.resize(kept);
    }

    // An end strictly inside the triangle, or -1.
    int inner_end(const EdgeOnFace& c, View w) const {
        for (const int v : {c.u, c.w}) {
            bool inside = !has(c.face, v);
            for (int i = 0; i < 3 && inside; ++i)
                inside = turn(w, vertex(c.face, i), vertex(c.face, i + 1), v) > 0;
            if (inside) return v;
        }
        return -1;
    }

    void split_face(int t, int v) {
        const Triangle old = triangle(t);
        const int first = static_cast<int>(s_.triangles.size());
        unindex(t);
        triangle(t) = {old[0], old[1], v};
        append({old[1], old[2], v}, t);
        append({old[2], old[0], v}, t);
        for (const int u : {t, first, first + 1}) index(u);
    }

    void index_edges() {
        triangles_at_.clear();
        for (int t = 0; t < static_cast<int>(s_.triangles.size()); ++t) index(t);
    }
    void index(int t) {
        for (int i = 0; i < 3; ++i) triangles_at_[{vertex(t, i), vertex(t, i + 1)}].push_back(t);
    }
    void unindex(int t) {
        for (int i = 0; i < 3; ++i) std::erase(triangles_at_[{vertex(t, i), vertex(t, i + 1)}], t);
    }

    // The triangle of the same solid, plane and orientation with half-edge p -> q, or -1.
    int coplanar_at(int p, int q, int like) const {
        const auto found = triangles_at_.find({p, q});
        if (found == triangles_at_.end()) return -1;
        const Plane plane = plane_of(like);
        for (const int t : found->second)
            if (solid(t) == solid(like) && plane_of(t) == plane) return t;
        return -1;
    }
    Plane plane_of(int t) const {
        return plane_through(point(vertex(t, 0)), point(vertex(t, 1)), point(vertex(t, 2)));
    }

    bool crosses(View w, int a, int b, int u, int v) const {
        return turn(w, u, v, a) * turn(w, u, v, b) < 0 && turn(w, a, b, u) * turn(w, a, b, v) < 0;
    }

    // Takes out the triangles that u-w crosses and fills both sides of it.
    void force_edge(const EdgeOnFace& c, View w) {
        int x = -1, y = -1;
        std::vector<int> removed, left, right;
        removed.push_back(first_crossed(c, w, x, y));
        right.push_back(x);
        left.push_back(y);
        for (;;) {
            const int next = coplanar_at(y, x, c.face);
            if (next < 0 || users(x, y, c.face) > 2) refuse(x, y, c);
            removed.push_back(next);
            const int q = apex(next, x, y);
            if (q == c.w) break;
            const bool is_left = turn(w, c.u, c.w, q) > 0;
            (is_left ? left : right).push_back(q);
            (is_left ? y : x) = q;
        }
        std::reverse(left.begin(), left.end());
        std::vector<Triangle> filling;
        fill(w, c.u, c.w, left, filling);
        fill(w, c.w, c.u, right, filling);
        for (const int t : removed) unindex(t);
        for (std::size_t i = 0; i < removed.size(); ++i) {
            triangle(removed[i]) = filling[i];
            index(removed[i]);
        }
    }

    // The triangle (u, x, y) of the face whose edge x-y is crossed by u-w.
    int first_crossed(const EdgeOnFace& c, View w, int& x, int& y) const {
        const Plane plane = plane_of(c.face);
        for (auto i = triangles_at_.lower_bound({c.u, -1});
             i != triangles_at_.end() && i->first.first == c.u; ++i)
            for (const int t : i->second) {
                x = i->first.second;
                y = apex(t, c.u, x);
                if (solid(t) == solid(c.face) && plane_of(t) == plane && crosses(w, x, y, c.u, c.w))
                    return t;
            }
        for (int i = 0; i < 3; ++i)
            if (crosses(w, vertex(c.face, i), vertex(c.face, i + 1), c.u, c.w))
                refuse(vertex(c.face, i), vertex(c.face, i + 1), c);
        refuse(vertex(c.face, 0), vertex(c.face, 1), c);
    }

    // Triangles of the solid at an edge, on both its sides.
    std::size_t users(int p, int q, int like) const {
        std::size_t count = 0;
        for (const auto& key : {std::pair{p, q}, std::pair{q, p}})
            if (const auto found = triangles_at_.find(key); found != triangles_at_.end())
                count += static_cast<std::size_t>(
                    std::count_if(found->second.begin(), found->second.end(),
                                  [&](int t) { return solid(t) == solid(like); }));
        return count;
    }

    // Triangulates the polygon a, b, chain...: the corner nearest to a-b sees it, for all others
    // are farther away.
    void fill(View w, int a, int b, const std::vector<int>& chain, std::vector<Triangle>& out) {
        if (chain.empty()) return;
        const auto height = [&](int v) {
            const Vec3i &p = point(a), &q = point(b), &r = point(v);
            return static_cast<Int128>(q[w.u] - p[w.u]) * (r[w.v] - p[w.v]) -
                   static_cast<Int128>(q[w.v] - p[w.v]) * (r[w.u] - p[w.u]);
        };
        const auto nearest = std::min_element(chain.begin(), chain.end(), [&](int v, int other) {
            return height(v) < height(other);
        });
        out.push_back({a, b, *nearest});
        fill(w, *nearest, b, {chain.begin(), nearest}, out);
        fill(w, a, *nearest, {nearest + 1, chain.end()}, out);
    }

    int apex(int t, int a, int b) const {
        for (const int v : triangle(t))
            if (v != a && v != b) return v;
        return -1;
    }

    [[noreturn]] void refuse(int a, int b, const EdgeOnFace& c) const {
        const auto caller = [&](int v) { return s_.point_source[static_cast<std::size_t>(v)]; };
        Defect d;
        d.kind = "edge_contact";
        for (const int v : {a, b, c.u, c.w}) d.vertices.push_back(caller(v));
        d.triangles = {s_.triangle_source[static_cast<std::size_t>(c.face)]};
        d.message = "edge " + std::to_string(caller(a)) + "-" + std::to_string(caller(b)) +
                    " and edge " + std::to_string(caller(c.u)) + "-" + std::to_string(caller(c.w)) +
                    " cross without a common vertex; divide both where they meet";
        throw InvalidSolid({d});
    }

    GridSolid s_;
    bool changed_ = false;
    std::vector<VertexOnEdge> on_edges_;
    std::vector<EdgeOnFace> on_faces_;
    std::map<std::pair<int, int>, std::vector<int>> triangles_at_;
};

}  // namespace

GridSolid conform_contacts(GridSolid surface) { return Conformer(std::move(surface)).run(); }

}  // namespace tetra
