// SPDX-License-Identifier: LGPL-2.1-or-later
// The caller's planes first, the grid's where cells would not stay convex.
#include "place_points.h"

#include <cmath>
#include <limits>

#include "check_cells.h"
#include "evaluate.h"

namespace tetra::notch {
namespace {

// Planes whose points the caller's and the grid's place within so many steps are not at fault.
constexpr double kSmallTurn = 2;

// Points of an exact run that move no farther are what find_misplaced() allows.
constexpr double kSmallMove = 4;

constexpr int kRounds = 8;

class Placer {
  public:
    Placer(const GridSolid& solid, const std::vector<Vec3d>& vertices, Decomposition& result)
        : solid_(solid),
          vertices_(vertices),
          r_(result),
          planes_(fit_caller_planes(solid, vertices, result.classes.key, result.points)) {}

    void run() {
        find_points();
        find_turned();
        place(std::numeric_limits<double>::infinity());
        for (int round = 0; round < kRounds; ++round) {
            const std::vector<Fault> faults = find_misplaced(solid_.grid, r_);
            if (faults.empty()) return;
            if (!turn_back(faults)) break;
            place(std::numeric_limits<double>::infinity());
        }
        for (std::size_t i = 0; i < turned_.size(); ++i)
            if (turned_[i]) turn_back(static_cast<int>(i));
        place(kSmallMove);
    }

  private:
    void find_points() {
        std::vector<char> used(static_cast<std::size_t>(r_.points.points()), 0);
        for (int h = 0; h < r_.edges.size(); ++h)
            if (r_.edges.alive(h)) used[r_.edges[h].org] = 1;
        for (int p = 0; p < r_.points.points(); ++p)
            if (used[p]) used_.push_back(p);
    }

    void find_turned() {
        turned_.assign(planes_.has.size(), 0);
        for (const int p : used_)
            for (const int plane : r_.points.on(p))
                turned_[plane] |=
                    std::fabs(height(planes_.unit[plane], r_.points.approx(p))) > kSmallTurn;
    }

    // False when no plane is left that could be at fault.
    bool turn_back(const std::vector<Fault>& faults) {
        bool any = false;
        for (const Fault& fault : faults)
            for (const int plane : fault.planes)
                if (turned_[plane]) {
                    turn_back(plane);
                    any = true;
                }
        return any;
    }

    void turn_back(int plane) {
        planes_.unit[plane] = r_.points.unit_plane(plane);
        turned_[plane] = 0;
    }

    void place(double farthest) {
        r_.placed_planes = planes_.unit;
        r_.placed.assign(static_cast<std::size_t>(r_.points.points()), Vec3d{});
        for (const int p : used_)
            r_.placed[p] = evaluate_point(r_.points, p, solid_, vertices_, planes_, farthest);
    }

    const GridSolid& solid_;
    const std::vector<Vec3d>& vertices_;
    Decomposition& r_;
    CallerPlanes planes_;
    std::vector<int> used_;     // points
    std::vector<char> turned_;  // per plane
};

}  // namespace

void place_points(const GridSolid& solid, const std::vector<Vec3d>& vertices,
                  Decomposition& result) {
    Placer(solid, vertices, result).run();
}

}  // namespace tetra::notch
