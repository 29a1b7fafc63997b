// SPDX-License-Identifier: LGPL-2.1-or-later
// Sums projected areas of facets and of their skin modulo 2^61 - 1.
#include "skin_area.h"

#include "tetra/errors.h"

namespace tetra::fence {
namespace {

using Residue = std::array<std::uint64_t, 3>;

std::uint64_t plus(std::uint64_t a, std::uint64_t b) {
    const std::uint64_t s = a + b;
    return s >= kHashPrime ? s - kHashPrime : s;
}
std::uint64_t minus(std::uint64_t a, std::uint64_t b) {
    return a >= b ? a - b : a + kHashPrime - b;
}

Residue residue_of(const Vec3i& p) {
    Residue r;
    for (std::size_t k = 0; k < 3; ++k)
        r[k] = p[k] >= 0 ? static_cast<std::uint64_t>(p[k])
                         : kHashPrime - static_cast<std::uint64_t>(-p[k]);
    return r;
}

// A coordinate along which the facet does not vanish when projected.
std::size_t dropped_axis(const Plane& plane) { return plane.c ? 2 : (plane.a ? 0 : 1); }

std::uint64_t area(const Residue& p, const Residue& q, const Residue& r, std::size_t dropped) {
    const std::size_t u = (dropped + 1) % 3, v = (dropped + 2) % 3;
    return minus(multiply_mod(minus(q[u], p[u]), minus(r[v], p[v])),
                 multiply_mod(minus(q[v], p[v]), minus(r[u], p[u])));
}

}  // namespace

void check_skin_area(const Plan& plan, const Joints& joints, const Columns& columns) {
    std::vector<Residue> residue(joints.marks.size());
    std::vector<char> known(joints.marks.size(), 0);
    const auto residue_at = [&](int mark) -> const Residue& {
        Residue& r = at(residue, mark);
        if (!at(known, mark)) {
            const Mark& m = at(joints.marks, mark);
            r = m.surface < 0 ? residue_of(plan.at(m.carrier.first)) : residues(place_of(plan, m));
            at(known, mark) = 1;
        }
        return r;
    };
    std::vector<std::uint64_t> rest(plan.facets.size(), 0);
    for (std::size_t t = 0; t < plan.facet_of.size(); ++t) {
        const int facet = plan.facet_of[t];
        const Triangle& tri = plan.input->triangles[t];
        at(rest, facet) =
            plus(at(rest, facet),
                 area(residue_of(plan.at(tri[0])), residue_of(plan.at(tri[1])),
                      residue_of(plan.at(tri[2])), dropped_axis(at(plan.facets, facet).plane)));
    }
    for (std::size_t i = 0; i < columns.skin.size(); ++i) {
        const int facet = columns.skin_facet[i];
        const Triangle& t = columns.skin[i];
        at(rest, facet) =
            minus(at(rest, facet), area(residue_at(t[0]), residue_at(t[1]), residue_at(t[2]),
                                        dropped_axis(at(plan.facets, facet).plane)));
    }
    Defect defect{"face_contact",
                  {},
                  {},
                  "the decomposition does not cover the listed triangles' facets exactly once: two "
                  "shells share part of a face, or the surface crosses itself; separate the shells "
                  "or make them different solids"};
    for (int f = 0; f < plan.facet_count(); ++f)
        if (at(rest, f) != 0) defect.triangles.push_back(at(plan.facets, f).triangle);
    if (!defect.triangles.empty()) throw InvalidSolid({defect});
}

}  // namespace tetra::fence
