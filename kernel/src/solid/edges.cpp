// SPDX-License-Identifier: LGPL-2.1-or-later
// Edge table of a surface; open edges, inconsistent orientation, duplicate triangles.
#include "tetra/solid/edges.h"

#include <algorithm>
#include <numeric>
#include <string>

#include "groups.h"
#include "tetra/exact/predicates.h"

namespace tetra {
namespace {

struct Incidence {
    int solid, low, high, half_edge;
    bool same_edge(const Incidence& o) const {
        return solid == o.solid && low == o.low && high == o.high;
    }
    friend bool operator<(const Incidence& a, const Incidence& b) {
        if (a.solid != b.solid) return a.solid < b.solid;
        if (a.low != b.low) return a.low < b.low;
        if (a.high != b.high) return a.high < b.high;
        return a.half_edge < b.half_edge;
    }
};

// Buckets by solid and lower vertex hold a handful each; only within them is there much to sort.
std::vector<Incidence> sorted_incidences(std::span<const Triangle> triangles,
                                         std::span<const int> solid) {
    int points = 0, solids = 1;
    for (const Triangle& t : triangles) points = std::max({points, t[0] + 1, t[1] + 1, t[2] + 1});
    bool dense = true;
    for (const int s : solid) {
        solids = std::max(solids, s + 1);
        dense = dense && s >= 0;
    }
    std::vector<Incidence> all(3 * triangles.size());
    const auto visit_all = [&](auto visit) {
        for (std::size_t t = 0; t < triangles.size(); ++t)
            for (int i = 0; i < 3; ++i) {
                const int h = static_cast<int>(3 * t) + i;
                const auto [low, high] =
                    std::minmax({tail_of(triangles, h), head_of(triangles, h)});
                visit(Incidence{solid.empty() ? 0 : solid[t], low, high, h});
            }
    };
    const std::size_t buckets = static_cast<std::size_t>(solids) * static_cast<std::size_t>(points);
    if (!dense || buckets > 8 * all.size() + 64) {  // most buckets would be empty
        visit_all([&, i = std::size_t{0}](const Incidence& x) mutable { all[i++] = x; });
        std::sort(all.begin(), all.end());
        return all;
    }
    const auto bucket = [&](const Incidence& x) {
        return static_cast<std::size_t>(x.solid) * static_cast<std::size_t>(points) +
               static_cast<std::size_t>(x.low);
    };
    std::vector<int> next(buckets + 1, 0);
    visit_all([&](const Incidence& x) { ++next[bucket(x) + 1]; });
    std::partial_sum(next.begin(), next.end(), next.begin());
    visit_all([&](const Incidence& x) { all[static_cast<std::size_t>(next[bucket(x)]++)] = x; });
    for (auto first = all.begin(); first != all.end();) {
        const auto last = all.begin() + next[bucket(*first)];
        std::sort(first, last);
        first = last;
    }
    return all;
}

int forward_minus_backward(std::span<const Triangle> triangles, std::span<const int> half_edges,
                           int low) {
    int sum = 0;
    for (const int h : half_edges) sum += tail_of(triangles, h) == low ? 1 : -1;
    return sum;
}

void sort_unique(std::vector<int>& ids) {
    std::sort(ids.begin(), ids.end());
    ids.erase(std::unique(ids.begin(), ids.end()), ids.end());
}

class BoundaryDefects {
  public:
    explicit BoundaryDefects(const GridSolid& s)
        : s_(s), table_(build_edges(s.triangles, s.solid)) {}

    std::vector<Defect> run() {
        for (std::size_t e = 0; e < table_.edges.size(); ++e) {
            const std::span<const int> h = table_.of(e);
            if (h.size() % 2 == 1)
                open_.push_back(e);
            else if (forward_minus_backward(s_.triangles, h, table_.edges[e].low) != 0)
                twisted_.push_back(e);
        }
        report_open();
        if (!twisted_.empty()) report_twisted();
        return std::move(defects_);
    }

  private:
    int source_vertex(int v) const { return s_.point_source[static_cast<std::size_t>(v)]; }
    int source_triangle(int t) const { return s_.triangle_source[static_cast<std::size_t>(t)]; }

