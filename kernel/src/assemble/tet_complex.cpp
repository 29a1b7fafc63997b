// SPDX-License-Identifier: LGPL-2.1-or-later
// Linking and unlinking of tetrahedra, and the filtered sign both geometries must agree on.
#include "tet_complex.h"

#include <algorithm>
#include <cassert>
#include <string>
#include <tuple>

#include "tetra/assemble/double_predicates.h"
#include "tetra/errors.h"
#include "tetra/exact/plane.h"
#include "tetra/exact/predicates.h"
#include "vec3.h"

namespace tetra {
namespace {

std::size_t at(int i) { return static_cast<std::size_t>(i); }

bool fits_integer(const HPoint& p) {
    const auto small = [](const Int256& v) {
        return v == Int256(static_cast<std::int64_t>(v.limb[0]));
    };
    if (!(p.w == Int256(1)) || !small(p.x) || !small(p.y) || !small(p.z)) return false;
    for (const Int256* v : {&p.x, &p.y, &p.z})
        if (std::abs(static_cast<std::int64_t>(v->limb[0])) > (std::int64_t{1} << 40)) return false;
    return true;
}

Triangle sorted(int a, int b, int c) {
    if (a > b) std::swap(a, b);
    if (b > c) std::swap(b, c);
    if (a > b) std::swap(a, b);
    return {a, b, c};
}

std::uint64_t upper_corners(const Triangle& sorted) {
    return static_cast<std::uint64_t>(sorted[1]) << 32 | static_cast<std::uint32_t>(sorted[2]);
}

}  // namespace

FacetClasses facet_classes(const GridSolid& solid, std::span<const int> faces) {
    PlaneTable planes;
    struct Key {
        int plane, side, face, solid, triangle;
    };
    std::vector<Key> keys;
    keys.reserve(solid.triangles.size());
    for (std::size_t k = 0; k < solid.triangles.size(); ++k) {
        const Triangle& t = solid.triangles[k];
        const PlaneKey plane = planes.intern(
            plane_through(solid.points[at(t[0])], solid.points[at(t[1])], solid.points[at(t[2])]));
        keys.push_back({plane.id, plane.side, faces.empty() ? 0 : faces[k],
                        solid.solid.empty() ? 0 : solid.solid[k], static_cast<int>(k)});
    }
    const auto rank = [](const Key& k) { return std::tie(k.plane, k.side, k.face, k.solid); };
    std::stable_sort(keys.begin(), keys.end(),
                     [&](const Key& a, const Key& b) { return rank(a) < rank(b); });
    FacetClasses out;
    out.of_triangle.resize(keys.size());
    for (std::size_t i = 0; i < keys.size(); ++i) {
        if (i == 0 || rank(keys[i - 1]) != rank(keys[i]))
            out.classes.push_back({keys[i].plane, keys[i].face, keys[i].triangle});
        out.of_triangle[at(keys[i].triangle)] = static_cast<int>(out.classes.size()) - 1;
    }
    return out;
}

TetComplex::TetComplex(const ExactMesh& mesh, const Grid& grid, const FacetClasses& classes)
    : frame_(grid), classes_(classes), exact_(mesh.points), carriers_(mesh.carriers) {
    const std::size_t n = mesh.points.size();
    integer_.resize(n);
    is_integer_.resize(n);
    grid_.resize(n);
    place_.resize(n);
    double reach = 0, far = 0;
    for (std::size_t p = 0; p < n; ++p) {
        grid_[p] = to_doubles(exact_[p]);
        place_[p] = unsnap(frame_, grid_[p]);
        is_integer_[p] = fits_integer(exact_[p]);
        if (is_integer_[p])
            integer_[p] = {static_cast<std::int64_t>(exact_[p].x.limb[0]),
                           static_cast<std::int64_t>(exact_[p].y.limb[0]),
                           static_cast<std::int64_t>(exact_[p].z.limb[0])};
        for (std::size_t k = 0; k < 3; ++k) {
            reach = std::max(reach, std::fabs(grid_[p][k]));
            far = std::max(far, std::fabs(place_[p][k]));
        }
    }
    // to_doubles is off by at most 2^-50 of the coordinate, unsnap by one rounding of the result.
    grid_slack_ = 0x1p-50 * reach;
    place_slack_ = grid_slack_ + 0x1p-52 * far / frame_.step;
    stars_.resize(n);
    reserve(mesh.tets);
    for (std::size_t t = 0; t < mesh.tets.size(); ++t)
        add(mesh.tets[t], mesh.tet_solid.empty() ? 0 : mesh.tet_solid[t]);
    pair_faces(mesh);
}

void TetComplex::reserve(const std::vector<Tet>& tets) {
    std::vector<int> degree(stars_.size(), 0);
    for (const Tet& t : tets)
        for (const int v : t) ++degree[at(v)];
    for (std::size_t p = 0; p < stars_.size(); ++p)
        if (degree[p] > 0) stars_[p].reserve(at(degree[p] + degree[p] / 2 + 4));
    const std::size_t room = tets.size() * 3 / 2;
    tets_.reserve(room);
    neighbours_.reserve(room);
    alive_.reserve(room);
    solid_.reserve(room);
    stamp_.reserve(room);
}

// Buckets by lowest corner keep this linear but for the sort inside a bucket.
void TetComplex::pair_faces(const ExactMesh& mesh) {
    const auto face = [&](int t, int i) {
        const Tet& v = tets_[at(t)];
        return sorted(v[at(kFace[i][0])], v[at(kFace[i][1])], v[at(kFace[i][2])]);
    };
    std::vector<int> start(exact_.size() + 1, 0);
    for (int t = 0; t < id_count(); ++t)
        for (int i = 0; i < 4; ++i) ++start[at(face(t, i)[0]) + 1];
    for (const Triangle& s : mesh.skin) ++start[at(sorted(s[0], s[1], s[2])[0]) + 1];
    for (std::size_t p = 1; p < start.size(); ++p) start[p] += start[p - 1];
    std::vector<FaceKey> keys(at(start.back()));
    std::vector<int> fill(start.begin(), start.end() - 1);
    for (int t = 0; t < id_count(); ++t)
        for (int i = 0; i < 4; ++i) {
            const Triangle f = face(t, i);
            keys[at(fill[at(f[0])]++)] = {upper_corners(f), 4 * t + i};
        }
    for (std::size_t s = 0; s < mesh.skin.size(); ++s) {
        const Triangle f = sorted(mesh.skin[s][0], mesh.skin[s][1], mesh.skin[s][2]);
        keys[at(fill[at(f[0])]++)] = {upper_corners(f), ~static_cast<int>(s)};
    }
    for (std::size_t p = 0; p + 1 < start.size(); ++p) {
        FaceKey* const first = keys.data() + start[p];
        FaceKey* const last = keys.data() + start[p + 1];
        // Tetrahedra (positive codes) come before skin triangles.
        std::sort(first, last, [](const FaceKey& a, const FaceKey& b) {
            return a.corners != b.corners ? a.corners < b.corners : a.code > b.code;
        });
        for (FaceKey* i = first; i != last;) {
            FaceKey* j = i;
            while (j != last && j->corners == i->corners) ++j;
            link_sides(mesh, static_cast<int>(p), i, j);
            i = j;
        }
    }
}

// All that lies on one triangle: two tetrahedra, or as many as skin triangles, which they face.
void TetComplex::link_sides(const ExactMesh& mesh, int lowest, const FaceKey* first,
                            const FaceKey* last) {
    const auto fail = [&](const char* what) {
        throw VerificationFailed(std::string("tetrahedra before compaction: ") + what +
                                 " at points " + std::to_string(lowest) + ", " +
                                 std::to_string(first->corners >> 32) + ", " +
                                 std::to_string(first->corners & 0xffffffffu));
    };
    const FaceKey* skin = first;
    while (skin != last && skin->code >= 0) ++skin;
    const auto sides = skin - first, skins = last - skin;
    if (sides > 2) fail("three tetrahedra on a triangle");
    if (sides == 2 && skins == 0) {
        set_neighbour(first[0].code, first[1].code);
        set_neighbour(first[1].code, first[0].code);
        return;
    }
    if (sides != skins) fail("skin and tetrahedra disagree");
    for (const FaceKey* side = first; side != skin; ++side) {
        int source = -1;
        for (const FaceKey* k = skin; k != last; ++k)
            if (faces_outward(side->code, mesh.skin[at(~k->code)]))
                source = mesh.skin_source[at(~k->code)];
        if (source < 0) fail("a skin triangle faces inward");
        set_neighbour(side->code, ~classes_.of_triangle[at(source)]);
    }
}

bool TetComplex::faces_outward(int code, const Triangle& triangle) const {
    const Tet& v = tets_[at(code / 4)];
    const int* f = kFace[code % 4];
    for (int k = 0; k < 3; ++k)
        if (v[at(f[k])] == triangle[0]) return v[at(f[(k + 1) % 3])] == triangle[1];
    return false;
}

void TetComplex::write_back(ExactMesh& mesh, std::vector<Vec3d>* places) const {
    std::vector<int> id(exact_.size(), -1);
    for (std::size_t p = 0; p < exact_.size(); ++p)
        if (carriers_[p].kind == CarrierKind::vertex) id[p] = 0;
    ExactMesh out;
    out.tets.reserve(at(live_));
    for (int t = 0; t < id_count(); ++t)
        if (alive(t))
            for (int v : tets_[at(t)]) id[at(v)] = 0;
    if (places) places->clear();
    for (std::size_t p = 0; p < exact_.size(); ++p) {
        if (id[p] < 0) continue;
        id[p] = static_cast<int>(out.points.size());
        out.points.push_back(exact_[p]);
        out.carriers.push_back(carriers_[p]);
        if (places) places->push_back(place_[p]);
    }
    for (int t = 0; t < id_count(); ++t) {
        if (!alive(t)) continue;
        const Tet& v = tets_[at(t)];
        out.tets.push_back({id[at(v[0])], id[at(v[1])], id[at(v[2])], id[at(v[3])]});
        out.tet_solid.push_back(solid_[at(t)]);
        for (int i = 0; i < 4; ++i) {
            const int code = neighbour(t, i);
            if (code >= 0) continue;
            out.skin.push_back({id[at(v[at(kFace[i][0])])], id[at(v[at(kFace[i][1])])],
                                id[at(v[at(kFace[i][2])])]});
            out.skin_source.push_back(facet_class(~code).triangle);
        }
    }
    mesh = std::move(out);
}

int TetComplex::add(const Tet& t, int solid) {
    const int id = id_count();
    tets_.push_back(t);
    neighbours_.push_back({-1, -1, -1, -1});
    alive_.push_back(1);
    solid_.push_back(solid);
    stamp_.push_back(0);
    for (int v : t) enter_star(v, id);
    ++live_;
    return id;
}

// Stale ids pile up at points whose star nobody asks for: drop them before the list has to grow.
void TetComplex::enter_star(int p, int t) {
    std::vector<int>& list = stars_[at(p)];
    if (list.size() == list.capacity() && list.size() >= 32) {
        star_of(p);
        list.reserve(2 * list.size() + 32);
    }
    list.push_back(t);
}

const std::vector<int>& TetComplex::star_of(int p) {
    std::vector<int>& list = stars_[at(p)];
    if (++clock_ == 0) {
        std::fill(stamp_.begin(), stamp_.end(), 0u);
        clock_ = 1;
    }
    std::size_t n = 0;
    for (int t : list) {
        // Ids above the end are of undone tetrahedra; ids may have been given again since.
        if (t >= id_count() || !alive(t) || stamp_[at(t)] == clock_ || !contains(tets_[at(t)], p))
            continue;
        stamp_[at(t)] = clock_;
        list[n++] = t;
    }
    list.resize(n);
    return list;
}

bool TetComplex::exactly_positive(int a, int b, int c, int d) const {
    if (is_integer_[at(a)] && is_integer_[at(b)] && is_integer_[at(c)] && is_integer_[at(d)])
        return orient3d(integer_[at(a)], integer_[at(b)], integer_[at(c)], integer_[at(d)]) > 0;
    return orient3d(exact_[at(a)], exact_[at(b)], exact_[at(c)], exact_[at(d)]) > 0;
}

bool TetComplex::positive(int ia, int ib, int ic, int id) const {
    const Vec3d &a = grid_[at(ia)], &b = grid_[at(ib)], &c = grid_[at(ic)], &d = grid_[at(id)];
    const double ux = b[0] - a[0], uy = b[1] - a[1], uz = b[2] - a[2];
    const double vx = c[0] - a[0], vy = c[1] - a[1], vz = c[2] - a[2];
    const double wx = d[0] - a[0], wy = d[1] - a[1], wz = d[2] - a[2];
    const double det =
        (uy * vz - uz * vy) * wx + (uz * vx - ux * vz) * wy + (ux * vy - uy * vx) * wz;
    // Each difference is off by at most h; with h inside x, y, z the determinant is then off by at
    // most 6 h (xy + yz + zx), and its own rounding by 2^-49 of the permanent, at most 6 x y z.
    const double h = 2 * (moved_ ? grid_slack_ : place_slack_);
    const double x = std::max({std::fabs(ux), std::fabs(vx), std::fabs(wx)}) + h;
    const double y = std::max({std::fabs(uy), std::fabs(vy), std::fabs(wy)}) + h;
    const double z = std::max({std::fabs(uz), std::fabs(vz), std::fabs(wz)}) + h;
    const double bound = 6.01 * (h * (x * y + y * z + z * x) + 0x1p-49 * (x * y * z));
    if (det < -bound) return false;
    if (det > bound) {
        if (!moved_ || grid_only_) return true;
    } else if (!exactly_positive(ia, ib, ic, id)) {
        return false;
    }
    if (grid_only_) return true;
    return orient3d(place_[at(ia)], place_[at(ib)], place_[at(ic)], place_[at(id)]) > 0;
}

bool TetComplex::place_positive(const Tet& t) const {
    return orient3d(place_[at(t[0])], place_[at(t[1])], place_[at(t[2])], place_[at(t[3])]) > 0;
}

void TetComplex::collapse(int p, int q) {
    assert(log_.empty());
    const std::vector<int>& star = star_of(p);
    for (int t : star) {
        const int i = corner(tets_[at(t)], p), j = corner(tets_[at(t)], q);
        if (j < 0) continue;
        // The two faces that fold onto one another hand each other their outer neighbours.
        const int beyond_p = neighbour(t, i), beyond_q = neighbour(t, j);
        assert(beyond_p >= 0 || beyond_q >= 0);
        if (beyond_p >= 0) set_neighbour(beyond_p, beyond_q);
        if (beyond_q >= 0) set_neighbour(beyond_q, beyond_p);
        alive_[at(t)] = 0;
        --live_;
    }
    for (int t : star) {
        if (!alive(t)) continue;
        tets_[at(t)][at(corner(tets_[at(t)], p))] = q;
        enter_star(q, t);
    }
    stars_[at(p)].clear();
}

void TetComplex::peel(int t) {
    assert(log_.empty());
    std::vector<int> skin;
    double largest = -1;
    int kept = -1;
    for (int i = 0; i < 4; ++i) {
        if (neighbour(t, i) >= 0) continue;
        skin.push_back(~neighbour(t, i));
        const double area = norm(normal_of(grid_[at(tets_[at(t)][at(kFace[i][0])])],
                                           grid_[at(tets_[at(t)][at(kFace[i][1])])],
                                           grid_[at(tets_[at(t)][at(kFace[i][2])])]));
        if (area <= largest) continue;
        largest = area;
        kept = skin.back();
    }
    assert(skin.size() == 2);
    peeled_.push_back({facet_class(skin[0]).triangle, facet_class(skin[1]).triangle});
    for (int i = 0; i < 4; ++i) {
        const int code = neighbour(t, i);
        if (code < 0) continue;
        FacetClass fresh = facet_class(kept);
        fresh.plane = -2 - static_cast<int>(classes_.classes.size());
        classes_.classes.push_back(fresh);
        neighbours_[at(code / 4)][at(code % 4)] = ~(static_cast<int>(classes_.classes.size()) - 1);
    }
    alive_[at(t)] = 0;
    --live_;
}

void TetComplex::apply(const Flip& flip) {
    struct Side {
        unsigned corners;
        int code;
    };
    std::array<int, 12> local;
    int local_count = 0;
    const auto bit = [&](int v) {
        for (int i = 0; i < local_count; ++i)
            if (local[at(i)] == v) return 1u << i;
        local[at(local_count)] = v;
        return 1u << local_count++;
    };
    std::array<Side, 48> open;
    int open_count = 0;
    const auto match = [&](unsigned corners) -> Side* {
        for (int i = 0; i < open_count; ++i)
            if (open[at(i)].corners == corners) return &open[at(i)];
        return nullptr;
    };
    const auto each_face = [&](const Tet& t, auto&& visit) {
        unsigned bits[4];
        for (int i = 0; i < 4; ++i) bits[i] = bit(t[at(i)]);
        const unsigned all = bits[0] | bits[1] | bits[2] | bits[3];
        for (int i = 0; i < 4; ++i) visit(i, all & ~bits[i]);
    };
    int solid = 0;
    for (int t : flip.killed()) {
        solid = solid_[at(t)];
        each_face(tets_[at(t)], [&](int i, unsigned corners) {
            // Two killed tetrahedra on a triangle: it is inside and vanishes.
            if (Side* s = match(corners)) {
                *s = open[at(--open_count)];
            } else {
                open[at(open_count++)] = {corners, neighbour(t, i)};
            }
        });
        alive_[at(t)] = 0;
        --live_;
        log_.push_back(t);
    }
    log_.push_back(flip.kill_count);
    log_.push_back(flip.add_count);
    for (const Tet& v : flip.added()) {
        const int t = add(v, solid);
        each_face(v, [&](int i, unsigned corners) {
            const int here = 4 * t + i;
            if (Side* s = match(corners)) {
                neighbours_[at(t)][at(i)] = s->code;
                if (s->code >= 0) neighbours_[at(s->code / 4)][at(s->code % 4)] = here;
                *s = open[at(--open_count)];
            } else {
                open[at(open_count++)] = {corners, here};
            }
        });
    }
    // What is still open is skin: that of the killed, which is gone, or new on added tetrahedra.
    for (int i = 0; i < open_count; ++i) {
        const int code = open[at(i)].code;
        if (code < 0) continue;
        assert(code / 4 >= id_count() - flip.add_count && flip.skin_class >= 0);
        neighbours_[at(code / 4)][at(code % 4)] = ~flip.skin_class;
    }
}

void TetComplex::undo_to(std::size_t mark) {
    while (log_.size() > mark) {
        const int added = log_.back();
        log_.pop_back();
        const int killed = log_.back();
        log_.pop_back();
        const std::size_t keep = tets_.size() - at(added);
        tets_.resize(keep);
        neighbours_.resize(keep);
        alive_.resize(keep);
        solid_.resize(keep);
        stamp_.resize(keep);
        live_ += killed - added;
        for (int k = 0; k < killed; ++k) {
            const int t = log_.back();
            log_.pop_back();
            alive_[at(t)] = 1;
            for (int i = 0; i < 4; ++i) {
                const int code = neighbour(t, i);
                if (code >= 0) neighbours_[at(code / 4)][at(code % 4)] = 4 * t + i;
            }
            for (int v : tets_[at(t)]) enter_star(v, t);
        }
    }
}

}  // namespace tetra
