// SPDX-License-Identifier: LGPL-2.1-or-later
// Crown and dome of one vertex (PULLOFF P1 to P4), computed without touching the surface.
#pragma once

#include <vector>

#include "pull_off_surface.h"
#include "pull_off_tree.h"
#include "tetra/fence/pull_off.h"

namespace tetra {

// Cuts vertex w off the fan: triangle (u, w, x) stays on the surface, (v, u, x) joins the fan.
struct CrownFlip {
    int u, w, x, owner;
};

// kind is favourable as long as nothing speaks against it. owner[i] belongs to (v, ring[i],
// ring[i+1]).
struct Crown {
    PulledKind kind = PulledKind::favourable;
    std::vector<int> ring;
    std::vector<int> owner;
    std::vector<CrownFlip> flips;
};

struct LinkEdge {
    int from, to, owner;
};

// Kept from call to call to spare allocations.
struct LinkBuffers {
    std::vector<LinkEdge> edges, cycle;
};

// The crown after the flips of P2; its ring starts at the smallest id.
Crown crown_of(const PullSurface& surface, int v, LinkBuffers& link);

// ring.size() - 2 triangles of ring positions, outward for the remainder; empty if there is none.
std::vector<Triangle> dome_of(const PullSurface& surface, int v, const std::vector<int>& ring);

// What hinders the removal: a live vertex in the closed cup, or an edge inside a dome face.
struct Hindrance {
    PulledKind kind = PulledKind::favourable;
    int first = -1, second = -1;
};

Hindrance hindrance_of(const PullSurface& surface, const PointTree& tree, int v,
                       const std::vector<int>& ring, const std::vector<Triangle>& dome);

}  // namespace tetra