    void report_open() {
        Groups groups(s_.points.size());
        for (const std::size_t e : open_) groups.join(table_.edges[e].low, table_.edges[e].high);
        std::vector<std::pair<int, std::size_t>> by_group;
        for (const std::size_t e : open_)
            by_group.emplace_back(groups.root(table_.edges[e].low), e);
        std::sort(by_group.begin(), by_group.end());
        for (std::size_t i = 0; i < by_group.size();) {
            Defect d{"open_edge", {}, {}, ""};
            std::size_t count = 0;
            const int group = by_group[i].first;
            for (; i < by_group.size() && by_group[i].first == group; ++i, ++count) {
                const EdgeTable::Edge& edge = table_.edges[by_group[i].second];
                d.vertices.push_back(source_vertex(edge.low));
                d.vertices.push_back(source_vertex(edge.high));
                for (const int h : table_.of(by_group[i].second))
                    d.triangles.push_back(source_triangle(h / 3));
            }
            sort_unique(d.vertices);
            sort_unique(d.triangles);
            d.message = "the surface is not closed: " + std::to_string(count) +
                        " edge(s) with an odd number of triangles near vertex " +
                        std::to_string(d.vertices.front()) +
                        "; fill the hole or remove the extra triangles";
            defects_.push_back(std::move(d));
        }
    }

    // Spreads an orientation over edges with two triangles; turn_[t] says that t disagrees with
    // the lowest triangle of its part.
    void spread() {
        const std::size_t n = s_.triangles.size();
        std::vector<int> edge_of(3 * n);
        for (std::size_t e = 0; e < table_.edges.size(); ++e)
            for (const int h : table_.of(e))
                edge_of[static_cast<std::size_t>(h)] = static_cast<int>(e);
        part_.assign(n, -1);
        turn_.assign(n, 0);
        std::vector<int> stack;
        for (std::size_t start = 0; start < n; ++start) {
            if (part_[start] >= 0) continue;
            const int part = static_cast<int>(contradictory_.size());
            contradictory_.push_back(false);
            part_[start] = part;
            stack.push_back(static_cast<int>(start));
            while (!stack.empty()) {
                const int t = stack.back();
                stack.pop_back();
                for (int h = 3 * t; h < 3 * t + 3; ++h) {
                    const auto e = static_cast<std::size_t>(edge_of[static_cast<std::size_t>(h)]);
                    visit_neighbours(t, e, part, stack);
                }
            }
        }
    }

    void visit_neighbours(int t, std::size_t e, int part, std::vector<int>& stack) {
        const std::span<const int> h = table_.of(e);
        if (h.size() != 2) return;
        const int other = h[0] / 3 == t ? h[1] / 3 : h[0] / 3;
        const bool opposed = tail_of(s_.triangles, h[0]) == tail_of(s_.triangles, h[1]);
        const char turn =
            static_cast<char>((turn_[static_cast<std::size_t>(t)] != 0) != opposed ? 1 : 0);
        if (part_[static_cast<std::size_t>(other)] < 0) {
            part_[static_cast<std::size_t>(other)] = part;
            turn_[static_cast<std::size_t>(other)] = turn;
            stack.push_back(other);
        } else if (turn_[static_cast<std::size_t>(other)] != turn) {
            contradictory_[static_cast<std::size_t>(part)] = true;
        }
    }

    void report_twisted() {
        spread();
        std::vector<int> parts;
        for (const std::size_t e : twisted_)
            for (const int h : table_.of(e))
                parts.push_back(part_[static_cast<std::size_t>(h / 3)]);
        sort_unique(parts);
        std::vector<std::vector<int>> members(contradictory_.size());
        for (std::size_t t = 0; t < part_.size(); ++t)
            members[static_cast<std::size_t>(part_[t])].push_back(static_cast<int>(t));
        std::size_t reported = 0;
        for (const int part : parts) reported += report_part(part, members) ? 1 : 0;
        if (reported == 0) report_twisted_edges();
    }

    bool report_part(int part, const std::vector<std::vector<int>>& members) {
        const std::vector<int>& all = members[static_cast<std::size_t>(part)];
        const bool moebius = contradictory_[static_cast<std::size_t>(part)];
        std::vector<int> same, opposed;
        for (const int t : all) (turn_[static_cast<std::size_t>(t)] ? opposed : same).push_back(t);
        const std::vector<int>& wrong =
            moebius ? all : (opposed.size() <= same.size() ? opposed : same);
        if (wrong.empty()) return false;
        Defect d{moebius ? "non_orientable" : "inconsistent_orientation", {}, {}, ""};
        for (const int t : wrong) {
            d.triangles.push_back(source_triangle(t));
            for (const int v : s_.triangles[static_cast<std::size_t>(t)])
                d.vertices.push_back(source_vertex(v));
        }
        sort_unique(d.vertices);
        sort_unique(d.triangles);
        d.message = moebius
                        ? "a part of the surface has one side only, like a Möbius strip; it bounds "
                          "no solid"
                        : std::to_string(wrong.size()) + " triangle(s), first " +
                              std::to_string(d.triangles.front()) +
                              ", face the other way than their neighbours; turn them";
        defects_.push_back(std::move(d));
        return true;
    }

