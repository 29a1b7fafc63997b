// SPDX-License-Identifier: LGPL-2.1-or-later
// One tetrahedron after the other, in the order of their ids.
#include "sweeps.h"

#include "flip_walk.h"

namespace tetra {
namespace {

void touch(Sweep& s, const Flip& flip) {
    if (!s.dirty) return;
    for (const Tet& v : flip.added())
        for (int p : v) (*s.dirty)[static_cast<std::size_t>(p)] = 1;
}

// Do the tetrahedra beside t at edge (i, j) end in one corner? Those of a ring of three do.
bool closes_at_three(const TetComplex& mesh, int t, int i, int j) {
    const int one = mesh.neighbour(t, kRest[i][j][0]), two = mesh.neighbour(t, kRest[i][j][1]);
    if (one < 0 || two < 0) return false;
    const auto corner = [&](int code) {
        return mesh.tet(code / 4)[static_cast<std::size_t>(code % 4)];
    };
    return corner(one) == corner(two);
}

bool reduce_at(Sweep& s, int t) {
    for (const auto& e : kTetEdges) {
        if (!closes_at_three(s.mesh, t, e[0], e[1])) continue;
        Ring ring;
        if (!find_ring(s.mesh, t, e[0], e[1], 3, ring) || ring.open || ring.size != 3) continue;
        Flip flip;
        if (!propose_edge_flip(
                s.mesh, ring, [](const Tet&) { return 0.0; }, flip))
            continue;
        s.mesh.apply(flip);
        ++s.reducing;
        touch(s, flip);
        return true;
    }
    return false;
}

bool neutral_ring(const Ring& ring) {
    return ring.open ? ring.size == 2 && ring.first_class == ring.last_class : ring.size == 4;
}

void neutral_at(Sweep& s, int t) {
    const int first = s.rng.below(6);
    for (int k = 0; k < 6; ++k) {
        const auto& e = kTetEdges[(first + k) % 6];
        Ring ring;
        if (!find_ring(s.mesh, t, e[0], e[1], 4, ring) || !neutral_ring(ring)) continue;
        Flip flip;
        const auto coin = [&](const Tet&) { return static_cast<double>(s.rng.next() >> 60); };
        if (!propose_edge_flip(s.mesh, ring, coin, flip)) continue;
        if (ring.open && !may_open_flip(s.mesh, ring)) continue;
        const std::size_t mark = s.mesh.mark();
        const int fresh = s.mesh.id_count();
        s.mesh.apply(flip);
        bool reduced = false;
        for (int n = fresh; n < s.mesh.id_count(); ++n)
            if (s.mesh.alive(n)) reduced = reduce_at(s, n) || reduced;
        if (!reduced && (s.rng.next() & 1)) {
            s.mesh.undo_to(mark);
            continue;
        }
        touch(s, flip);
        return;
    }
}

}  // namespace

void reduce_all(Sweep& s) {
    for (int t = 0; t < s.mesh.id_count(); ++t) {
        s.progress.poll("compact", 0.7);
        if (s.mesh.alive(t)) reduce_at(s, t);
    }
    s.mesh.forget();
}

void neutral_sweep(Sweep& s) {
    const int end = s.mesh.id_count();
    for (int t = 0; t < end; ++t) {
        s.progress.poll("compact", 0.8);
        if (s.mesh.alive(t)) neutral_at(s, t);
    }
    s.mesh.forget();
}

}  // namespace tetra
