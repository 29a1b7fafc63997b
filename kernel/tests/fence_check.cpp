// SPDX-License-Identifier: LGPL-2.1-or-later
// Checks meshes with 1024-bit signs behind a floating filter, and sums modulo a prime.
#include "fence_check.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

#include "tetra/exact/plane.h"

namespace tetra::testing {
namespace {

using Wide = WideInt<16>;
using Mod = std::uint64_t;

Mod add(Mod a, Mod b) { return (a + b) % kHashPrime; }
Mod sub(Mod a, Mod b) { return (a + kHashPrime - b) % kHashPrime; }
Mod mod_of(std::int64_t v) { return Int256(v).mod(kHashPrime); }

template <class T, class Mul, class Sub, class Add>
T det3(const std::array<std::array<T, 3>, 3>& m, Mul mul, Sub minus, Add plus) {
    const auto minor = [&](int a, int b, int c, int d) {
        return minus(mul(m[1][a], m[2][b]), mul(m[1][c], m[2][d]));
    };
    return plus(plus(mul(m[0][0], minor(1, 2, 2, 1)), mul(m[0][1], minor(2, 0, 0, 2))),
                mul(m[0][2], minor(0, 1, 1, 0)));
}

class Checker {
  public:
    Checker(const FenceInput& input, const FenceResult& result)
        : in_(input), mesh_(result.mesh), result_(result) {}

    std::string run() {
        for (const HPoint& p : mesh_.points) {
            approximate_.push_back(to_doubles(p));
            residue_.push_back(residues(p));
        }
        for (auto step :
             {&Checker::sizes, &Checker::points, &Checker::orientation, &Checker::pairing,
              &Checker::volume, &Checker::skin, &Checker::carriers}) {
            (this->*step)();
            if (!fault_.empty()) return fault_;
        }
        return {};
    }

  private:
    void fail(const std::string& what) {
        if (fault_.empty()) fault_ = what;
    }
    const HPoint& point(int i) const { return mesh_.points[static_cast<std::size_t>(i)]; }
    const Vec3i& input_point(int i) const { return in_.points[static_cast<std::size_t>(i)]; }

    void sizes() {
        if (mesh_.carriers.size() != mesh_.points.size() ||
            result_.point_source.size() != mesh_.points.size() ||
            mesh_.tet_solid.size() != mesh_.tets.size() ||
            mesh_.skin_source.size() != mesh_.skin.size())
            fail("arrays of different lengths");
    }

    void points() {
        auto sorted = residue_;
        std::sort(sorted.begin(), sorted.end());
        if (in_.solid.empty() && std::adjacent_find(sorted.begin(), sorted.end()) != sorted.end())
            fail("two points at one place");
        std::vector<int> found(in_.points.size(), 0);
        for (std::size_t i = 0; i < mesh_.points.size(); ++i) {
            const int source = result_.point_source[i];
            if (source < 0) continue;
            ++found[static_cast<std::size_t>(source)];
            if (!same_point(mesh_.points[i], hpoint(input_point(source))))
                fail("input point at another place");
        }
        for (const Triangle& t : in_.triangles)
            for (const int v : t) {
                const auto k = static_cast<std::size_t>(v);
                if (found[k] > 1 || (found[k] == 0 && (in_.keep.empty() || in_.keep[k])))
                    fail("input point " + std::to_string(v) + " comes " + std::to_string(found[k]) +
                         " times");
            }
    }