    // Every part is consistent in itself: the disagreement is at edges with four or more triangles.
    void report_twisted_edges() {
        for (const std::size_t e : twisted_) {
            Defect d{"inconsistent_orientation", {}, {}, ""};
            d.vertices = {source_vertex(table_.edges[e].low), source_vertex(table_.edges[e].high)};
            for (const int h : table_.of(e)) d.triangles.push_back(source_triangle(h / 3));
            sort_unique(d.triangles);
            d.message = "the triangles at edge " + std::to_string(d.vertices[0]) + "-" +
                        std::to_string(d.vertices[1]) + " do not run as often forth as back";
            defects_.push_back(std::move(d));
        }
    }

    const GridSolid& s_;
    EdgeTable table_;
    std::vector<std::size_t> open_, twisted_;
    std::vector<int> part_;
    std::vector<char> turn_;
    std::vector<bool> contradictory_;
    std::vector<Defect> defects_;
};

}  // namespace

EdgeTable build_edges(std::span<const Triangle> triangles, std::span<const int> solid) {
    const std::vector<Incidence> all = sorted_incidences(triangles, solid);
    EdgeTable table;
    table.half_edges.reserve(all.size());
    table.edges.reserve(all.size() / 2);
    table.first.reserve(all.size() / 2 + 1);
    for (std::size_t i = 0; i < all.size(); ++i) {
        if (i == 0 || !all[i].same_edge(all[i - 1])) {
            table.first.push_back(static_cast<int>(i));
            table.edges.push_back({all[i].solid, all[i].low, all[i].high});
        }
        table.half_edges.push_back(all[i].half_edge);
    }
    table.first.push_back(static_cast<int>(all.size()));
    return table;
}

bool is_closed(std::span<const Triangle> triangles, std::span<const int> solid) {
    const EdgeTable table = build_edges(triangles, solid);
    for (std::size_t e = 0; e < table.edges.size(); ++e)
        if (forward_minus_backward(triangles, table.of(e), table.edges[e].low) != 0) return false;
    return true;
}

std::vector<Defect> find_boundary_defects(const GridSolid& surface) {
    return BoundaryDefects(surface).run();
}

std::vector<Defect> find_duplicate_triangles(const GridSolid& surface) {
    struct Key {
        int solid;
        Triangle corners;
        int triangle;
    };
    std::vector<Key> keys;
    keys.reserve(surface.triangles.size());
    for (std::size_t t = 0; t < surface.triangles.size(); ++t) {
        Triangle c = surface.triangles[t];
        std::rotate(c.begin(), std::min_element(c.begin(), c.end()), c.end());
        keys.push_back({surface.solid[t], c, static_cast<int>(t)});
    }
    std::sort(keys.begin(), keys.end(), [](const Key& a, const Key& b) {
        if (a.solid != b.solid) return a.solid < b.solid;
        return a.corners != b.corners ? a.corners < b.corners : a.triangle < b.triangle;
    });
    std::vector<Defect> defects;
    for (std::size_t i = 0; i + 1 < keys.size(); ++i) {
        if (keys[i].solid != keys[i + 1].solid || keys[i].corners != keys[i + 1].corners) continue;
        const auto corner = [&](std::size_t k) -> const Vec3i& {
            return surface.points[static_cast<std::size_t>(keys[i].corners[k])];
        };
        if (collinear(corner(0), corner(1), corner(2))) continue;
        Defect d{"duplicate_triangle", {}, {}, ""};
        for (const int v : keys[i].corners)
            d.vertices.push_back(surface.point_source[static_cast<std::size_t>(v)]);
        for (const std::size_t k : {i, i + 1})
            d.triangles.push_back(
                surface.triangle_source[static_cast<std::size_t>(keys[k].triangle)]);
        d.message = "triangles " + std::to_string(d.triangles[0]) + " and " +
                    std::to_string(d.triangles[1]) + " are the same; remove one";
        defects.push_back(std::move(d));
    }
    return defects;
}

}  // namespace tetra
