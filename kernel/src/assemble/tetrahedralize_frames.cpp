// SPDX-License-Identifier: LGPL-2.1-or-later
// Which way the fences run: directions that fit the grid, and the exact maps to and from them.
#include <algorithm>
#include <cmath>

#include "tetrahedralize_solid.h"

namespace tetra {
namespace {

constexpr std::int64_t kLargestCoordinate = std::int64_t{1} << 26;  // of fence_off
constexpr int kLargestEntry = 7;

std::int64_t reach(const std::vector<Vec3i>& points) {
    std::int64_t most = 0;
    for (const Vec3i& p : points)
        for (const std::int64_t c : p) most = std::max(most, std::abs(c));
    return most;
}

FenceDirection demanded(const Vec3d& vector) {
    Vec3i direction;
    bool exact = true;
    for (std::size_t k = 0; k < 3; ++k) {
        exact = exact && std::abs(vector[k]) <= 1000 && vector[k] == std::round(vector[k]);
        direction[k] = exact ? std::llround(vector[k]) : 0;
    }
    FenceDirection frame =
        lay_on_z(exact ? direction : nearest_integer_direction(vector, kLargestEntry));
    frame.note = exact ? "asked for" : "nearest to what was asked for";
    return frame;
}

}  // namespace

std::vector<Vec3i> to_frame(const FenceDirection& frame, const std::vector<Vec3i>& points) {
    std::vector<Vec3i> result(points.size());
    for (std::size_t i = 0; i < points.size(); ++i)
        for (std::size_t r = 0; r < 3; ++r)
            result[i][r] = frame.matrix[r][0] * points[i][0] + frame.matrix[r][1] * points[i][1] +
                           frame.matrix[r][2] * points[i][2];
    return result;
}

HPoint from_frame(const FenceDirection& frame, const HPoint& point) {
    const auto row = [&](const Vec3i& m) {
        return multiply<4>(WideInt<1>(m[0]), point.x) + multiply<4>(WideInt<1>(m[1]), point.y) +
               multiply<4>(WideInt<1>(m[2]), point.z);
    };
    return {row(frame.inverse[0]), row(frame.inverse[1]), row(frame.inverse[2]), point.w};
}

std::vector<FenceDirection> choose_frames(const GridSolid& solid, const std::vector<int>& owners,
                                          const TetOptions& options, double counted_to,
                                          std::vector<DirectionTrial>& trials, Progress& progress) {
    std::vector<FenceDirection> all;
    if (options.direction) {
        all.push_back(demanded(*options.direction));
        // Only for the case that the demanded one fails.
        for (const Vec3i& axis : {Vec3i{0, 0, 1}, Vec3i{1, 0, 0}, Vec3i{0, 1, 0}})
            if (axis != all.front().direction) all.push_back(lay_on_z(axis));
    } else {
        DirectionOptions rating;
        rating.candidates = options.candidates;
        rating.largest_entry = kLargestEntry;
        rating.counted_to = counted_to;
        try {
            all = fence_directions(solid.points, solid.triangles, owners, rating, progress);
        } catch (const InvalidSolid& error) {
            std::vector<Defect> defects = error.defects;
            for (Defect& d : defects)
                for (int& t : d.triangles) t = solid.triangle_source[static_cast<std::size_t>(t)];
            throw InvalidSolid(std::move(defects));
        }
    }
    trials.clear();
    std::vector<FenceDirection> fitting;
    const std::int64_t size = reach(solid.points);
    for (FenceDirection& frame : all) {
        const bool fits = size * frame.growth <= kLargestCoordinate;
        trials.push_back({frame.name, frame.cost, fits ? frame.note : "too large for the grid"});
        if (fits && !frame.refused) fitting.push_back(std::move(frame));
    }
    if (fitting.empty()) throw VerificationFailed("no fence direction fits the grid");
    return fitting;
}

}  // namespace tetra
