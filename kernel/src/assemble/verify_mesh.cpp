// SPDX-License-Identifier: LGPL-2.1-or-later
// The checks of verify_mesh(), exact ones first.
#include "tetra/assemble/verify_mesh.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <tuple>

#include "tetra/assemble/double_predicates.h"
#include "tetra/errors.h"
#include "vec3.h"

namespace tetra {
namespace {

constexpr int kFaces[4][3] = {{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}};

std::size_t at(int i) { return static_cast<std::size_t>(i); }

Vec3d area_vector(const Vec3d& a, const Vec3d& b, const Vec3d& c) {
    Vec3d n = normal_of(a, b, c);
    for (double& x : n) x /= 2;
    return n;
}

[[noreturn]] void fail(const std::string& what) {
    throw VerificationFailed("the finished mesh is wrong: " + what);
}

template <class Ids>
std::string list(const Ids& ids) {
    std::string r;
    for (int i : ids) r += (r.empty() ? "" : ", ") + std::to_string(i);
    return r;
}

double segment_distance(const Vec3d& p, const Vec3d& a, const Vec3d& b) {
    const Vec3d ab = minus(b, a), ap = minus(p, a);
    const double length2 = dot(ab, ab);
    const double t = length2 > 0 ? std::clamp(dot(ap, ab) / length2, 0.0, 1.0) : 0;
    return norm({ap[0] - t * ab[0], ap[1] - t * ab[1], ap[2] - t * ab[2]});
}

double triangle_distance(const Vec3d& p, const Vec3d& a, const Vec3d& b, const Vec3d& c) {
    const Vec3d n = cross(minus(b, a), minus(c, a));
    const bool inside = dot(cross(minus(b, a), minus(p, a)), n) >= 0 &&
                        dot(cross(minus(c, b), minus(p, b)), n) >= 0 &&
                        dot(cross(minus(a, c), minus(p, c)), n) >= 0;
    const double length = norm(n);
    if (inside && length > 0) return std::fabs(dot(minus(p, a), n)) / length;
    return std::min(
        {segment_distance(p, a, b), segment_distance(p, b, c), segment_distance(p, c, a)});
}

struct FacetSums {
    Vec3d input{0, 0, 0}, skin{0, 0, 0};  // area vectors
    double input_area = 0, skin_area = 0;
    double unevenness = 0;  // largest distance of an input vertex from the mean plane
};

class Checker {
  public:
    Checker(const MeshUnderTest& mesh, const SurfaceUnderTest& surface,
            const CheckTolerance& tolerance, Progress& progress)
        : mesh_(mesh), surface_(surface), tolerance_(tolerance), progress_(progress) {}

    MeshCheck run() {
        check_indices();
        check_signs();
        check_pairing();
        check_points();
        sum_facets();
        check_facets();
        check_volume();
        check_steiner();
        return result_;
    }

  private:
    const Vec3d& point(int p) const { return mesh_.points[at(p)]; }
    const Vec3d& vertex(int v) const { return surface_.vertices[at(v)]; }
    int facet(int triangle) const {
        return surface_.facets.empty() ? 0 : surface_.facets[at(triangle)];
    }

    void check_indices() const {
        const int n = static_cast<int>(mesh_.points.size());
        const auto known = [n](int p) { return p >= 0 && p < n; };
        for (const auto& t : mesh_.tets)
            if (!std::all_of(t.begin(), t.end(), known)) fail("a tetrahedron has an unknown point");
        for (const auto& t : mesh_.skin)
            if (!std::all_of(t.begin(), t.end(), known))
                fail("a skin triangle has an unknown point");
        if (mesh_.skin_source.size() != mesh_.skin.size()) fail("skin without sources");
        for (int k : mesh_.skin_source)
            if (k < 0 || k >= static_cast<int>(surface_.triangles.size()))
                fail("a skin triangle has an unknown source");
        for (const Vec3d& p : mesh_.points)
            if (!std::isfinite(p[0] + p[1] + p[2])) fail("a point is not finite");
    }

    void check_signs() {
        for (std::size_t k = 0; k < mesh_.tets.size(); ++k) {
            progress_.poll("verify", 0.2);
            const auto& t = mesh_.tets[k];
            const int sign = orient3d(point(t[0]), point(t[1]), point(t[2]), point(t[3]));
            if (sign <= 0)
                fail("tetrahedron " + std::to_string(k) + " of points " + list(t) +
                     (sign < 0 ? " is inverted" : " is flat"));
        }
    }

    struct Side {
        int mid, high, solid;
        bool even;  // orientation of the sorted triple
        bool skin;
    };

    template <class Visit>
    void each_side(const Visit& visit) const {
        const auto side = [&](int a, int b, int c, int solid, bool skin) {
            bool even = true;
            if (a > b) std::swap(a, b), even = !even;
            if (b > c) std::swap(b, c), even = !even;
            if (a > b) std::swap(a, b), even = !even;
            visit(a, Side{b, c, solid, even, skin});
        };
        for (std::size_t k = 0; k < mesh_.tets.size(); ++k) {
            const auto& t = mesh_.tets[k];
            const int solid = mesh_.tet_solid.empty() ? 0 : mesh_.tet_solid[k];
            for (const auto& f : kFaces) side(t[at(f[0])], t[at(f[1])], t[at(f[2])], solid, false);
        }
        for (const Triangle& t : mesh_.skin) side(t[0], t[1], t[2], -1, true);
    }

