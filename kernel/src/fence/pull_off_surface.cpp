// SPDX-License-Identifier: LGPL-2.1-or-later
// Adding, removing and finding triangles of the soup.
#include "pull_off_surface.h"

#include <algorithm>

#include "tetra/exact/predicates.h"

namespace tetra {
namespace {

int third_vertex(const Triangle& t, int a, int b) {
    for (const int v : t)
        if (v != a && v != b) return v;
    return -1;
}

bool contains(const Triangle& t, int v) { return t[0] == v || t[1] == v || t[2] == v; }

}  // namespace

PullSurface::PullSurface(const std::vector<Vec3i>& grid_points, const std::vector<Triangle>& input,
                         const std::vector<int>& input_owners)
    : points(grid_points), star(grid_points.size()) {
    triangles.reserve(2 * input.size());
    owners.reserve(2 * input.size());
    alive.reserve(2 * input.size());
    for (std::size_t i = 0; i < input.size(); ++i) add(input[i], input_owners[i]);
}

int PullSurface::add(const Triangle& triangle, int owner) {
    const int id = static_cast<int>(triangles.size());
    triangles.push_back(triangle);
    owners.push_back(owner);
    alive.push_back(0);
    revive(id);
    return id;
}

void PullSurface::remove(int id) {
    alive[static_cast<std::size_t>(id)] = 0;
    for (const int v : triangle(id)) {
        auto& list = star[static_cast<std::size_t>(v)];
        *std::find(list.begin(), list.end(), id) = list.back();
        list.pop_back();
    }
}

void PullSurface::revive(int id) {
    alive[static_cast<std::size_t>(id)] = 1;
    for (const int v : triangle(id)) star[static_cast<std::size_t>(v)].push_back(id);
}

bool PullSurface::has_edge(int a, int b) const {
    if (star_of(b).size() < star_of(a).size()) std::swap(a, b);
    for (const int id : star_of(a))
        if (contains(triangle(id), b)) return true;
    return false;
}

int PullSurface::find(int a, int b, int c) const {
    for (const int id : star_of(a)) {
        const Triangle& t = triangle(id);
        for (std::size_t k = 0; k < 3; ++k)
            if (t[k] == a && t[(k + 1) % 3] == b && t[(k + 2) % 3] == c) return id;
    }
    return -1;
}

bool PullSurface::is_sharp(int a, int b) const {
    if (star_of(b).size() < star_of(a).size()) std::swap(a, b);
    int found[2] = {-1, -1}, count = 0;
    for (const int id : star_of(a))
        if (contains(triangle(id), b)) {
            if (count < 2) found[count] = id;
            ++count;
        }
    if (count != 2) return count > 0;
    if (owner(found[0]) != owner(found[1])) return true;
    const Triangle& t = triangle(found[0]);
    const int across = third_vertex(triangle(found[1]), a, b);
    return orient3d(point(t[0]), point(t[1]), point(t[2]), point(across)) != 0;
}

}  // namespace tetra
