// SPDX-License-Identifier: LGPL-2.1-or-later
// Construction of refined voxel solids, and an exact check of a mesh against its solid.
#include "assemble_compact_support.h"

#include <algorithm>
#include <map>

#include "tetra/assemble/double_predicates.h"
#include "tetra/exact/plane.h"

namespace tetra::testing_support {
namespace {

std::size_t at(int i) { return static_cast<std::size_t>(i); }

int floor_div(int a, int b) { return (a >= 0 ? a : a - b + 1) / b; }

class Builder {
  public:
    Builder(const std::set<Voxel>& voxels, const RefinedOptions& options)
        : voxels_(voxels), o_(options) {}

    Refined build() {
        make_surface();
        for (const Voxel& v : voxels_)
            for (int i = 0; i < o_.parts; ++i)
                for (int j = 0; j < o_.parts; ++j)
                    for (int k = 0; k < o_.parts; ++k)
                        make_cell({v[0] * o_.parts + i, v[1] * o_.parts + j, v[2] * o_.parts + k});
        return std::move(out_);
    }

  private:
    bool in(int x, int y, int z) const { return voxels_.count({x, y, z}) > 0; }

    // Numerator over parts of the coordinate of fine index f.
    std::int64_t coordinate(int f) const {
        const int coarse = floor_div(f, o_.parts), rest = f - coarse * o_.parts;
        if (!o_.uneven) return (coarse * o_.parts + rest) * o_.spacing;
        const std::int64_t whole = coarse * o_.spacing * o_.parts;
        return whole + (rest == 0
                            ? 0
                            : (rest + (rest * rest) % 2) * o_.spacing * o_.parts / (o_.parts + 2));
    }

    Vec3i mapped(const Voxel& fine) const {
        Vec3i r{0, 0, 0};
        for (std::size_t c = 0; c < 3; ++c)
            for (std::size_t k = 0; k < 3; ++k) r[k] += o_.map[c][k] * coordinate(fine[c]);
        return r;
    }

    int corner_id(const Voxel& v) {
        const auto [it, fresh] =
            corners_.try_emplace(v, static_cast<int>(out_.solid.points.size()));
        if (fresh) {
            const Vec3i p = mapped({v[0] * o_.parts, v[1] * o_.parts, v[2] * o_.parts});
            out_.solid.points.push_back({p[0] / o_.parts, p[1] / o_.parts, p[2] / o_.parts});
            out_.solid.point_source.push_back(it->second);
        }
        return it->second;
    }

    void make_surface() {
        for (const Voxel& v : voxels_)
            for (int axis = 0; axis < 3; ++axis)
                for (int side = 0; side < 2; ++side) {
                    Voxel beyond = v;
                    beyond[at(axis)] += side ? 1 : -1;
                    if (voxels_.count(beyond)) continue;
                    Voxel q[4] = {v, v, v, v};
                    const std::size_t u = at((axis + 1) % 3), w = at((axis + 2) % 3);
                    for (Voxel& c : q) c[at(axis)] += side;
                    ++q[1][u], ++q[2][u], ++q[2][w], ++q[3][w];
                    int id[4];
                    for (int k = 0; k < 4; ++k) id[k] = corner_id(q[k]);
                    if (!side) std::swap(id[1], id[3]);
                    face_[{v[0], v[1], v[2], axis * 2 + side}] =
                        static_cast<int>(out_.solid.triangles.size());
                    for (const Triangle& t :
                         {Triangle{id[0], id[1], id[2]}, {id[0], id[2], id[3]}}) {
                        out_.solid.triangle_source.push_back(
                            static_cast<int>(out_.solid.triangles.size()));
                        out_.solid.triangles.push_back(t);
                        out_.solid.solid.push_back(0);
                    }
                }
    }

    Carrier carrier_of(const Voxel& f) {
        Voxel low;
        std::vector<std::size_t> on;
        for (std::size_t k = 0; k < 3; ++k) {
            low[k] = floor_div(f[k], o_.parts);
            if (low[k] * o_.parts == f[k]) on.push_back(k);
        }
        if (on.size() == 3) {
            const auto it = corners_.find(low);
            if (it != corners_.end()) return {CarrierKind::vertex, it->second, -1};
            return {};
        }
        if (on.size() == 2) {
            bool filled[2][2];
            for (int a = 0; a < 2; ++a)
                for (int b = 0; b < 2; ++b) {
                    Voxel v = low;
                    v[on[0]] -= a, v[on[1]] -= b;
                    filled[a][b] = voxels_.count(v) > 0;
                }
            const int n = filled[0][0] + filled[0][1] + filled[1][0] + filled[1][1];
            const bool flat = n == 2 && filled[0][0] != filled[1][1];
            if (n == 0 || n == 4) return {};
            const std::size_t along = 3 - on[0] - on[1];
            Voxel end = low;
            ++end[along];
            if (!flat) return {CarrierKind::edge, corners_.at(low), corners_.at(end)};
            for (const std::size_t k : on)
                for (int other = 0; other < 2; ++other) {
                    Voxel v = low;
                    v[on[0] + on[1] - k] -= other;
                    const int tri = face_between(v, k);
                    if (tri >= 0) return {CarrierKind::facet, tri, -1};
                }
            return {};
        }
        if (on.size() == 1) {
            const int tri = face_between(low, on[0]);
            if (tri >= 0) return {CarrierKind::facet, tri, -1};
        }
        return {};
    }

