// SPDX-License-Identifier: LGPL-2.1-or-later
// Counting facets, notches, fans and handles.
#include "tetra/solid/measure.h"

#include <algorithm>
#include <numeric>

#include "groups.h"
#include "tetra/exact/predicates.h"
#include "tetra/solid/edges.h"

namespace tetra {
namespace {

const Vec3i& point(const GridSolid& s, int v) { return s.points[static_cast<std::size_t>(v)]; }

// Sign of the twin's apex over the plane of the half-edge's triangle: +1 when the edge is reflex.
int bend(const GridSolid& s, const Sheets& sheets, int h) {
    const Triangle& t = s.triangles[static_cast<std::size_t>(h / 3)];
    const int apex = apex_of(s.triangles, sheets.twin[static_cast<std::size_t>(h)]);
    if (apex == t[0] || apex == t[1] || apex == t[2]) return 0;
    return orient3d(point(s, t[0]), point(s, t[1]), point(s, t[2]), point(s, apex));
}

int count_notches(const GridSolid& s, const Sheets& sheets, const std::vector<int>& facets,
                  const std::vector<char>& reflex) {
    // Each reflex edge enters at both ends; edges of the same two facets are collinear, and those
    // that share an end are one notch.
    struct End {
        int low, high, vertex, edge;
    };
    std::vector<End> ends;
    int count = 0;
    for (int h = 0; h < static_cast<int>(reflex.size()); ++h) {
        const int twin = sheets.twin[static_cast<std::size_t>(h)];
        if (!reflex[static_cast<std::size_t>(h)] || twin < h) continue;
        const int f = facets[static_cast<std::size_t>(h / 3)];
        const int g = facets[static_cast<std::size_t>(twin / 3)];
        for (const int v : {tail_of(s.triangles, h), head_of(s.triangles, h)})
            ends.push_back({std::min(f, g), std::max(f, g), v, count});
        ++count;
    }
    std::sort(ends.begin(), ends.end(), [](const End& a, const End& b) {
        if (a.low != b.low) return a.low < b.low;
        if (a.high != b.high) return a.high < b.high;
        return a.vertex != b.vertex ? a.vertex < b.vertex : a.edge < b.edge;
    });
    Groups groups(static_cast<std::size_t>(count));
    for (std::size_t i = 1; i < ends.size(); ++i)
        if (ends[i].low == ends[i - 1].low && ends[i].high == ends[i - 1].high &&
            ends[i].vertex == ends[i - 1].vertex)
            groups.join(ends[i].edge, ends[i - 1].edge);
    return groups.count();
}

// Corner 3 t + i belongs to vertex triangles[t][i]; corners of one fan are joined.
Groups join_fans(const Sheets& sheets) {
    Groups fans(sheets.twin.size());
    for (int h = 0; h < static_cast<int>(sheets.twin.size()); ++h) {
        const int twin = sheets.twin[static_cast<std::size_t>(h)];
        fans.join(h, next_half_edge(twin));  // both at the tail of h
    }
    return fans;
}

// Vertices of one solid where the triangles fall apart when only shared edges hold them together.
int count_type3(const GridSolid& s, Groups fans) {
    const EdgeTable table = build_edges(s.triangles, s.solid);
    for (std::size_t e = 0; e < table.edges.size(); ++e) {
        const std::span<const int> h = table.of(e);
        if (h.size() == 2) continue;
        for (const int end : {table.edges[e].low, table.edges[e].high}) {
            const auto corner = [&](int g) {
                return tail_of(s.triangles, g) == end ? g : next_half_edge(g);
            };
            for (const int g : h) fans.join(corner(h[0]), corner(g));
        }
    }
    std::vector<std::array<int, 3>> at;  // solid, vertex, fan
    for (int h = 0; h < static_cast<int>(3 * s.triangles.size()); ++h)
        if (fans.root(h) == h)
            at.push_back({s.solid[static_cast<std::size_t>(h / 3)], tail_of(s.triangles, h), h});
    std::sort(at.begin(), at.end());
    int count = 0;
    for (std::size_t i = 0; i + 1 < at.size(); ++i) {
        const auto same = [&](std::size_t j) {
            return at[j][0] == at[i][0] && at[j][1] == at[i][1];
        };
        if (same(i + 1) && !(i > 0 && same(i - 1))) ++count;
    }
    return count;
}

}  // namespace

std::vector<int> find_facets(const GridSolid& surface, const Sheets& sheets) {
    Groups groups(surface.triangles.size());
    for (int h = 0; h < static_cast<int>(sheets.twin.size()); ++h) {
        const int twin = sheets.twin[static_cast<std::size_t>(h)];
        if (twin < h || bend(surface, sheets, h) != 0) continue;
        const Vec3i &u = point(surface, tail_of(surface.triangles, h)),
                    &v = point(surface, head_of(surface.triangles, h)),
                    &a = point(surface, apex_of(surface.triangles, h)),
                    &b = point(surface, apex_of(surface.triangles, twin));
        if (compare_around(u, v, a, a, b) != 0) groups.join(h / 3, twin / 3);
    }
    return groups.numbers();
}

Counts measure(const GridSolid& surface, const Sheets& sheets, const Shells& shells,
               const Crossings& crossings) {
    Counts counts;
    counts.vertices = static_cast<int>(surface.points.size());
    counts.triangles = static_cast<int>(surface.triangles.size());
    counts.shells = static_cast<int>(shells.volume.size());
    const std::vector<int> facets = find_facets(surface, sheets);
    counts.facets = facets.empty() ? 0 : 1 + *std::max_element(facets.begin(), facets.end());
    std::vector<char> reflex(sheets.twin.size());
    for (int h = 0; h < static_cast<int>(reflex.size()); ++h)
        reflex[static_cast<std::size_t>(h)] = bend(surface, sheets, h) > 0 ? 1 : 0;
    counts.notches = count_notches(surface, sheets, facets, reflex);
    Groups fans = join_fans(sheets);
    counts.euler = fans.count() - static_cast<int>(sheets.twin.size() / 2) + counts.triangles;
    counts.genus = counts.shells - counts.euler / 2;
    counts.type1_contacts = static_cast<int>(crossings.touching_points.size());
    counts.type2_edges = sheets.type2_edges;
    counts.type3_vertices = count_type3(surface, std::move(fans));
    counts.facet_contacts = crossings.facet_contacts;
    return counts;
}

}  // namespace tetra
