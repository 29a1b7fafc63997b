// SPDX-License-Identifier: LGPL-2.1-or-later
// A uniform grid in the xy plane with exact crossing tests.
#include "pull_off_crossings.h"

#include <algorithm>
#include <cmath>

#include "tetra/fence/pull_off.h"

namespace tetra {
namespace {

// In cell units; far above the rounding of cell coordinates.
constexpr double kSlack = 1e-6;

std::size_t index(int i) { return static_cast<std::size_t>(i); }

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
    cells_.assign(index(columns_) * index(rows_), -1);
    by_vertex_.assign(points.size(), -1);
    stored_.reserve(expected);
    entries_.reserve(4 * expected);
}

template <class Visit>
void ProjectedEdges::visit_cells(const Place& from, const Place& to, const Visit& visit) const {
    double x[2] = {(static_cast<double>(from.x) - origin_[0]) * scale_,
                   (static_cast<double>(to.x) - origin_[0]) * scale_};
    double y[2] = {(static_cast<double>(from.y) - origin_[1]) * scale_,
                   (static_cast<double>(to.y) - origin_[1]) * scale_};
    if (y[1] < y[0]) {
        std::swap(x[0], x[1]);
        std::swap(y[0], y[1]);
    }
    const int last_row = clamp_cell(y[1] + kSlack, rows_);
    for (int row = clamp_cell(y[0] - kSlack, rows_); row <= last_row; ++row) {
        double low = x[0], high = x[1];
        if (y[1] - y[0] > 0.01) {
            const double slope = (x[1] - x[0]) / (y[1] - y[0]);
            low = x[0] + slope * (std::max(y[0], row - kSlack) - y[0]);
            high = x[0] + slope * (std::min(y[1], row + 1 + kSlack) - y[0]);
        }
        if (high < low) std::swap(low, high);
        const int last = clamp_cell(high + kSlack, columns_);
        for (int column = clamp_cell(low - kSlack, columns_); column <= last; ++column)
            visit(index(row) * index(columns_) + index(column));
    }
}

void ProjectedEdges::insert(const VertexPair& edge) {
    int id = free_edge_;
    if (id < 0) {
        id = static_cast<int>(stored_.size());
        stored_.emplace_back();
    } else {
        free_edge_ = stored_[index(id)].next;
    }
    int& first = by_vertex_[index(edge[0])];
    Stored& fresh = stored_[index(id)] = {
        place(edge[0]), place(edge[1]), {place(edge[0]), place(edge[1])}, edge, 0, first};
    first = id;
    visit_cells(fresh.from, fresh.to, [&](std::size_t cell) {
        int at = free_entry_;
        if (at < 0) {
            at = static_cast<int>(entries_.size());
            entries_.emplace_back();
        } else {
            free_entry_ = entries_[index(at)].next;
        }
        entries_[index(at)] = {id, cells_[cell]};
        cells_[cell] = at;
    });
}

void ProjectedEdges::erase(const VertexPair& edge) {
    int* link = &by_vertex_[index(edge[0])];
    while (*link >= 0 && stored_[index(*link)].ends != edge) link = &stored_[index(*link)].next;
    const int id = *link;
    if (id < 0) return;
    Stored& gone = stored_[index(id)];
    *link = gone.next;
    gone.next = free_edge_;
    free_edge_ = id;
    visit_cells(gone.from, gone.to, [&](std::size_t cell) {
        int* entry = &cells_[cell];
        while (entries_[index(*entry)].edge != id) entry = &entries_[index(*entry)].next;
        const int at = *entry;
        *entry = entries_[index(at)].next;
        entries_[index(at)].next = free_entry_;
        free_entry_ = at;
    });
}

std::int64_t ProjectedEdges::crossings(const VertexPair& edge) {
    if (++stamp_ == 0) {
        for (Stored& s : stored_) s.stamp = 0;
        stamp_ = 1;
    }
    const Place a = place(edge[0]), b = place(edge[1]);
    const PlanLine line(a, b);
    std::int64_t count = 0;
    visit_cells(a, b, [&](std::size_t cell) {
        for (int at = cells_[cell]; at >= 0; at = entries_[index(at)].next) {
            Stored& other = stored_[index(entries_[index(at)].edge)];
            if (other.stamp == stamp_) continue;
            other.stamp = stamp_;
            count += line.parts(other.from, other.to) && other.line.parts(a, b);
        }
    });
    return count;
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
                                 const std::vector<int>& owners, Progress& progress, int sampled) {
    const PullSurface surface(points, triangles, owners);
    std::vector<VertexPair> edges = sharp_edges(surface);
    std::erase_if(edges, [&](const VertexPair& e) { return is_vertical(surface, e); });
    ProjectedEdges seen(points, edges.size());
    for (const VertexPair& e : edges) seen.insert(e);
    const std::size_t stride = edges.size() / index(std::max(1, sampled)) + 1;
    std::int64_t ends = 0, asked = 0;
    for (std::size_t i = 0; i < edges.size(); i += stride, ++asked) {
        if (i % 16 == 0)
            progress.poll("crossings", static_cast<double>(i) / static_cast<double>(edges.size()));
        ends += seen.crossings(edges[i]);
    }
    if (stride == 1) return ends / 2;
    return std::llround(0.5 * static_cast<double>(ends) * static_cast<double>(edges.size()) /
                        static_cast<double>(asked));
}

}  // namespace tetra
