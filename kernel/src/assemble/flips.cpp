// SPDX-License-Identifier: LGPL-2.1-or-later
// Walks round edges and the proposal of 2-3 flips.
#include "flips.h"

namespace tetra {
namespace {

std::size_t at(int i) { return static_cast<std::size_t>(i); }

// From tetrahedron t across its face opposite corner `away`; the corner that is new there.
int far_corner(const TetComplex& mesh, int code) { return mesh.tet(code / 4)[at(code % 4)]; }

}  // namespace

bool find_ring(const TetComplex& mesh, int t, int i, int j, int max_size, Ring& ring) {
    const Tet& v = mesh.tet(t);
    ring.a = v[at(i)];
    ring.b = v[at(j)];
    ring.open = false;
    ring.size = 1;
    ring.tets[0] = t;
    int back = kRest[i][j][1];  // the face to leave by backward is opposite the second rim point
    ring.rim[0] = v[at(kRest[i][j][0])];
    ring.rim[1] = v[at(kRest[i][j][1])];
    int here = t, leave = kRest[i][j][0], front = ring.rim[1];
    for (;;) {
        const int code = mesh.neighbour(here, leave);
        if (code < 0) {
            ring.open = true;
            ring.last_class = ~code;
            break;
        }
        if (code / 4 == t) return true;
        if (ring.size == max_size) return false;
        here = code / 4;
        const int next = far_corner(mesh, code);
        leave = TetComplex::corner(mesh.tet(here), front);
        front = next;
        ring.tets[at(ring.size++)] = here;
        // Only a closed ring comes back to rim[0]; it then ends without a new rim point.
        if (ring.size < Ring::kMax + 1) ring.rim[at(ring.size)] = next;
    }
    // Open: prepend what lies behind t.
    here = t;
    front = ring.rim[0];
    leave = back;
    for (;;) {
        const int code = mesh.neighbour(here, leave);
        if (code < 0) {
            ring.first_class = ~code;
            return true;
        }
        if (ring.size == max_size) return false;
        here = code / 4;
        const int next = far_corner(mesh, code);
        leave = TetComplex::corner(mesh.tet(here), front);
        front = next;
        for (int k = ring.size; k > 0; --k) ring.tets[at(k)] = ring.tets[at(k - 1)];
        for (int k = ring.size + 1; k > 0; --k) ring.rim[at(k)] = ring.rim[at(k - 1)];
        ring.tets[0] = here;
        ring.rim[0] = next;
        ++ring.size;
    }
}

bool may_open_flip(TetComplex& mesh, const Ring& ring) {
    if (ring.first_class != ring.last_class) return false;
    int skins = 0;
    for (int t : mesh.star_of(ring.a)) {
        const Tet& v = mesh.tet(t);
        if (!TetComplex::contains(v, ring.b)) continue;
        for (int i = 0; i < 4; ++i)
            skins += v[at(i)] != ring.a && v[at(i)] != ring.b && mesh.neighbour(t, i) < 0;
    }
    return skins == 2;
}

bool propose_face_flip(const TetComplex& mesh, int t, int face, Flip& flip) {
    const int code = mesh.neighbour(t, face);
    if (code < 0) return false;
    const Tet& v = mesh.tet(t);
    const int d = v[at(face)], e = far_corner(mesh, code);
    const int x = v[at(kFace[face][0])], y = v[at(kFace[face][1])], z = v[at(kFace[face][2])];
    flip.clear();
    flip.kills[0] = t;
    flip.kills[1] = code / 4;
    flip.kill_count = 2;
    flip.adds[0] = {d, e, x, y};
    flip.adds[1] = {d, e, y, z};
    flip.adds[2] = {d, e, z, x};
    flip.add_count = 3;
    return mesh.positive(flip.adds[0]) && mesh.positive(flip.adds[1]) &&
           mesh.positive(flip.adds[2]);
}

}  // namespace tetra