    // Within a group of sides on one triangle: per solid one or two of opposite orientation; the
    // single ones and the skin triangles agree one to one.
    void check_group(int low, const Side* first, const Side* last) const {
        const auto here = [&] { return list(Triangle{low, first->mid, first->high}); };
        int single[2] = {0, 0}, skin[2] = {0, 0};
        for (const Side* i = first; i != last;) {
            if (i->skin) {
                ++skin[i->even];
                ++i;
                continue;
            }
            const Side* j = i;
            while (j != last && !j->skin && j->solid == i->solid) ++j;
            if (j - i > 2) fail("more than two tetrahedra on triangle " + here());
            if (j - i == 2 && i->even == (i + 1)->even)
                fail("two tetrahedra on one side of triangle " + here());
            if (j - i == 1) ++single[i->even];
            i = j;
        }
        if (single[0] != skin[0] || single[1] != skin[1])
            fail("the skin and the tetrahedra disagree at triangle " + here());
    }

    void check_pairing() {
        std::vector<std::size_t> start(mesh_.points.size() + 1, 0);
        each_side([&](int low, const Side&) { ++start[at(low) + 1]; });
        for (std::size_t p = 1; p < start.size(); ++p) start[p] += start[p - 1];
        std::vector<Side> sides(start.back());
        std::vector<std::size_t> fill(start.begin(), start.end() - 1);
        each_side([&](int low, const Side& s) { sides[fill[at(low)]++] = s; });
        for (std::size_t p = 0; p + 1 < start.size(); ++p) {
            progress_.poll("verify", 0.5);
            Side* const first = sides.data() + start[p];
            Side* const last = sides.data() + start[p + 1];
            std::sort(first, last, [](const Side& a, const Side& b) {
                return std::tie(a.mid, a.high, a.solid) < std::tie(b.mid, b.high, b.solid);
            });
            for (Side* i = first; i != last;) {
                Side* j = i;
                while (j != last && j->mid == i->mid && j->high == i->high) ++j;
                check_group(static_cast<int>(p), i, j);
                i = j;
            }
        }
    }

    void check_points() {
        std::vector<int> order(mesh_.points.size());
        for (std::size_t p = 0; p < order.size(); ++p) order[p] = static_cast<int>(p);
        std::sort(order.begin(), order.end(), [&](int a, int b) { return point(a) < point(b); });
        for (std::size_t k = 1; k < order.size(); ++k)
            if (point(order[k - 1]) == point(order[k]))
                fail("points " + std::to_string(order[k - 1]) + " and " + std::to_string(order[k]) +
                     " are equal");
        std::vector<int> found(surface_.vertices.size(), -1);
        for (std::size_t p = 0; p < mesh_.point_source.size(); ++p)
            if (mesh_.point_source[p] >= 0) found[at(mesh_.point_source[p])] = static_cast<int>(p);
        for (int v : surface_.required) {
            if (found[at(v)] < 0) fail("input vertex " + std::to_string(v) + " is lost");
            const Vec3d& p = point(found[at(v)]);
            if (p == vertex(v)) continue;
            ++result_.vertices_moved;
            if (norm(minus(p, vertex(v))) > 2 * tolerance_.step)
                fail("input vertex " + std::to_string(v) + " has moved");
        }
    }

    void sum_facets() {
        int count = 1;
        for (int f : surface_.facets) count = std::max(count, f + 1);
        facets_.resize(at(count));
        std::vector<Vec3d> origin(at(count), Vec3d{0, 0, 0});
        std::vector<char> seen(at(count), 0);
        for (std::size_t k = 0; k < surface_.triangles.size(); ++k) {
            const Triangle& t = surface_.triangles[k];
            const std::size_t f = at(facet(static_cast<int>(k)));
            const Vec3d n = area_vector(vertex(t[0]), vertex(t[1]), vertex(t[2]));
            for (std::size_t i = 0; i < 3; ++i) facets_[f].input[i] += n[i];
            facets_[f].input_area += norm(n);
            if (!seen[f]) origin[f] = vertex(t[0]);
            seen[f] = 1;
        }
        for (std::size_t k = 0; k < surface_.triangles.size(); ++k) {
            FacetSums& sums = facets_[at(facet(static_cast<int>(k)))];
            const double length = norm(sums.input);
            if (length == 0) continue;
            for (int v : surface_.triangles[k]) {
                const double off =
                    dot(minus(vertex(v), origin[at(facet(static_cast<int>(k)))]), sums.input) /
                    length;
                sums.unevenness = std::max(sums.unevenness, std::fabs(off));
            }
        }
        for (std::size_t s = 0; s < mesh_.skin.size(); ++s) {
            const Triangle& t = mesh_.skin[s];
            FacetSums& sums = facets_[at(facet(mesh_.skin_source[s]))];
            const Vec3d n = area_vector(point(t[0]), point(t[1]), point(t[2]));
            for (std::size_t i = 0; i < 3; ++i) sums.skin[i] += n[i];
            sums.skin_area += norm(n);
        }
        for (const FacetSums& f : facets_) {
            input_area_ += f.input_area;
            result_.area += f.skin_area;
        }
        result_.area_error = std::fabs(result_.area / input_area_ - 1);
    }

