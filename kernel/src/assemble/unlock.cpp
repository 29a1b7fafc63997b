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

}  // namespace

bool unlock_collapse(TetComplex& mesh, int p, const WalkOptions& options, Rng& rng,
                     CollapseScratch& s) {
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
        FlipWalk walk(mesh, {options.sideways, options.max_ring, 6, options.wander}, rng, is_bad, may_remove);
        if (walk.run(std::move(c.bad), s.touched)) {
            s.star = mesh.star_of(p);
            if (may_collapse(mesh, s.star, p, q)) {
                for (int t : s.star)
                    s.touched.insert(s.touched.end(), mesh.tet(t).begin(), mesh.tet(t).end());
                mesh.forget();
                mesh.collapse(p, q);
                return true;
            }
            s.touched.clear();
        }
        mesh.undo_to(mark);
    }
    return false;
}

}  // namespace tetra
