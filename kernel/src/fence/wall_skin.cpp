// SPDX-License-Identifier: LGPL-2.1-or-later
// Pairs wall triangles, and finds the facet of each single one by line, side and place.
#include "wall_skin.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "tetra/errors.h"

namespace tetra::fence {
namespace {

struct Keyed {
    std::array<int, 3> key;
    int index;
};

std::vector<Keyed> sorted_by_corners(const std::vector<WallTriangle>& walls) {
    std::vector<Keyed> list;
    list.reserve(walls.size());
    for (int i = 0; i < static_cast<int>(walls.size()); ++i) {
        Keyed k{at(walls, i).corners, i};
        std::sort(k.key.begin(), k.key.end());
        list.push_back(k);
    }
    std::sort(list.begin(), list.end(), [](const Keyed& a, const Keyed& b) {
        return a.key != b.key ? a.key < b.key : a.index < b.index;
    });
    return list;
}

// A point of a vertical plane in the coordinates (t, z) of its line, times w > 0.
struct Flat {
    Int256 t, z, w;
};

class FacetFinder {
  public:
    FacetFinder(const Plan& plan, const Walls& walls, const Joints& joints, const Bases& bases,
                const Columns& columns)
        : plan_(plan), walls_(walls), joints_(joints), bases_(bases), columns_(columns) {}

    int facet_of(const WallTriangle& wall) {
        const Run& run = at(walls_.runs, at(bases_.edges, wall.edge).run);
        const Line& line = at(plan_.lines, run.line);
        candidates_.clear();
        for (const int f : plan_.line_facets[run.line]) {
            const Plane& plane = at(plan_.facets, f).plane;
            const Int128 left =
                -static_cast<Int128>(plane.a) * line.dy + static_cast<Int128>(plane.b) * line.dx;
            if ((left > 0) != run.left) candidates_.push_back(f);
        }
        if (candidates_.empty()) fail(run);
        if (candidates_.size() == 1) return candidates_.front();
        return find_by_place(wall, run, line);
    }

  private:
    int find_by_place(const WallTriangle& wall, const Run& run, const Line& line) {
        const auto axis = static_cast<std::size_t>(line.axis);
        double t = 0, z = 0;
        for (std::size_t k = 0; k < 3; ++k) {
            const HPoint p = place(wall.corners[k]);
            corners_[k] = {axis == 0 ? p.x : p.y, p.z, p.w};
            const Vec3d d = to_doubles(p);
            t += d[axis] / 3;
            z += d[2] / 3;
        }
        for (const int f : candidates_)
            for (const int i : plan_.facet_triangles[f]) {
                const Triangle& tri = at(plan_.input->triangles, i);
                if (near(tri, axis, t) && near(tri, 2, z) && holds_centre(tri, axis)) return f;
            }
        fail(run);
    }

    HPoint place(int id) const {
        const auto marks = static_cast<int>(joints_.marks.size());
        return id < marks ? place_of(plan_, at(joints_.marks, id))
                          : at(columns_.cone_points, id - marks);
    }

    bool near(const Triangle& tri, std::size_t axis, double value) const {
        // A step of slack is far beyond the rounding of the centre.
        bool below = false, over = false;
        for (const int v : tri) {
            below |= static_cast<double>(plan_.at(v)[axis]) <= value + 1;
            over |= static_cast<double>(plan_.at(v)[axis]) >= value - 1;
        }
        return below && over;
    }

    bool holds_centre(const Triangle& tri, std::size_t axis) const {
        int signs[3];
        for (std::size_t k = 0; k < 3; ++k)
            signs[k] = side_of_centre(plan_.at(tri[k]), plan_.at(tri[(k + 1) % 3]), axis);
        const bool some_left = signs[0] > 0 || signs[1] > 0 || signs[2] > 0;
        const bool some_right = signs[0] < 0 || signs[1] < 0 || signs[2] < 0;
        return !(some_left && some_right);
    }

    // Sign of u -> v against the mean of the three corners.
    int side_of_centre(const Vec3i& u, const Vec3i& v, std::size_t axis) const {
        const Int256 et(v[axis] - u[axis]), ez(v[2] - u[2]);
        Int512 sum;
        for (std::size_t k = 0; k < 3; ++k) {
            const Flat& p = corners_[k];
            const Int256 value =
                et * (p.z - p.w * Int256(u[2])) - ez * (p.t - p.w * Int256(u[axis]));
            const Int512 others = multiply<8>(corners_[(k + 1) % 3].w, corners_[(k + 2) % 3].w);
            sum += multiply<8>(others, value);
        }
        return sum.sign();
    }

    [[noreturn]] void fail(const Run& run) const {
        throw InvalidSolid(
            {{"self_crossing",
              {},
              {at(plan_.facets, run.floor).triangle, at(plan_.facets, run.ceiling).triangle},
              "a fence between two facets ends on no facet of the solid: the surface "
              "crosses or touches itself near the listed triangles"}});
    }

    const Plan& plan_;
    const Walls& walls_;
    const Joints& joints_;
    const Bases& bases_;
    const Columns& columns_;
    std::vector<int> candidates_;
    std::array<Flat, 3> corners_{};
};

// Does the closed triangle hold the plan point?
bool covers(const Plan& plan, const Triangle& tri, const PlanPoint& p) {
    bool left = false, right = false;
    for (std::size_t k = 0; k < 3; ++k) {
        const Vec3i &u = plan.at(tri[k]), &v = plan.at(tri[(k + 1) % 3]);
        const Int128 ex = v[0] - u[0], ey = v[1] - u[1];
        const Int128 turn = ex * (p.Y - static_cast<Int128>(p.w) * u[1]) -
                            ey * (p.X - static_cast<Int128>(p.w) * u[0]);
        left |= turn > 0;
        right |= turn < 0;
    }
    return !(left && right);
}

}  // namespace

void add_wall_skin(const Plan& plan, const Walls& walls, const Joints& joints, const Bases& bases,
                   Columns& columns, Progress& progress) {
    FacetFinder finder(plan, walls, joints, bases, columns);
    const std::vector<Keyed> list = sorted_by_corners(columns.walls);
    for (std::size_t i = 0; i < list.size();) {
        std::size_t j = i + 1;
        while (j < list.size() && list[j].key == list[i].key) ++j;
        if (j - i == 1) {
            progress.poll("skin", 0.97);
            const WallTriangle& wall = at(columns.walls, list[i].index);
            columns.skin.push_back(wall.corners);
            columns.skin_facet.push_back(finder.facet_of(wall));
        }
        i = j;
    }
}

int triangle_under(const Plan& plan, const Mark& mark, int facet) {
    const std::span<const int> list = plan.facet_triangles[facet];
    const PlanPoint& p = plan.points[mark.point];
    for (const int t : list) {
        const Triangle& tri = at(plan.input->triangles, t);
        bool x[2] = {false, false}, y[2] = {false, false};
        for (const int v : tri) {
            const auto px = static_cast<double>(plan.at(v)[0]),
                       py = static_cast<double>(plan.at(v)[1]);
            x[0] |= px <= p.x + 1;
            x[1] |= px >= p.x - 1;
            y[0] |= py <= p.y + 1;
            y[1] |= py >= p.y - 1;
        }
        if (x[0] && x[1] && y[0] && y[1] && covers(plan, tri, p)) return t;
    }
    return list.front();
}

}  // namespace tetra::fence
