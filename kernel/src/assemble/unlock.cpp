// SPDX-License-Identifier: LGPL-2.1-or-later
// The choice of a neighbour to clear the way for, and the collapse after the walk.
#include "unlock.h"

#include <algorithm>

#include "flip_walk.h"

namespace tetra {
namespace {

struct Candidate {
    int point;
    std::vector<int> bad;
};

// Neighbours with at most max_bad blockers, fewest first.
std::vector<Candidate> candidates_of(const TetComplex& mesh, int p, const WalkOptions& options,
                                     const CollapseScratch& s) {
    std::vector<Candidate> out;
    for (const Target& target : s.targets) {
        Candidate c{target.point, {}};
        for (int t : s.star) {
            const Tet& v = mesh.tet(t);
            if (TetComplex::contains(v, target.point)) continue;
            if (!mesh.positive_with(v, p, target.point)) c.bad.push_back(t);
            if (static_cast<int>(c.bad.size()) > options.max_bad) break;
        }
        if (static_cast<int>(c.bad.size()) <= options.max_bad) out.push_back(std::move(c));
    }
    std::stable_sort(out.begin(), out.end(),
                     [](const auto& a, const auto& b) { return a.bad.size() < b.bad.size(); });
    if (static_cast<int>(out.size()) > options.targets)
        out.resize(static_cast<std::size_t>(options.targets));
    return out;
}

// Takes off an edge at p by a flip of its ring; the star of p loses a tetrahedron or two by that.
bool take_off_edge(TetComplex& mesh, int p, int t, std::vector<int>& touched) {
    const int i = TetComplex::corner(mesh.tet(t), p);
    for (int j = 0; j < 4; ++j) {
        if (j == i) continue;
        Ring ring;
        if (!find_ring(mesh, t, i, j, 6, ring) || ring.size < 2) continue;
        if (ring.open && ring.first_class != ring.last_class) continue;
        Flip flip;
        if (!propose_edge_flip(
                mesh, ring, [](const Tet&) { return 0.0; }, flip))
            continue;
        if (ring.open && !may_open_flip(mesh, ring)) continue;
        mesh.apply(flip);
        for (const Tet& v : flip.added()) touched.insert(touched.end(), v.begin(), v.end());
        return true;
    }
    return false;
}

// A point of few tetrahedra has few blockers.
void shrink_star(TetComplex& mesh, int p, int passes, std::vector<int>& touched) {
    bool any = true;
    for (int pass = 0; pass < passes && any; ++pass) {
        any = false;
        const std::vector<int> star = mesh.star_of(p);
        for (int t : star)
            if (mesh.alive(t)) any = take_off_edge(mesh, p, t, touched) || any;
    }
}

}  // namespace

bool unlock_collapse(TetComplex& mesh, int p, const WalkOptions& options, Rng& rng,
                     CollapseScratch& s) {
    const std::size_t start = mesh.mark();
    std::vector<int> shrunk;
    if (options.shrink > 0) shrink_star(mesh, p, options.shrink, shrunk);
    find_targets(mesh, p, s);
    std::vector<Candidate> candidates = candidates_of(mesh, p, options, s);
    s.touched.clear();
    for (Candidate& c : candidates) {
        const int q = c.point;
        const auto is_bad = [&](const Tet& t) {
            return TetComplex::contains(t, p) && !TetComplex::contains(t, q) &&
                   !mesh.positive_with(t, p, q);
        };
        const auto may_remove = [&](int a, int b) {
            return !((a == p && b == q) || (a == q && b == p));
        };
        const std::size_t mark = mesh.mark();
        FlipWalk walk(mesh, {options.sideways, options.max_ring, 6, options.wander}, rng, is_bad,
                      may_remove);
        if (walk.run(std::move(c.bad), s.touched)) {
            s.star = mesh.star_of(p);
            if (may_collapse(mesh, s.star, p, q)) {
                for (int t : s.star)
                    s.touched.insert(s.touched.end(), mesh.tet(t).begin(), mesh.tet(t).end());
                s.touched.insert(s.touched.end(), shrunk.begin(), shrunk.end());
                mesh.forget();
                mesh.collapse(p, q);
                return true;
            }
            s.touched.clear();
        }
        mesh.undo_to(mark);
    }
    mesh.undo_to(start);
    return false;
}

}  // namespace tetra
