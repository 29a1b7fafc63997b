// SPDX-License-Identifier: LGPL-2.1-or-later
// Shells, their exact volumes, and their nesting into solids with cavities.
#pragma once

#include <span>
#include <vector>

#include "tetra/exact/wide_int.h"
#include "tetra/solid/box_tree.h"
#include "tetra/solid/sheets.h"

namespace tetra {

struct Shells {
    std::vector<int> of;              // per triangle; numbered by first triangle
    std::vector<int> first_triangle;  // per shell
    std::vector<Int256> volume;       // per shell, six times, positive when outward
};

// Connected components across twins. Exact for |coordinates| <= 2^40. O(n).
Shells find_shells(std::span<const Vec3i> points, std::span<const Triangle> triangles,
                   std::span<const int> twin);

struct Nesting {
    std::vector<int> parent;  // per shell: the smallest shell of its solid around it, or -1
    std::vector<int> depth;   // per shell: 0 outermost, 1 cavity, 2 a part in a cavity ...
};

// Which shell of a solid lies in which, by a vertical ray from inside each shell, with exact
// predicates and a symbolic shift of the ray. Shells must not cross; contacts are fine. No shell
// of volume 0. O(n log n) plus the triangles that the rays meet.
Nesting nest_shells(const GridSolid& surface, const Shells& shells, const BoxTree& tree);

// Pairs (shell, shell of another solid that lies around it) where solid material of the first is
// also material of the second's solid. Shells must face outward and not cross.
std::vector<std::array<int, 2>> find_overlapping_solids(const GridSolid& surface,
                                                        const Shells& shells, const BoxTree& tree);

}  // namespace tetra