    // The surface triangle between voxel v and the one below it along an axis, or -1.
    int face_between(const Voxel& v, std::size_t axis) const {
        Voxel below = v;
        --below[axis];
        const bool above_in = voxels_.count(v) > 0, below_in = voxels_.count(below) > 0;
        if (above_in == below_in) return -1;
        const int a = static_cast<int>(axis);
        if (above_in) return face_.at({v[0], v[1], v[2], a * 2});
        return face_.at({below[0], below[1], below[2], a * 2 + 1});
    }

    int point_id(const Voxel& f) {
        const auto [it, fresh] = points_.try_emplace(f, static_cast<int>(out_.mesh.points.size()));
        if (fresh) {
            const Vec3i n = mapped(f);
            const std::int64_t w = o_.parts;
            if (n[0] % w == 0 && n[1] % w == 0 && n[2] % w == 0)
                out_.mesh.points.push_back(hpoint({n[0] / w, n[1] / w, n[2] / w}));
            else
                out_.mesh.points.push_back({n[0], n[1], n[2], w});
            out_.mesh.carriers.push_back(carrier_of(f));
        }
        return it->second;
    }

    void make_cell(const Voxel& f) {
        int order[3] = {0, 1, 2};
        do {
            Voxel p[4] = {f, f, f, f};
            for (int k = 0; k < 3; ++k)
                for (int j = k + 1; j < 4; ++j) ++p[j][at(order[k])];
            std::array<int, 4> t;
            for (int k = 0; k < 4; ++k) t[at(k)] = point_id(p[k]);
            const int inversions =
                (order[0] > order[1]) + (order[0] > order[2]) + (order[1] > order[2]);
            if (inversions % 2) {
                std::swap(t[1], t[2]);
                std::swap(p[1], p[2]);
            }
            out_.mesh.tets.push_back(t);
            out_.mesh.tet_solid.push_back(0);
            static constexpr int kFaces[4][3] = {{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}};
            for (const auto& face : kFaces) make_skin(f, p, t, face);
        } while (std::next_permutation(order, order + 3));
    }

    void make_skin(const Voxel& cell, const Voxel (&p)[4], const std::array<int, 4>& t,
                   const int (&face)[3]) {
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const int level = p[face[0]][axis];
            if (p[face[1]][axis] != level || p[face[2]][axis] != level) continue;
            if (level % o_.parts != 0) continue;
            Voxel coarse;
            for (std::size_t k = 0; k < 3; ++k) coarse[k] = floor_div(cell[k], o_.parts);
            const int side = level > cell[axis];
            const auto it =
                face_.find({coarse[0], coarse[1], coarse[2], static_cast<int>(axis) * 2 + side});
            if (it == face_.end()) continue;
            out_.mesh.skin.push_back({t[at(face[0])], t[at(face[1])], t[at(face[2])]});
            out_.mesh.skin_source.push_back(it->second);
        }
    }

    const std::set<Voxel>& voxels_;
    RefinedOptions o_;
    Refined out_;
    std::map<Voxel, int> corners_, points_;
    std::map<std::array<int, 4>, int> face_;  // (voxel, side) -> first of its two triangles
};

using Residues = std::array<std::uint64_t, 3>;

std::uint64_t minus(std::uint64_t a, std::uint64_t b) {
    return a >= b ? a - b : a + kHashPrime - b;
}
std::uint64_t plus(std::uint64_t a, std::uint64_t b) { return minus(a, b ? kHashPrime - b : 0); }

Residues cross(const Residues& a, const Residues& b, const Residues& c) {
    Residues u, v, r;
    for (std::size_t k = 0; k < 3; ++k) u[k] = minus(b[k], a[k]), v[k] = minus(c[k], a[k]);
    for (std::size_t k = 0; k < 3; ++k) {
        const std::size_t i = (k + 1) % 3, j = (k + 2) % 3;
        r[k] = minus(multiply_mod(u[i], v[j]), multiply_mod(u[j], v[i]));
    }
    return r;
}

std::uint64_t volume(const Residues& a, const Residues& b, const Residues& c, const Residues& d) {
    const Residues n = cross(a, b, c);
    std::uint64_t sum = 0;
    for (std::size_t k = 0; k < 3; ++k) sum = plus(sum, multiply_mod(n[k], minus(d[k], a[k])));
    return sum;
}

}  // namespace

