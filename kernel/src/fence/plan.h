// SPDX-License-Identifier: LGPL-2.1-or-later
// The solid seen from above: facets, sharp edges, and the lines of the plan that carry them.
#pragma once

#include <span>
#include <vector>

#include "surface.h"
#include "tetra/fence/fence_off.h"

namespace tetra::fence {

// Rule R1: an edge-connected set of coplanar, equally oriented triangles of one owner.
struct Facet {
    int triangle = -1;  // the first of them
    int side = 0;       // +1 = ceiling (outward normal upwards), -1 = floor, 0 = vertical
    Plane plane;        // primitive, outward
};

// An edge that is no inner edge of a facet. A vertical one has line -1.
struct SharpEdge {
    int u = -1, v = -1;  // input points; along its line, or upwards
    int line = -1;
};

// Rule R2: dx y - dy x = c with gcd(dx, dy) = 1. Directed so that the coordinate `axis`, in which
// it is steeper, grows; points with a positive side are left of it.
struct Line {
    std::int64_t dx = 0, dy = 0, c = 0;
    int axis = 0;
    std::int64_t side(const Vec3i& p) const { return dx * p[1] - dy * p[0] - c; }
};

// Lists of ints in one array: list i is items[offset[i]] .. items[offset[i+1]-1].
struct Lists {
    std::vector<int> offset{0}, items;
    std::span<const int> operator[](int i) const {
        const auto k = static_cast<std::size_t>(i);
        return {items.data() + offset[k], static_cast<std::size_t>(offset[k + 1] - offset[k])};
    }
};

// Groups 0..n-1 by key[i] in 0..groups-1, each group ascending; a negative key is left out.
Lists group_by(const std::vector<int>& key, int groups);

struct Plan {
    const FenceInput* input = nullptr;
    PlanPoints points;
    std::vector<int> point_of;  // per input point: its plan point, -1 when unused
    std::vector<int> facet_of;  // per triangle
    std::vector<Facet> facets;
    std::vector<SharpEdge> edges;
    Lists edge_facets;  // per edge: adjacent facets, one entry per triangle
    std::vector<Line> lines;
    Lists line_edges;  // by their start along the line
    Lists facet_triangles;
    Lists line_facets;                  // per line: vertical facets in it
    std::vector<int> flat_points;       // kept input points on no sharp edge
    std::vector<int> flat_point_facet;  // the facet each lies in
    std::vector<Surface> surfaces;      // of facets (vertical ones unset), then edges

    int facet_count() const { return static_cast<int>(facets.size()); }
    int edge_surface_id(int edge) const { return facet_count() + edge; }
    bool kept(int point) const {
        return input->keep.empty() || input->keep[static_cast<std::size_t>(point)];
    }
    const Vec3i& at(int point) const { return input->points[static_cast<std::size_t>(point)]; }
};

// \throw std::out_of_range when a coordinate exceeds 2^26.
Plan make_plan(const FenceInput& input);

template <class Vector>
decltype(auto) at(Vector& v, int i) {
    return v[static_cast<std::size_t>(i)];
}

}  // namespace tetra::fence