    int orient(const std::array<int, 4>& t) const {
        const auto at = [&](int k) { return approximate_[static_cast<std::size_t>(t[k])]; };
        const Vec3d a = at(0);
        std::array<std::array<double, 3>, 3> m{};
        double largest = 0, scale = 1;
        for (int i = 0; i < 3; ++i)
            for (int k = 0; k < 3; ++k) {
                m[i][k] = at(i + 1)[k] - a[k];
                largest = std::max({largest, std::fabs(at(i + 1)[k]), std::fabs(a[k])});
            }
        double side = 0;
        for (const auto& row : m)
            for (const double v : row) side = std::max(side, std::fabs(v));
        scale = side + largest * 0x1p-48;
        const double det =
            det3(m, std::multiplies<double>(), std::minus<double>(), std::plus<double>());
        const double bound = 0x1p-40 * largest * scale * scale * 0x1p-6;
        if (det > bound) return 1;
        if (det < -bound) return -1;
        return exact_orient(t);
    }

    int exact_orient(const std::array<int, 4>& t) const {
        const HPoint& a = point(t[0]);
        std::array<std::array<Wide, 3>, 3> m{};
        for (int i = 0; i < 3; ++i) {
            const HPoint& p = point(t[i + 1]);
            const auto difference = [&](const Int256& x, const Int256& y) {
                return multiply<16>(x, a.w) - multiply<16>(y, p.w);
            };
            m[i] = {difference(p.x, a.x), difference(p.y, a.y), difference(p.z, a.z)};
        }
        return det3(
                   m, [](const Wide& x, const Wide& y) { return x * y; },
                   [](const Wide& x, const Wide& y) { return x - y; },
                   [](const Wide& x, const Wide& y) { return x + y; })
            .sign();
    }

    void orientation() {
        for (std::size_t i = 0; i < mesh_.tets.size(); ++i)
            if (orient(mesh_.tets[i]) <= 0)
                fail("tetrahedron " + std::to_string(i) + " not positive");
    }

    // Sorted corners and the parity of the sorting.
    static std::pair<std::array<int, 3>, bool> sorted(std::array<int, 3> t) {
        bool odd = false;
        for (const auto& [i, j] : {std::pair{0, 1}, std::pair{1, 2}, std::pair{0, 1}})
            if (t[i] > t[j]) {
                std::swap(t[i], t[j]);
                odd = !odd;
            }
        return {t, odd};
    }

    void pairing() {
        std::vector<std::pair<std::array<int, 3>, bool>> faces;
        for (const auto& t : mesh_.tets)
            for (const std::array<int, 3>& f :
                 {std::array{t[1], t[2], t[3]}, std::array{t[0], t[3], t[2]},
                  std::array{t[0], t[1], t[3]}, std::array{t[0], t[2], t[1]}})
                faces.push_back(sorted(f));
        std::sort(faces.begin(), faces.end());
        std::vector<std::pair<std::array<int, 3>, bool>> single, skin;
        for (std::size_t i = 0; i < faces.size();) {
            std::size_t j = i + 1;
            while (j < faces.size() && faces[j].first == faces[i].first) ++j;
            if (j - i > 2 || (j - i == 2 && faces[i].second == faces[i + 1].second))
                fail("triangle on the same side of two tetrahedra, or on more than two");
            if (j - i == 1) single.push_back(faces[i]);
            i = j;
        }
        for (const Triangle& t : mesh_.skin) skin.push_back(sorted(t));
        std::sort(skin.begin(), skin.end());
        if (skin != single)
            fail("skin (" + std::to_string(skin.size()) + ") differs from the " +
                 std::to_string(single.size()) + " triangles on one tetrahedron");
    }

    static Mod det_mod(const std::array<std::array<Mod, 3>, 3>& m) {
        return det3(m, multiply_mod, sub, add);
    }

    Mod volume_of(const std::vector<Triangle>& surface, bool of_input) const {
        Mod sum = 0;
        for (const Triangle& t : surface) {
            std::array<std::array<Mod, 3>, 3> m{};
            for (std::size_t i = 0; i < 3; ++i)
                for (std::size_t k = 0; k < 3; ++k)
                    m[i][k] = of_input ? mod_of(input_point(t[i])[k])
                                       : residue_[static_cast<std::size_t>(t[i])][k];
            sum = add(sum, det_mod(m));
        }
        return sum;
    }