Refined refined_voxels(const std::set<Voxel>& voxels, const RefinedOptions& options) {
    return Builder(voxels, options).build();
}

std::set<Voxel> box_voxels(int x, int y, int z) {
    std::set<Voxel> r;
    for (int i = 0; i < x; ++i)
        for (int j = 0; j < y; ++j)
            for (int k = 0; k < z; ++k) r.insert({i, j, k});
    return r;
}

std::set<Voxel> random_voxels(std::uint64_t seed, int size, int percent) {
    std::set<Voxel> r;
    std::uint64_t s = seed * 2654435761u + 12345;
    for (const Voxel& v : box_voxels(size, size, size)) {
        s = s * 6364136223846793005u + 1442695040888963407u;
        if (static_cast<int>((s >> 33) % 100) < percent) r.insert(v);
    }
    if (r.empty()) r.insert({0, 0, 0});
    return r;
}

std::string flaw_of(const ExactMesh& mesh, const GridSolid& solid) {
    std::vector<Residues> points, corners;
    for (const HPoint& p : mesh.points) points.push_back(residues(p));
    for (const Vec3i& p : solid.points) corners.push_back(residues(hpoint(p)));
    const auto pt = [&](int i) -> const Residues& { return points[at(i)]; };
    std::uint64_t inside = 0, expected = 0;
    std::map<std::array<int, 3>, int> open;  // rotated oriented triangles
    const auto rotated = [](int a, int b, int c) {
        if (b < a && b < c) return std::array<int, 3>{b, c, a};
        if (c < a && c < b) return std::array<int, 3>{c, a, b};
        return std::array<int, 3>{a, b, c};
    };
    for (const auto& t : mesh.tets) {
        if (orient3d(mesh.points[at(t[0])], mesh.points[at(t[1])], mesh.points[at(t[2])],
                     mesh.points[at(t[3])]) <= 0)
            return "a tetrahedron is not positive";
        inside = plus(inside, volume(pt(t[0]), pt(t[1]), pt(t[2]), pt(t[3])));
        static constexpr int kFaces[4][3] = {{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}};
        for (const auto& f : kFaces) {
            const auto back = open.find(rotated(t[at(f[0])], t[at(f[2])], t[at(f[1])]));
            if (back != open.end())
                open.erase(back);
            else if (!open.insert({rotated(t[at(f[0])], t[at(f[1])], t[at(f[2])]), 1}).second)
                return "two tetrahedra on one side of a triangle";
        }
    }
    if (open.size() != mesh.skin.size()) return "skin count";
    PlaneTable planes;
    std::map<PlaneKey, Residues> area;
    const auto plane_of = [&](int k) {
        const Triangle& t = solid.triangles[at(k)];
        return planes.intern(
            plane_through(solid.points[at(t[0])], solid.points[at(t[1])], solid.points[at(t[2])]));
    };
    for (std::size_t k = 0; k < solid.triangles.size(); ++k) {
        const Triangle& t = solid.triangles[k];
        expected = plus(expected,
                        volume({0, 0, 0}, corners[at(t[0])], corners[at(t[1])], corners[at(t[2])]));
        Residues& sum = area[plane_of(static_cast<int>(k))];
        const Residues n = cross(corners[at(t[0])], corners[at(t[1])], corners[at(t[2])]);
        for (std::size_t j = 0; j < 3; ++j) sum[j] = plus(sum[j], n[j]);
    }
    if (inside != expected) return "volume";
    for (std::size_t s = 0; s < mesh.skin.size(); ++s) {
        const Triangle& t = mesh.skin[s];
        if (!open.erase(rotated(t[0], t[1], t[2]))) return "a skin triangle is not one";
        const PlaneKey key = plane_of(mesh.skin_source[s]);
        for (int v : t)
            if (side_of_plane(planes[key.id], mesh.points[at(v)]) != 0) return "skin off its plane";
        Residues& sum = area[key];
        const Residues n = cross(pt(t[0]), pt(t[1]), pt(t[2]));
        for (std::size_t j = 0; j < 3; ++j) sum[j] = minus(sum[j], n[j]);
    }
    for (const auto& [key, sum] : area)
        if (sum != Residues{0, 0, 0}) return "area of a plane";
    return "";
}

}  // namespace tetra::testing_support
