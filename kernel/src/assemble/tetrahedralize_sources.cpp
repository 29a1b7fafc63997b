// SPDX-License-Identifier: LGPL-2.1-or-later
// Which triangle of its facet a skin triangle lies on: a search in plan, to prefer, not to decide.
#include <algorithm>
#include <cmath>

#include "tetrahedralize_solid.h"

namespace tetra {
namespace {

using Plan = std::array<double, 2>;

std::size_t index(int i) { return static_cast<std::size_t>(i); }

double turn(const Plan& a, const Plan& b, const Plan& c) {
    return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}

// The triangles of one facet, projected along the axis nearest to its normal, in square bins.
class FacetPlan {
  public:
    FacetPlan(const GridSolid& solid, const std::vector<int>& triangles)
        : solid_(solid), triangles_(triangles) {
        const Triangle& t = solid.triangles[index(triangles.front())];
        double most = -1;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const std::size_t u = (axis + 1) % 3, v = (axis + 2) % 3;
            const double area =
                std::abs(turn(corner(t, 0, u, v), corner(t, 1, u, v), corner(t, 2, u, v)));
            if (area > most) {
                most = area;
                u_ = u;
                v_ = v;
            }
        }
        lo_ = hi_ = corner(t, 0, u_, v_);
        for (const int id : triangles)
            for (std::size_t k = 0; k < 3; ++k) {
                const Plan p = corner(solid.triangles[index(id)], k, u_, v_);
                for (std::size_t d = 0; d < 2; ++d) {
                    lo_[d] = std::min(lo_[d], p[d]);
                    hi_[d] = std::max(hi_[d], p[d]);
                }
            }
        const double side = std::sqrt(static_cast<double>(triangles.size()));
        count_ = std::clamp(static_cast<int>(side), 1, 512);
        bins_.resize(index(count_) * index(count_));
        for (const int id : triangles) fill(id);
    }

    // The triangle in which p lies deepest, or the first of the facet.
    int at(const Vec3d& p) const {
        const Plan q{p[u_], p[v_]};
        int best = triangles_.front();
        double depth = -1e-9;
        for (const int id : bins_[bin(q[0], 0) + index(count_) * bin(q[1], 1)]) {
            const Triangle& t = solid_.triangles[index(id)];
            const Plan a = corner(t, 0, u_, v_), b = corner(t, 1, u_, v_), c = corner(t, 2, u_, v_);
            const double area = turn(a, b, c);
            const double least =
                std::min({turn(a, b, q) / area, turn(b, c, q) / area, turn(c, a, q) / area});
            if (least > depth) {
                depth = least;
                best = id;
            }
        }
        return best;
    }

  private:
    Plan corner(const Triangle& t, std::size_t k, std::size_t u, std::size_t v) const {
        const Vec3i& p = solid_.points[index(t[k])];
        return {static_cast<double>(p[u]), static_cast<double>(p[v])};
    }

    std::size_t bin(double x, std::size_t d) const {
        const double share = (x - lo_[d]) / (hi_[d] - lo_[d]);
        return index(std::clamp(static_cast<int>(share * count_), 0, count_ - 1));
    }

    void fill(int id) {
        const Triangle& t = solid_.triangles[index(id)];
        Plan lo = corner(t, 0, u_, v_), hi = lo;
        for (std::size_t k = 1; k < 3; ++k) {
            const Plan p = corner(t, k, u_, v_);
            for (std::size_t d = 0; d < 2; ++d) {
                lo[d] = std::min(lo[d], p[d]);
                hi[d] = std::max(hi[d], p[d]);
            }
        }
        for (std::size_t y = bin(lo[1], 1); y <= bin(hi[1], 1); ++y)
            for (std::size_t x = bin(lo[0], 0); x <= bin(hi[0], 0); ++x)
                bins_[x + index(count_) * y].push_back(id);
    }

    const GridSolid& solid_;
    const std::vector<int>& triangles_;
    std::size_t u_ = 0, v_ = 1;
    Plan lo_{}, hi_{};
    int count_ = 1;
    std::vector<std::vector<int>> bins_;
};

}  // namespace

void locate_sources(ExactMesh& mesh, const GridSolid& solid, const std::vector<int>& owners) {
    std::vector<std::vector<int>> members, skin;
    for (std::size_t t = 0; t < owners.size(); ++t) {
        if (index(owners[t]) >= members.size()) members.emplace_back();
        members[index(owners[t])].push_back(static_cast<int>(t));
    }
    skin.resize(members.size());
    for (std::size_t s = 0; s < mesh.skin.size(); ++s)
        skin[index(owners[index(mesh.skin_source[s])])].push_back(static_cast<int>(s));
    for (std::size_t f = 0; f < members.size(); ++f) {
        if (members[f].size() < 2 || skin[f].empty()) continue;
        const FacetPlan plan(solid, members[f]);
        for (const int s : skin[f]) {
            Vec3d middle{0, 0, 0};
            for (const int p : mesh.skin[index(s)]) {
                const Vec3d point = to_doubles(mesh.points[index(p)]);
                for (std::size_t k = 0; k < 3; ++k) middle[k] += point[k] / 3;
            }
            mesh.skin_source[index(s)] = plan.at(middle);
        }
    }
}

}  // namespace tetra
