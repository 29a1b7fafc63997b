// SPDX-License-Identifier: LGPL-2.1-or-later
// Points that come in late, and cones over cavities.
#include <algorithm>
#include <cassert>
#include <map>

#include "tet_complex.h"

namespace tetra {
namespace {

constexpr std::int64_t kParts = 1 << 16;  // of a grid step, to which an inner point is rounded

std::size_t at(int i) { return static_cast<std::size_t>(i); }

}  // namespace

int TetComplex::add_inner_point(const Vec3d& grid, const Vec3d& place) {
    std::array<std::int64_t, 3> parts;
    Vec3d rounded;
    for (std::size_t k = 0; k < 3; ++k) {
        parts[k] = std::llround(grid[k] * static_cast<double>(kParts));
        rounded[k] = static_cast<double>(parts[k]) / static_cast<double>(kParts);
    }
    exact_.push_back({Int256(parts[0]), Int256(parts[1]), Int256(parts[2]), Int256(kParts)});
    carriers_.emplace_back();
    integer_.emplace_back();
    is_integer_.push_back(0);
    grid_.push_back(rounded);
    place_.push_back(place);
    stars_.emplace_back();
    return point_count() - 1;
}

void TetComplex::drop_last_point() {
    assert(stars_.back().empty());
    exact_.pop_back();
    carriers_.pop_back();
    integer_.pop_back();
    is_integer_.pop_back();
    grid_.pop_back();
    place_.pop_back();
    stars_.pop_back();
}

void TetComplex::cone_over(const std::vector<int>& cavity, int apex) {
    assert(log_.empty());
    for (const int t : cavity) {
        alive_[at(t)] = 0;
        --live_;
    }
    std::map<std::array<int, 2>, int> open;  // two corners besides the apex, a face with them
    for (const int t : cavity)
        for (int face = 0; face < 4; ++face) {
            const int code = neighbour(t, face);
            if (code >= 0 && std::find(cavity.begin(), cavity.end(), code / 4) != cavity.end())
                continue;
            Tet cone = tets_[at(t)];
            cone[at(face)] = apex;
            const int fresh = add(cone, solid_[at(t)]);
            neighbours_[at(fresh)][at(face)] = code;
            if (code >= 0) set_neighbour(code, 4 * fresh + face);
            for (const int away : kFace[face]) {
                std::array<int, 2> rest{-1, -1};
                std::size_t n = 0;
                for (const int k : kFace[face])
                    if (k != away) rest[n++] = cone[at(k)];
                std::sort(rest.begin(), rest.end());
                const int side = 4 * fresh + away;
                const auto [other, first] = open.try_emplace(rest, side);
                if (first) continue;
                set_neighbour(side, other->second);
                set_neighbour(other->second, side);
                open.erase(other);
            }
        }
    assert(open.empty());
}

}  // namespace tetra