    void volume() {
        Mod sum = 0;
        for (const auto& t : mesh_.tets) {
            std::array<std::array<Mod, 3>, 3> m{};
            for (std::size_t i = 0; i < 3; ++i)
                for (std::size_t k = 0; k < 3; ++k)
                    m[i][k] = sub(residue_[static_cast<std::size_t>(t[i + 1])][k],
                                  residue_[static_cast<std::size_t>(t[0])][k]);
            sum = add(sum, det_mod(m));
        }
        if (sum != volume_of(in_.triangles, true)) fail("volume differs from the input's");
    }

    // Twice the area in coordinates u, v, modulo the prime.
    static Mod area_mod(const std::array<std::array<Mod, 3>, 3>& p, std::size_t u, std::size_t v) {
        return sub(multiply_mod(sub(p[1][u], p[0][u]), sub(p[2][v], p[0][v])),
                   multiply_mod(sub(p[1][v], p[0][v]), sub(p[2][u], p[0][u])));
    }

    // Sign of the skin triangle's normal along axis k.
    int normal_sign(const Triangle& t, int k) const {
        const int u = (k + 1) % 3, v = (k + 2) % 3;
        std::array<std::array<Wide, 3>, 3> m{};
        for (int i = 0; i < 3; ++i) {
            const HPoint& p = point(t[static_cast<std::size_t>(i)]);
            const Int256* c[3] = {&p.x, &p.y, &p.z};
            m[i] = {Wide(*c[u]), Wide(*c[v]), Wide(p.w)};
        }
        return det3(
                   m, [](const Wide& x, const Wide& y) { return x * y; },
                   [](const Wide& x, const Wide& y) { return x - y; },
                   [](const Wide& x, const Wide& y) { return x + y; })
            .sign();
    }

    void skin() {
        PlaneTable table;
        using Key = std::tuple<int, int, int, int>;  // plane, side, owner, solid
        std::map<Key, Mod> area;
        std::vector<Plane> planes;
        std::vector<Key> keys;
        const auto axis_of = [](const Plane& p) {
            const double a = std::fabs(static_cast<double>(p.a)),
                         b = std::fabs(static_cast<double>(p.b)),
                         c = std::fabs(static_cast<double>(p.c));
            return a >= b && a >= c ? 0 : (b >= c ? 1 : 2);
        };
        for (std::size_t i = 0; i < in_.triangles.size(); ++i) {
            const Triangle& t = in_.triangles[i];
            const Plane plane =
                plane_through(input_point(t[0]), input_point(t[1]), input_point(t[2]));
            const PlaneKey key = table.intern(plane);
            planes.push_back(plane);
            keys.emplace_back(key.id, key.side, in_.owner.empty() ? 0 : in_.owner[i],
                              in_.solid.empty() ? 0 : in_.solid[i]);
            std::array<std::array<Mod, 3>, 3> p{};
            for (std::size_t c = 0; c < 3; ++c)
                for (std::size_t k = 0; k < 3; ++k) p[c][k] = mod_of(input_point(t[c])[k]);
            const auto axis = static_cast<std::size_t>(axis_of(plane));
            Mod& sum = area[keys.back()];
            sum = add(sum, area_mod(p, (axis + 1) % 3, (axis + 2) % 3));
        }
        for (std::size_t i = 0; i < mesh_.skin.size(); ++i) {
            const Triangle& t = mesh_.skin[i];
            const auto source = static_cast<std::size_t>(mesh_.skin_source[i]);
            const Plane& plane = planes[source];
            for (const int v : t)
                if (side_of_plane(plane, point(v)) != 0) return fail("skin off its plane");
            const int axis = axis_of(plane);
            const std::int64_t component = axis == 0 ? plane.a : (axis == 1 ? plane.b : plane.c);
            if (normal_sign(t, axis) != (component > 0 ? 1 : -1)) return fail("skin turned round");
            std::array<std::array<Mod, 3>, 3> p{};
            for (std::size_t c = 0; c < 3; ++c) p[c] = residue_[static_cast<std::size_t>(t[c])];
            const auto u = static_cast<std::size_t>(axis + 1) % 3;
            Mod& sum = area[keys[source]];
            sum = sub(sum, area_mod(p, u, (u + 1) % 3));
        }
        for (const auto& [key, rest] : area)
            if (rest != 0) fail("skin area differs on plane " + std::to_string(std::get<0>(key)));
    }

