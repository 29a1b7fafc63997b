// SPDX-License-Identifier: LGPL-2.1-or-later
// The view of a plane for the polygon layer, and fans of convex polygons.
#include "plane_regions.h"

#include <algorithm>
#include <cmath>

#include "tetra/errors.h"
#include "tetra/polygon/triangulate.h"

namespace tetra::cells {
namespace {

std::pair<int, int> undirected(const DirectedEdge& e) {
    return {std::min(e.from, e.to), std::max(e.from, e.to)};
}

bool fan(const std::vector<int>& loop, const PlaneView& view, std::vector<PlanarTriangle>& out) {
    const std::size_t n = loop.size();
    const auto at = [&](std::size_t i) { return loop[i % n]; };
    int best = -1;
    for (std::size_t i = 0; i < n; ++i) {
        if (best >= 0 && at(i) > loop[best]) continue;
        if (view.orient(at(i), at(i + 1), at(i + 2)) > 0 &&
            view.orient(at(i + n - 2), at(i + n - 1), at(i)) > 0 &&
            view.orient(at(i + n - 1), at(i), at(i + 1)) > 0)
            best = static_cast<int>(i);
    }
    if (best < 0) return false;
    const auto first = static_cast<std::size_t>(best);
    for (std::size_t i = 1; i + 1 < n; ++i)
        out.push_back({at(first), at(first + i), at(first + i + 1)});
    return true;
}

}  // namespace

PlaneView::PlaneView(const PointTable& points, int key) : points_(points) {
    const std::array<double, 4>& n = points.unit_plane(notch::plane_of(key));
    for (int k = 1; k < 3; ++k)
        if (std::fabs(n[k]) > std::fabs(n[axis_])) axis_ = k;
    flip_ = n[axis_] * notch::key_sign(key) < 0 ? -1 : 1;
}

int PlaneView::compare(PointId i, PointId j) const {
    const int first = points_.compare(i, j, (axis_ + 1) % 3);
    return first != 0 ? flip_ * first : points_.compare(i, j, (axis_ + 2) % 3);
}

int PlaneView::orient(PointId i, PointId j, PointId k) const {
    return flip_ * points_.orient(i, j, k, axis_);
}

Edges without_opposites(Edges edges) {
    std::sort(edges.begin(), edges.end(), [](const DirectedEdge& a, const DirectedEdge& b) {
        return undirected(a) < undirected(b);
    });
    Edges left;
    for (std::size_t i = 0, j = 0; i < edges.size(); i = j) {
        const auto edge = undirected(edges[i]);
        int net = 0;
        for (; j < edges.size() && undirected(edges[j]) == edge; ++j)
            net += edges[j].from == edge.first ? 1 : -1;
        if (net > 0) left.push_back({edge.first, edge.second});
        if (net < 0) left.push_back({edge.second, edge.first});
    }
    return left;
}

std::vector<PlanarTriangle> triangles_of_region(const Edges& edges, const PlaneView& view,
                                                const std::vector<PointId>& inner) {
    try {
        return triangulate_region(edges, view, inner);
    } catch (const InvalidRegion& e) {
        throw VerificationFailed(std::string("an overlay in a plane bounds no region: ") +
                                 e.what());
    }
}

std::vector<PlanarTriangle> triangles_of_convex(const Edges& loop, const PlaneView& view) {
    std::vector<int> corners;
    for (const DirectedEdge& e : loop) corners.push_back(e.from);
    std::vector<PlanarTriangle> triangles;
    if (!fan(corners, view, triangles)) triangles = triangles_of_region(loop, view, {});
    return triangles;
}

}  // namespace tetra::cells
