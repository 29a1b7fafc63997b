// SPDX-License-Identifier: LGPL-2.1-or-later
// Compaction: removes Steiner points and tetrahedra without moving the skin (COMPACT.md A).
#pragma once

#include <cstdint>
#include <span>

#include "tetra/progress.h"
#include "tetra/solid/exact_mesh.h"

namespace tetra {

// none: leave the mesh alone. standard: collapses, flips, one unlocking walk per stuck point.
// max: rounds of walks and flips until a round moves nothing.
enum class CompactLevel { none, standard, max };

struct CompactOptions {
    CompactLevel level = CompactLevel::standard;
    std::uint64_t seed = 1;
    int rounds = 24;     // of level max, at most
    double seconds = 0;  // stop level max after so long; 0 = never. A limit costs determinism.
};

struct SteinerCount {
    int edge = 0, facet = 0, inner = 0;
    int total() const { return edge + facet + inner; }
};

struct CompactStats {
    int tets_before = 0, tets_after = 0;
    SteinerCount steiner_before, steiner_after;
    int collapses = 0;       // without help
    int unlocked = 0;        // after flips
    int reducing_flips = 0;  // 3-2
    int rounds = 0;
    double seconds = 0;
};

// Edits `mesh` in place: Steiner points slide along what carries them onto a neighbour, flips take
// out tetrahedra. Every new tetrahedron is positive on the exact grid points and on their doubles,
// so the skin of each facet class stays what it was as a point set.
//
// `faces`: the B-rep face of each triangle of `solid`, or empty. Triangles of one plane and one
// face form a facet; skin edges between facets stay.
// Throws VerificationFailed when tetrahedra don't pair or the skin is incomplete; Cancelled.
CompactStats compact(ExactMesh& mesh, const GridSolid& solid, std::span<const int> faces,
                     const CompactOptions& options, Progress& progress);

// Steiner points of a mesh by carrier.
SteinerCount count_steiner(const ExactMesh& mesh);

}  // namespace tetra
