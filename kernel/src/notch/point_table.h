// SPDX-License-Identifier: LGPL-2.1-or-later
// The points, lines and planes of a run of notch cutting: one id per place, signs by incidence
// first.
#pragma once

#include <array>
#include <cmath>
#include <vector>

#include "flat_map.h"
#include "tetra/exact/hpoint.h"

namespace tetra::notch {

// Unit normal and offset in grid steps.
using UnitPlane = std::array<double, 4>;

inline double height(const UnitPlane& n, const Vec3d& p) {
    return n[0] * p[0] + n[1] * p[1] + n[2] * p[2] + n[3];
}

// The support of an edge: an input edge (u, v = point ids) or two planes (p, q = plane ids).
struct Line {
    int u = -1, v = -1;
    int p = -1, q = -1;
};

// A direction in exact integers, at most 4b+7 bits.
using Direction = std::array<Int128, 3>;

// The axis along which a direction or normal is longest, the first of several, and its sign there.
struct Dominant {
    int axis = 0;
    int sign = 0;
};

template <class Integer>
Dominant dominant(const std::array<Integer, 3>& d) {
    const std::array<double, 3> m{std::fabs(static_cast<double>(d[0])),
                                  std::fabs(static_cast<double>(d[1])),
                                  std::fabs(static_cast<double>(d[2]))};
    const int axis = m[0] >= m[1] && m[0] >= m[2] ? 0 : (m[1] >= m[2] ? 1 : 2);
    return {axis, d[axis] > 0 ? 1 : (d[axis] < 0 ? -1 : 0)};
}

inline Dominant dominant(const Plane& p) { return dominant(Vec3i{p.a, p.b, p.c}); }

// Signs of `side` above this many grid steps are trusted before incidence is asked; no vertex of
// a plane class lies farther from its plane (NOTCHES 4).
inline constexpr double kClassReach = 16;

class PointTable {
  public:
    explicit PointTable(int grid_bits) : tolerance_(std::ldexp(1.0, grid_bits - 46)) {}

    int add_input(const Vec3i& point);
    // An input point that lies on three planes of its facets instead of on the grid.
    int add_moved_input(const Vec3i& grid, const HPoint& exact, const Vec3d& approx);
    int add_point(const HPoint& exact);  // interned; marks of planes are the caller's
    int add_plane(const Plane& plane);   // interned; returns key = 2 id + (reversed ? 1 : 0)
    int input_line(int u, int v);
    int plane_line(int p, int q);
    // The point where a line meets a plane that is not parallel to it; lies on `also` too.
    int meet(int line, int plane, int also_p, int also_q);

    void set_on(int point, int plane);
    bool is_on(int point, int plane) const;
    // By arithmetic alone.
    bool is_exactly_on(int point, int plane) const {
        return side_of_plane(planes_[plane], exact_[point]) == 0;
    }
    // Sign of plane (as stored) at point: 0 by incidence, else arithmetic.
    int side(int point, int plane);
    // Sign of coordinate `axis` of a minus that of b, exactly.
    int compare(int a, int b, int axis) const;
    // Orientation of three points projected along `axis`.
    int orient(int a, int b, int c, int axis) const;

    Direction cross(int p, int q) const;  // normal of p x normal of q
    Direction direction(int line) const;

    int points() const { return static_cast<int>(approx_.size()); }
    int planes() const { return planes_.size(); }
    int inputs() const { return static_cast<int>(inputs_.size()); }
    int lines() const { return static_cast<int>(lines_.size()); }
    const Vec3d& approx(int point) const { return approx_[point]; }
    const HPoint& exact(int point) const { return exact_[point]; }
    const Plane& plane(int id) const { return planes_[id]; }
    const UnitPlane& unit_plane(int id) const { return unit_[id]; }
    const Line& line(int id) const { return lines_[id]; }
    const std::vector<int>& on(int point) const { return on_[point]; }
    int defining_line(int point) const { return line_of_[point]; }
    const Vec3i& input(int point) const { return inputs_[point]; }
    bool is_moved(int point) const { return moved_[point]; }
    double distance(int point, int plane) const { return height(unit_[plane], approx_[point]); }
    double tolerance() const { return tolerance_; }

  private:
    int find(const HPoint& exact, const Vec3d& approx, std::uint64_t& cell) const;
    int intern(const HPoint& exact, const Vec3d& approx);
    int append(const HPoint& exact, const Vec3d& approx, std::uint64_t cell);

    double tolerance_;  // bounds the error of distance() and of approx(), in grid steps
    PlaneTable planes_;
    std::vector<UnitPlane> unit_;
    std::vector<Vec3i> inputs_;  // input points come first
    std::vector<char> moved_;    // per input point: not where its grid coordinates are
    std::vector<HPoint> exact_;
    std::vector<Vec3d> approx_;
    std::vector<std::vector<int>> on_;
    std::vector<int> line_of_;
    std::vector<int> next_in_cell_;
    std::vector<Line> lines_;
    FlatMap cells_;        // hash of rounded place -> first point
    FlatMap plane_lines_;  // (p, q) -> line
    FlatMap meets_;        // (line, plane) -> point
};

}  // namespace tetra::notch
