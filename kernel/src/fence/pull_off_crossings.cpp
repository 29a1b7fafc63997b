// SPDX-License-Identifier: LGPL-2.1-or-later
// A uniform grid in the xy plane with exact crossing tests.
#include "pull_off_crossings.h"

#include <algorithm>
#include <cmath>

#include "tetra/exact/predicates.h"
#include "tetra/fence/pull_off.h"

namespace tetra {
namespace {

// In cell units; far above the rounding of cell coordinates.
constexpr double kSlack = 1e-6;

std::uint64_t key_of(const VertexPair& e) {
    return static_cast<std::uint64_t>(e[0]) << 32 | static_cast<std::uint32_t>(e[1]);
}

int clamp_cell(double v, int count) {
    return std::clamp(static_cast<int>(std::floor(v)), 0, count - 1);
}

}  // namespace

VertexPair vertex_pair(int a, int b) { return a < b ? VertexPair{a, b} : VertexPair{b, a}; }

ProjectedEdges::ProjectedEdges(const std::vector<Vec3i>& points, std::size_t expected)
    : points_(points) {
    Vec3i lo{}, hi{};
    if (!points.empty()) lo = hi = points.front();
    for (const Vec3i& p : points)
        for (std::size_t k = 0; k < 2; ++k) {
            lo[k] = std::min(lo[k], p[k]);
            hi[k] = std::max(hi[k], p[k]);
        }
    const double width = static_cast<double>(hi[0] - lo[0]) + 1;
    const double height = static_cast<double>(hi[1] - lo[1]) + 1;
    const double cell = std::sqrt(width * height / static_cast<double>(expected + 1));
    scale_ = 1 / std::max({cell, width / 4096, height / 4096});
    columns_ = static_cast<int>(width * scale_) + 1;
    rows_ = static_cast<int>(height * scale_) + 1;
    origin_[0] = static_cast<double>(lo[0]);
    origin_[1] = static_cast<double>(lo[1]);
    cells_.resize(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_));
}

template <class Visit>
void ProjectedEdges::visit_cells(const VertexPair& edge, const Visit& visit) const {
    double x[2], y[2];
    for (int k = 0; k < 2; ++k) {
        const Vec3i& p = point(edge[static_cast<std::size_t>(k)]);
        x[k] = (static_cast<double>(p[0]) - origin_[0]) * scale_;
        y[k] = (static_cast<double>(p[1]) - origin_[1]) * scale_;
    }
    if (y[1] < y[0]) {
        std::swap(x[0], x[1]);
        std::swap(y[0], y[1]);
    }
    const int last_row = clamp_cell(y[1] + kSlack, rows_);
    for (int row = clamp_cell(y[0] - kSlack, rows_); row <= last_row; ++row) {
        double from = x[0], to = x[1];
        if (y[1] - y[0] > 0.01) {
            const double slope = (x[1] - x[0]) / (y[1] - y[0]);
            from = x[0] + slope * (std::max(y[0], row - kSlack) - y[0]);
            to = x[0] + slope * (std::min(y[1], row + 1 + kSlack) - y[0]);
        }
        if (to < from) std::swap(from, to);
        const int last = clamp_cell(to + kSlack, columns_);
        for (int column = clamp_cell(from - kSlack, columns_); column <= last; ++column)
            visit(static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) +
                  static_cast<std::size_t>(column));
    }
}

void ProjectedEdges::insert(const VertexPair& edge) {
    int id = static_cast<int>(stored_.size());
    if (free_.empty()) {
        stored_.push_back({edge, 0});
    } else {
        id = free_.back();
        free_.pop_back();
        stored_[static_cast<std::size_t>(id)] = {edge, 0};
    }
    ids_[key_of(edge)] = id;
    visit_cells(edge, [&](std::size_t cell) { cells_[cell].push_back(id); });
}

void ProjectedEdges::erase(const VertexPair& edge) {
    const auto place = ids_.find(key_of(edge));
    if (place == ids_.end()) return;
    const int id = place->second;
    visit_cells(edge, [&](std::size_t cell) {
        auto& list = cells_[cell];
        *std::find(list.begin(), list.end(), id) = list.back();
        list.pop_back();
    });
    ids_.erase(place);
    free_.push_back(id);
}

std::int64_t ProjectedEdges::crossings(const VertexPair& edge) {
    if (++stamp_ == 0) {
        for (Stored& s : stored_) s.stamp = 0;
        stamp_ = 1;
    }
    std::int64_t count = 0;
    visit_cells(edge, [&](std::size_t cell) {
        for (const int id : cells_[cell]) {
            Stored& other = stored_[static_cast<std::size_t>(id)];
            if (other.stamp == stamp_) continue;
            other.stamp = stamp_;
            if (cross(edge, other.ends)) ++count;
        }
    });
    return count;
}

bool ProjectedEdges::cross(const VertexPair& e, const VertexPair& f) const {
    const Vec3i &a = point(e[0]), &b = point(e[1]), &c = point(f[0]), &d = point(f[1]);
    return orient2d(a, b, c) * orient2d(a, b, d) < 0 && orient2d(c, d, a) * orient2d(c, d, b) < 0;
}

std::vector<VertexPair> sharp_edges(const PullSurface& surface) {
    std::vector<VertexPair> edges;
    for (std::size_t i = 0; i < surface.triangles.size(); ++i) {
        if (!surface.alive[i]) continue;
        const Triangle& t = surface.triangles[i];
        for (std::size_t k = 0; k < 3; ++k) edges.push_back(vertex_pair(t[k], t[(k + 1) % 3]));
    }
    std::sort(edges.begin(), edges.end());
    edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
    std::erase_if(edges, [&](const VertexPair& e) { return !surface.is_sharp(e[0], e[1]); });
    return edges;
}

bool is_vertical(const PullSurface& surface, const VertexPair& edge) {
    const Vec3i &a = surface.point(edge[0]), &b = surface.point(edge[1]);
    return a[0] == b[0] && a[1] == b[1];
}

std::int64_t projected_crossings(const std::vector<Vec3i>& points,
                                 const std::vector<Triangle>& triangles,
                                 const std::vector<int>& owners, Progress& progress) {
    const PullSurface surface(points, triangles, owners);
    const std::vector<VertexPair> edges = sharp_edges(surface);
    ProjectedEdges seen(points, edges.size());
    std::int64_t count = 0;
    for (std::size_t i = 0; i < edges.size(); ++i) {
        if (is_vertical(surface, edges[i])) continue;
        if (i % 16 == 0)
            progress.poll("crossings", static_cast<double>(i) / static_cast<double>(edges.size()));
        count += seen.crossings(edges[i]);
        seen.insert(edges[i]);
    }
    return count;
}

}  // namespace tetra