    // What points off their vertices by up to a step may change of an area.
    double slack() const {
        return result_.vertices_moved == 0 ? 0 : 8 * tolerance_.step * std::sqrt(input_area_);
    }

    void check_facets() {
        if (surface_.facets.empty() && result_.area_error > 1e3 * tolerance_.relative)
            fail("the area of the skin is off by " + std::to_string(result_.area_error));
        if (surface_.facets.empty()) return;
        const double allowed = tolerance_.relative * input_area_ + slack();
        for (std::size_t f = 0; f < facets_.size(); ++f) {
            const FacetSums& s = facets_[f];
            const double off = norm(minus(s.input, s.skin));
            // Another triangulation of an uneven facet has another area, in second order.
            const double fold = std::fabs(s.input_area - s.skin_area);
            if (off > allowed || fold > allowed + 2 * s.unevenness * std::sqrt(s.input_area))
                fail("the skin does not cover facet " + std::to_string(f) + " of input triangle " +
                     std::to_string(first_triangle(static_cast<int>(f))));
        }
    }

    int first_triangle(int f) const {
        for (std::size_t k = 0; k < surface_.facets.size(); ++k)
            if (surface_.facets[k] == f) return static_cast<int>(k);
        return -1;
    }

    void check_volume() {
        const Vec3d origin = surface_.vertices.empty() ? Vec3d{0, 0, 0} : vertex(0);
        double expected = 0, magnitude = 0;
        for (const Triangle& t : surface_.triangles) {
            const double v = det3_of_points(origin, vertex(t[0]), vertex(t[1]), vertex(t[2])) / 6;
            expected += v;
            magnitude += std::fabs(v);
        }
        for (const auto& t : mesh_.tets)
            result_.volume +=
                det3_of_points(point(t[0]), point(t[1]), point(t[2]), point(t[3])) / 6;
        double allowed = tolerance_.relative * std::max(expected, 1e-3 * magnitude);
        for (const FacetSums& f : facets_) allowed += f.input_area * f.unevenness;
        if (surface_.facets.empty() || result_.vertices_moved > 0)
            allowed += tolerance_.step * input_area_;
        result_.volume_error = std::fabs(result_.volume / expected - 1);
        if (!(std::fabs(result_.volume - expected) <= allowed))
            fail("volume " + std::to_string(result_.volume) + " instead of " +
                 std::to_string(expected));
    }

    // Steiner points of the skin against the triangles of the facets they bound.
    void check_steiner() {
        Vec3d low = vertex(0), high = vertex(0);
        for (const Vec3d& v : surface_.vertices)
            for (std::size_t i = 0; i < 3; ++i) {
                low[i] = std::min(low[i], v[i]);
                high[i] = std::max(high[i], v[i]);
            }
        const double limit =
            tolerance_.distance > 0 ? tolerance_.distance : 0x1p-22 * norm(minus(high, low));
        std::vector<std::vector<int>> members(facets_.size());
        for (std::size_t k = 0; k < surface_.triangles.size(); ++k)
            members[at(facet(static_cast<int>(k)))].push_back(static_cast<int>(k));
        std::vector<std::array<int, 2>> seen;  // (point, facet)
        for (std::size_t s = 0; s < mesh_.skin.size(); ++s)
            for (int p : mesh_.skin[s])
                if (mesh_.point_source.empty() || mesh_.point_source[at(p)] < 0)
                    seen.push_back({p, facet(mesh_.skin_source[s])});
        std::sort(seen.begin(), seen.end());
        seen.erase(std::unique(seen.begin(), seen.end()), seen.end());
        for (const auto& [p, f] : seen) {
            progress_.poll("verify", 0.9);
            double least = std::numeric_limits<double>::infinity();
            for (int k : members[at(f)]) {
                const Triangle& t = surface_.triangles[at(k)];
                least = std::min(
                    least, triangle_distance(point(p), vertex(t[0]), vertex(t[1]), vertex(t[2])));
                if (least <= 1e-9 * limit) break;
            }
            result_.steiner_distance = std::max(result_.steiner_distance, least);
            if (least > limit) fail("point " + std::to_string(p) + " is off the surface");
        }
    }

    const MeshUnderTest& mesh_;
    const SurfaceUnderTest& surface_;
    const CheckTolerance& tolerance_;
    Progress& progress_;
    MeshCheck result_;
    std::vector<FacetSums> facets_;
    double input_area_ = 0;
};

}  // namespace

MeshCheck verify_mesh(const MeshUnderTest& mesh, const SurfaceUnderTest& surface,
                      const CheckTolerance& tolerance, Progress& progress) {
    return Checker(mesh, surface, tolerance, progress).run();
}

}  // namespace tetra
