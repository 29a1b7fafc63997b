// SPDX-License-Identifier: LGPL-2.1-or-later
// Least-squares correction of grid points onto the caller's planes.
#include "evaluate.h"

#include <algorithm>
#include <cmath>

namespace tetra::notch {
namespace {

Vec3d to_grid(const Grid& grid, const Vec3d& p) {
    return {(p[0] - grid.origin[0]) / grid.step, (p[1] - grid.origin[1]) / grid.step,
            (p[2] - grid.origin[2]) / grid.step};
}

double dot(const Vec3d& a, const Vec3d& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

Vec3d cross(const Vec3d& a, const Vec3d& b) {
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

// Gram-Schmidt over rows (unit normal, residual): each row that still says something new moves
// the point within the space the earlier rows leave free; one that asks for too much is left out.
class Correction {
  public:
    explicit Correction(double farthest) : farthest_(farthest) {}

    void add(const Vec3d& normal, double residual) {
        if (count_ == 3) return;
        Vec3d n = normal;
        double r = residual - dot(n, shift_);
        for (int i = 0; i < count_; ++i) {
            const double c = dot(n, basis_[i]);
            for (int k = 0; k < 3; ++k) n[k] -= c * basis_[i][k];
        }
        const double length = std::sqrt(dot(n, n));
        // Nearly parallel planes would turn sub-step residuals into large moves.
        if (length < 1e-3) return;
        Vec3d moved = shift_;
        for (int k = 0; k < 3; ++k) {
            n[k] /= length;
            moved[k] += n[k] * r / length;
        }
        if (dot(moved, moved) > farthest_ * farthest_) return;
        shift_ = moved;
        basis_[count_++] = n;
    }
    const Vec3d& shift() const { return shift_; }

  private:
    std::array<Vec3d, 3> basis_{};
    Vec3d shift_{0, 0, 0};
    double farthest_;
    int count_ = 0;
};

void follow_edge(const Line& line, const GridSolid& solid, const std::vector<Vec3d>& vertices,
                 const Vec3d& at, Correction& correction) {
    const Vec3d u = to_grid(solid.grid, vertices[solid.point_source[line.u]]);
    const Vec3d v = to_grid(solid.grid, vertices[solid.point_source[line.v]]);
    Vec3d e{v[0] - u[0], v[1] - u[1], v[2] - u[2]};
    const double length = std::sqrt(dot(e, e));
    for (double& c : e) c /= length;
    const int k = std::fabs(e[0]) < 0.6 ? 0 : 1;
    Vec3d axis{0, 0, 0};
    axis[k] = 1;
    Vec3d n = cross(e, axis);
    const double size = std::sqrt(dot(n, n));
    for (double& c : n) c /= size;
    const Vec3d m = cross(e, n);
    const Vec3d gap{u[0] - at[0], u[1] - at[1], u[2] - at[2]};
    correction.add(n, dot(n, gap));
    correction.add(m, dot(m, gap));
}

}  // namespace

CallerPlanes fit_caller_planes(const GridSolid& solid, const std::vector<Vec3d>& vertices,
                               const std::vector<int>& keys, const PointTable& points) {
    CallerPlanes fit;
    const int planes = points.planes();
    for (int i = 0; i < planes; ++i) fit.unit.push_back(points.unit_plane(i));
    fit.has.assign(static_cast<std::size_t>(planes), 0);
    std::vector<Vec3d> normal(static_cast<std::size_t>(planes), Vec3d{0, 0, 0});
    std::vector<Vec3d> centre(static_cast<std::size_t>(planes), Vec3d{0, 0, 0});
    std::vector<double> weight(static_cast<std::size_t>(planes), 0);
    for (std::size_t t = 0; t < solid.triangles.size(); ++t) {
        const int plane = keys[t] >> 1;
        std::array<Vec3d, 3> p;
        for (int k = 0; k < 3; ++k)
            p[k] = to_grid(solid.grid, vertices[solid.point_source[solid.triangles[t][k]]]);
        const Vec3d a{p[1][0] - p[0][0], p[1][1] - p[0][1], p[1][2] - p[0][2]};
        const Vec3d b{p[2][0] - p[0][0], p[2][1] - p[0][1], p[2][2] - p[0][2]};
        const Vec3d n = cross(a, b);
        const double area = std::sqrt(dot(n, n)), sign = (keys[t] & 1) ? -1 : 1;
        for (int k = 0; k < 3; ++k) {
            normal[plane][k] += sign * n[k];
            centre[plane][k] += area * (p[0][k] + p[1][k] + p[2][k]) / 3;
        }
        weight[plane] += area;
    }
    for (int i = 0; i < planes; ++i) {
        const double length = std::sqrt(dot(normal[i], normal[i]));
        if (weight[i] == 0 || length == 0) continue;
        fit.has[i] = 1;
        for (int k = 0; k < 3; ++k) {
            fit.unit[i][k] = normal[i][k] / length;
            centre[i][k] /= weight[i];
        }
        fit.unit[i][3] = -(fit.unit[i][0] * centre[i][0] + fit.unit[i][1] * centre[i][1] +
                           fit.unit[i][2] * centre[i][2]);
    }
    return fit;
}

Vec3d evaluate_point(const PointTable& points, int point, const GridSolid& solid,
                     const std::vector<Vec3d>& vertices, const CallerPlanes& planes,
                     double farthest) {
    if (point < points.inputs()) return vertices[solid.point_source[point]];
    const Vec3d& at = points.approx(point);
    Correction correction(farthest);
    const int line = points.defining_line(point);
    if (line >= 0 && points.line(line).u >= 0)
        follow_edge(points.line(line), solid, vertices, at, correction);
    for (const int plane : points.on(point)) {
        if (!planes.has[plane]) continue;
        const UnitPlane& n = planes.unit[plane];
        correction.add({n[0], n[1], n[2]}, -height(n, at));
    }
    Vec3d moved = at;
    for (int k = 0; k < 3; ++k) moved[k] += correction.shift()[k];
    return unsnap(solid.grid, moved);
}

}  // namespace tetra::notch
