// SPDX-License-Identifier: LGPL-2.1-or-later
// The steps of validation, from the caller's arrays to oriented and nested shells.
#include "tetra/solid/validate.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <string>

#include "tetra/solid/edges.h"

namespace tetra {
namespace {

constexpr int most_listed = 100;  // defects of a kind, and ids in one defect of the raw arrays

// Defects that leave no surface to look at.
std::vector<Defect> find_array_defects(const std::vector<Vec3d>& vertices,
                                       const std::vector<Triangle>& triangles,
                                       const std::vector<int>& solid) {
    std::vector<Defect> defects;
    if (triangles.empty())
        return {{"empty", {}, {}, "there are no triangles; check that the file holds a surface"}};
    Defect index{"bad_index", {}, {}, ""}, nonfinite{"nonfinite_coordinate", {}, {}, ""};
    for (std::size_t v = 0;
         v < vertices.size() && nonfinite.vertices.size() < std::size_t{most_listed}; ++v)
        for (const double x : vertices[v])
            if (!std::isfinite(x)) {
                nonfinite.vertices.push_back(static_cast<int>(v));
                break;
            }
    const auto bad = [&](int v) { return v < 0 || static_cast<std::size_t>(v) >= vertices.size(); };
    for (std::size_t t = 0;
         t < triangles.size() && index.triangles.size() < std::size_t{most_listed}; ++t)
        if (std::any_of(triangles[t].begin(), triangles[t].end(), bad))
            index.triangles.push_back(static_cast<int>(t));
    if (!solid.empty() && solid.size() != triangles.size())
        defects.push_back({"bad_index", {}, {}, "there must be one solid id per triangle"});
    if (!index.triangles.empty()) {
        index.message = "triangle " + std::to_string(index.triangles.front()) +
                        " names a vertex that does not exist";
        defects.push_back(std::move(index));
    }
    if (!nonfinite.vertices.empty()) {
        nonfinite.message = "vertex " + std::to_string(nonfinite.vertices.front()) +
                            " has a coordinate that is NaN or infinite";
        defects.push_back(std::move(nonfinite));
    }
    return defects;
}

int source_triangle(const GridSolid& s, int t) {
    return s.triangle_source[static_cast<std::size_t>(t)];
}

std::vector<int> source_vertices(const GridSolid& s, std::initializer_list<int> triangles) {
    std::vector<int> ids;
    for (const int t : triangles)
        for (const int v : s.triangles[static_cast<std::size_t>(t)])
            ids.push_back(s.point_source[static_cast<std::size_t>(v)]);
    std::sort(ids.begin(), ids.end());
    ids.erase(std::unique(ids.begin(), ids.end()), ids.end());
    return ids;
}

std::vector<Defect> crossing_defects(const GridSolid& s, const Crossings& crossings) {
    std::vector<Defect> defects;
    for (const auto& [a, b, flat] : crossings.pairs) {
        const int first = std::min(source_triangle(s, a), source_triangle(s, b));
        const int second = std::max(source_triangle(s, a), source_triangle(s, b));
        defects.push_back({"self_crossing",
                           source_vertices(s, {a, b}),
                           {first, second},
                           "triangles " + std::to_string(first) + " and " + std::to_string(second) +
                               (flat ? " overlap in a plane or leave a wall of no thickness"
                                     : " pass through each other") +
                               "; separate or unite the parts"});
    }
    return defects;
}

std::vector<int> triangles_of_shell(const GridSolid& s, const Shells& shells, int shell) {
    std::vector<int> ids;
    for (std::size_t t = 0; t < shells.of.size(); ++t)
        if (shells.of[t] == shell) ids.push_back(source_triangle(s, static_cast<int>(t)));
    std::sort(ids.begin(), ids.end());
    ids.erase(std::unique(ids.begin(), ids.end()), ids.end());
    return ids;
}

std::vector<Defect> flat_shell_defects(const GridSolid& s, const Shells& shells) {
    std::vector<Defect> defects;
    for (std::size_t i = 0; i < shells.volume.size(); ++i)
        if (shells.volume[i].is_zero())
            defects.push_back({"flat_solid",
                               {},
                               triangles_of_shell(s, shells, static_cast<int>(i)),
                               "a closed part of the surface has no volume; remove it"});
    return defects;
}

std::vector<Defect> overlap_defects(const GridSolid& s, const Shells& shells, const BoxTree& tree) {
    std::vector<Defect> defects;
    for (const auto& [x, y] : find_overlapping_solids(s, shells, tree)) {
        const int a = source_triangle(s, shells.first_triangle[static_cast<std::size_t>(x)]);
        const int b = source_triangle(s, shells.first_triangle[static_cast<std::size_t>(y)]);
        defects.push_back({"bad_nesting",
                           {},
                           {a, b},
                           "the solid of triangle " + std::to_string(a) +
                               " lies within the solid of triangle " + std::to_string(b) +
                               "; unite or subtract them"});
    }
    return defects;
}

// Keeps the first `limit` defects of each kind; the last one kept tells how many follow.
std::vector<Defect> first_of_each_kind(std::vector<Defect> defects, int limit) {
    std::map<std::string, int> count, seen;
    for (const Defect& d : defects) ++count[d.kind];
    std::vector<Defect> kept;
    for (Defect& d : defects) {
        const int n = ++seen[d.kind];
        if (n > limit) continue;
        if (n == limit && count[d.kind] > limit)
            d.message += " (and " + std::to_string(count[d.kind] - limit) + " more like this)";
        kept.push_back(std::move(d));
    }
    return kept;
}

void turn(Triangle& t) { std::swap(t[1], t[2]); }

// A closed surface without flat triangles on the grid, with all that is derived from it.
struct Oriented {
    GridSolid surface;
    Sheets sheets;
    Shells shells;
    Nesting nesting;
    std::vector<char> turned;  // per triangle
};

void derive(Oriented& o) {
    o.sheets = pair_half_edges(o.surface.points, o.surface.triangles, o.surface.solid);
    o.shells = find_shells(o.surface.points, o.surface.triangles, o.sheets.twin);
}

bool has_flat_shell(const Shells& shells) {
    return std::any_of(shells.volume.begin(), shells.volume.end(),
                       [](const Int256& v) { return v.is_zero(); });
}

// Turns shells by their depth. Turning may join shells at type 2 edges in another way, hence the
// rounds; crossing shells may never come to rest, and are reported afterwards.
void orient_shells(Oriented& o, const BoxTree& tree) {
    constexpr int rounds = 4;
    o.turned.assign(o.surface.triangles.size(), 0);
    derive(o);
    for (int round = 0; round < rounds && !has_flat_shell(o.shells); ++round) {
        o.nesting = nest_shells(o.surface, o.shells, tree);
        bool any = false;
        for (std::size_t t = 0; t < o.surface.triangles.size(); ++t) {
            const auto shell = static_cast<std::size_t>(o.shells.of[t]);
            if (o.shells.volume[shell].negative() == (o.nesting.depth[shell] % 2 == 1)) continue;
            turn(o.surface.triangles[t]);
            o.turned[t] ^= 1;
            any = true;
        }
        if (!any) return;
        derive(o);
    }
}

// Solid of each shell: numbered by outer shells in order.
std::vector<int> solids_of_shells(const Nesting& nesting, int& count) {
    std::vector<int> solid(nesting.depth.size(), -1);
    count = 0;
    for (std::size_t i = 0; i < solid.size(); ++i)
        if (nesting.depth[i] % 2 == 0) solid[i] = count++;
    for (std::size_t i = 0; i < solid.size(); ++i)
        if (solid[i] < 0) solid[i] = solid[static_cast<std::size_t>(nesting.parent[i])];
    return solid;
}

void fill(Validation& v, const Oriented& o, const Crossings& crossings, const SnapReport& report) {
    const GridSolid& s = o.surface;
    v.counts = measure(s, o.sheets, o.shells, crossings);
    const std::vector<int> solid = solids_of_shells(o.nesting, v.counts.solids);
    v.counts.merged_points = report.merged_points;
    v.counts.dropped_triangles = report.dropped_triangles;
    v.counts.flipped_edges = report.flipped_edges;
    for (std::size_t t = 0; t < s.triangles.size(); ++t) {
        Triangle corners = s.triangles[t];
        for (int& p : corners) p = s.point_source[static_cast<std::size_t>(p)];
        v.triangles.push_back(corners);
        v.solid.push_back(solid[static_cast<std::size_t>(o.shells.of[t])]);
        if (o.turned[t]) v.turned.push_back(o.shells.of[t]);
    }
    v.triangle_source = s.triangle_source;
    v.shell = o.shells.of;
    std::sort(v.turned.begin(), v.turned.end());
    v.turned.erase(std::unique(v.turned.begin(), v.turned.end()), v.turned.end());
}

}  // namespace

Validation validate(const std::vector<Vec3d>& vertices, const std::vector<Triangle>& triangles,
                    const std::vector<int>& solid, const ValidateOptions& options,
                    Progress& progress) {
    Validation v;
    v.defects = find_array_defects(vertices, triangles, solid);
    if (!v.defects.empty()) return v;
    SnapReport report;
    GridSolid merged = merge_on_grid({vertices, triangles, {}, solid}, options.bits, &report);
    progress.poll("validate", 0);
    v.defects = find_duplicate_triangles(merged);
    std::vector<Defect> boundary = find_boundary_defects(merged);
    v.defects.insert(v.defects.end(), boundary.begin(), boundary.end());
    v.defects = first_of_each_kind(std::move(v.defects), most_listed);
    if (!v.defects.empty()) return v;
    Oriented o;
    o.surface = repair_flat_triangles(std::move(merged), &report);
    progress.poll("validate", 0);
    if (o.surface.triangles.empty()) {
        v.defects.push_back({"flat_solid", {}, {}, "the surface encloses no volume"});
        return v;
    }
    const BoxTree tree = build_box_tree(o.surface.points, o.surface.triangles);
    progress.poll("validate", 0);
    orient_shells(o, tree);
    progress.poll("validate", 0);
    v.defects = flat_shell_defects(o.surface, o.shells);
    const Crossings crossings =
        find_crossings(o.surface, o.sheets, tree, options.max_crossings, progress);
    std::vector<Defect> crossing = crossing_defects(o.surface, crossings);
    v.defects.insert(v.defects.end(), crossing.begin(), crossing.end());
    if (v.defects.empty() && !solid.empty()) v.defects = overlap_defects(o.surface, o.shells, tree);
    v.defects = first_of_each_kind(std::move(v.defects), most_listed);
    if (v.defects.empty()) fill(v, o, crossings, report);
    return v;
}

std::vector<Defect> find_defects(const GridSolid& surface, Progress& progress,
                                 std::size_t max_crossings) {
    std::vector<Defect> defects = find_boundary_defects(surface);
    if (!defects.empty()) return defects;
    const Sheets sheets = pair_half_edges(surface.points, surface.triangles, surface.solid);
    const Shells shells = find_shells(surface.points, surface.triangles, sheets.twin);
    const BoxTree tree = build_box_tree(surface.points, surface.triangles);
    defects = flat_shell_defects(surface, shells);
    for (Defect& d :
         crossing_defects(surface, find_crossings(surface, sheets, tree, max_crossings, progress)))
        defects.push_back(std::move(d));
    return defects;
}

}  // namespace tetra
