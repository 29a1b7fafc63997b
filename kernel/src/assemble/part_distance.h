// SPDX-License-Identifier: LGPL-2.1-or-later
// The distance from a point to a part that is given by its convex cells and its skin.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "float_tree.h"
#include "tetra/assemble/limit_cells.h"

namespace tetra {

// The half-space n . x <= height, n a unit vector.
struct HalfSpace {
    Vec3d normal;
    double height;
};

double beyond(const HalfSpace& half, const Vec3d& p);

// The half-spaces under oriented triangles; flat triangles have none.
std::vector<HalfSpace> half_spaces(std::span<const Vec3d> points,
                                   std::span<const Triangle> triangles);

// Facets first to last - 1 as fans of triangles.
std::vector<Triangle> fans(const CellArrays& part, std::int64_t first, std::int64_t last);

using Corners = std::array<Vec3d, 3>;  // of a triangle

struct Ball {
    Vec3d middle;
    double radius;
};

// The ball around a triangle's centroid that reaches its corners.
Ball ball_around(const Corners& corners);

// A triangle divided in the middles of its edges.
std::array<Corners, 4> quarters(const Corners& corners);

// Distance to the nearest of some triangles, O(n).
double distance_to(const Vec3d& p, std::span<const Vec3d> points,
                   std::span<const Triangle> triangles);

class PartDistance {
  public:
    // Keeps a reference to the points of `part`.
    explicit PartDistance(const CellArrays& part);

    // Closer than this counts as inside: rounding has moved the cells' points by less.
    double touching() const { return touching_; }

    // A thousandth of the diagonal: what is closer need not be told apart.
    double coarse() const { return coarse_; }

    // 0 inside. O(log n) expected.
    double operator()(const Vec3d& p) const;

    // Whether one cell contains the triangle; then no point of it is away from the part.
    bool in_one_cell(const Corners& corners) const;

    // The distance of its middle, or nothing when one cell contains the triangle.
    std::optional<double> of_middle(const Corners& corners) const {
        return middle_unless_covered(corners, true);
    }

  private:
    std::span<const Vec3d> points_;
    std::vector<std::vector<HalfSpace>> halves_;  // per cell
    std::vector<Triangle> skin_;
    FloatTree cells_, surface_;
    double touching_ = 0, coarse_ = 0;

    bool inside(std::size_t cell, const Vec3d& p) const;
    double to_surface(const Vec3d& p) const;
    std::optional<double> middle_unless_covered(const Corners& corners, bool measured) const;
};

}  // namespace tetra