    void carriers() {
        for (std::size_t i = 0; i < mesh_.points.size(); ++i) {
            const Carrier& c = mesh_.carriers[i];
            if ((c.kind == CarrierKind::vertex) != (result_.point_source[i] >= 0))
                fail("vertex carrier without source");
            if (c.kind == CarrierKind::edge && !on_edge(static_cast<int>(i), c))
                fail("point off its carrier edge");
            if (c.kind == CarrierKind::facet && !on_triangle(static_cast<int>(i), c))
                fail("point off its carrier facet");
        }
    }

    bool on_edge(int i, const Carrier& c) const {
        // Collinear modulo the prime, between the ends in doubles.
        const auto& p = residue_[static_cast<std::size_t>(i)];
        std::array<std::array<Mod, 3>, 3> m{p, {}, {}};
        for (std::size_t k = 0; k < 3; ++k) {
            m[1][k] = mod_of(input_point(c.first)[k]);
            m[2][k] = mod_of(input_point(c.second)[k]);
        }
        for (std::size_t k = 0; k < 3; ++k) {
            if (area_mod(m, (k + 1) % 3, (k + 2) % 3) != 0) return false;
            const auto u = static_cast<double>(input_point(c.first)[k]),
                       v = static_cast<double>(input_point(c.second)[k]);
            const double x = approximate_[static_cast<std::size_t>(i)][k];
            if (x < std::min(u, v) - 1e-6 || x > std::max(u, v) + 1e-6) return false;
        }
        return true;
    }

    bool on_triangle(int i, const Carrier& c) const {
        const Triangle& t = in_.triangles[static_cast<std::size_t>(c.first)];
        const Plane plane = plane_through(input_point(t[0]), input_point(t[1]), input_point(t[2]));
        if (side_of_plane(plane, point(i)) != 0) return false;
        const Vec3d p = approximate_[static_cast<std::size_t>(i)];
        const double n[3] = {static_cast<double>(plane.a), static_cast<double>(plane.b),
                             static_cast<double>(plane.c)};
        for (std::size_t k = 0; k < 3; ++k) {
            const Vec3i &u = input_point(t[k]), &v = input_point(t[(k + 1) % 3]);
            double turn = 0, scale = 0;
            for (std::size_t a = 0; a < 3; ++a) {
                const std::size_t b = (a + 1) % 3, d = (a + 2) % 3;
                const double cross =
                    static_cast<double>(v[b] - u[b]) * (p[d] - static_cast<double>(u[d])) -
                    static_cast<double>(v[d] - u[d]) * (p[b] - static_cast<double>(u[b]));
                turn += n[a] * cross;
                scale += std::fabs(n[a]) * std::fabs(static_cast<double>(v[b] - u[b])) +
                         std::fabs(n[a]) * std::fabs(static_cast<double>(v[d] - u[d]));
            }
            if (turn < -1e-6 * scale) return false;
        }
        return true;
    }

    const FenceInput& in_;
    const ExactMesh& mesh_;
    const FenceResult& result_;
    std::vector<Vec3d> approximate_;
    std::vector<std::array<Mod, 3>> residue_;
    std::string fault_;
};

}  // namespace

std::string fence_fault(const FenceInput& input, const FenceResult& result) {
    return Checker(input, result).run();
}

}  // namespace tetra::testing
