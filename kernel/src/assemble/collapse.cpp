// SPDX-License-Identifier: LGPL-2.1-or-later
// Collapses along carriers, read off the skin round a point rather than stored.
#include "collapse.h"

#include <algorithm>

namespace tetra {
namespace {

std::size_t at(int i) { return static_cast<std::size_t>(i); }

using SkinEdges = std::vector<std::array<int, 2>>;

// The classes met at one skin edge, at [first, last) of the sorted list.
bool smooth(const SkinEdges& skin, std::size_t first, std::size_t last) {
    if (last - first == 2) return skin[first][1] == skin[first + 1][1];
    // Both sides of a face that two solids share.
    return last - first == 4 && skin[first][1] == skin[first + 1][1] &&
           skin[first + 2][1] == skin[first + 3][1];
}

bool same_classes(const SkinEdges& skin, const std::array<std::size_t, 2>& a,
                  const std::array<std::size_t, 2>& b) {
    if (a[1] - a[0] != b[1] - b[0]) return false;
    for (std::size_t k = 0; k < a[1] - a[0]; ++k)
        if (skin[a[0] + k][1] != skin[b[0] + k][1]) return false;
    return true;
}

void all_neighbours(const TetComplex& mesh, int p, CollapseScratch& s) {
    for (int t : s.star)
        for (int v : mesh.tet(t))
            if (v != p) s.targets.push_back({v, 0});
    std::sort(s.targets.begin(), s.targets.end(),
              [](const Target& a, const Target& b) { return a.point < b.point; });
    const auto last =
        std::unique(s.targets.begin(), s.targets.end(),
                    [](const Target& a, const Target& b) { return a.point == b.point; });
    s.targets.erase(last, s.targets.end());
}

void skin_neighbours(const TetComplex& mesh, CollapseScratch& s) {
    std::array<std::array<std::size_t, 2>, 2> sharp;
    std::size_t sharp_count = 0;
    bool one_plane = true;
    const int plane = mesh.facet_class(s.skin[0][1]).plane;
    // Next to a peel the skin is not exactly flat on the grid: no collapse is safe.
    for (const auto& edge : s.skin)
        if (mesh.facet_class(edge[1]).plane < 0) return;
    for (std::size_t i = 0; i < s.skin.size();) {
        std::size_t j = i;
        for (; j < s.skin.size() && s.skin[j][0] == s.skin[i][0]; ++j)
            one_plane = one_plane && mesh.facet_class(s.skin[j][1]).plane == plane;
        if (!smooth(s.skin, i, j)) {
            if (sharp_count == 2) {  // more edges meet, or two solids divide theirs differently
                s.targets.clear();
                return;
            }
            sharp[sharp_count++] = {i, j};
        }
        s.targets.push_back({s.skin[i][0], 0});
        i = j;
    }
    if (sharp_count == 0 && one_plane) return;
    s.targets.clear();
    // Two sharp edges between the same facets: p lies inside a straight edge.
    if (sharp_count == 2 && same_classes(s.skin, sharp[0], sharp[1]))
        s.targets = {{s.skin[sharp[0][0]][0], 0}, {s.skin[sharp[1][0]][0], 0}};
}

}  // namespace

void find_targets(TetComplex& mesh, int p, CollapseScratch& s) {
    s.targets.clear();
    s.skin.clear();
    s.star = mesh.star_of(p);
    if (!mesh.steiner(p) || s.star.empty()) return;
    for (int t : s.star) {
        const Tet& v = mesh.tet(t);
        for (int i = 0; i < 4; ++i) {
            const int code = mesh.neighbour(t, i);
            if (code >= 0 || v[at(i)] == p) continue;
            for (int k : kFace[i])
                if (v[at(k)] != p) s.skin.push_back({v[at(k)], ~code});
        }
    }
    std::sort(s.skin.begin(), s.skin.end());
    if (s.skin.empty())
        all_neighbours(mesh, p, s);
    else
        skin_neighbours(mesh, s);
    for (Target& target : s.targets)
        for (int t : s.star) target.killed += TetComplex::contains(mesh.tet(t), target.point);
    std::stable_sort(s.targets.begin(), s.targets.end(),
                     [](const Target& a, const Target& b) { return a.killed > b.killed; });
}

bool may_collapse(const TetComplex& mesh, const std::vector<int>& star, int p, int q) {
    for (int t : star) {
        const Tet& v = mesh.tet(t);
        const int j = TetComplex::corner(v, q);
        if (j < 0) {
            if (!mesh.positive_with(v, p, q)) return false;
        } else if (mesh.neighbour(t, j) < 0 && mesh.neighbour(t, TetComplex::corner(v, p)) < 0) {
            return false;
        }
    }
    return true;
}

bool try_collapse(TetComplex& mesh, int p, CollapseScratch& s) {
    find_targets(mesh, p, s);
    for (const Target& target : s.targets) {
        if (!may_collapse(mesh, s.star, p, target.point)) continue;
        s.touched.clear();
        for (int t : s.star)
            for (int v : mesh.tet(t)) s.touched.push_back(v);
        mesh.collapse(p, target.point);
        return true;
    }
    return false;
}

}  // namespace tetra
