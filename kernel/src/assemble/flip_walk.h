// SPDX-License-Identifier: LGPL-2.1-or-later
// A walk of flips that lowers the number of blocking tetrahedra, counted as killed minus added.
#pragma once

#include <algorithm>

#include "flips.h"

namespace tetra {

inline constexpr int kTetEdges[6][2] = {{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 3}, {2, 3}};

struct FlipWalkLimits {
    int sideways = 4;  // flips that leave the count as it is
    int max_ring = 6;
    int width = 6;   // blockers looked at before going sideways
    int wander = 0;  // flips near the blockers to draw for a sideways one; 0 = only at them
};

// IsBad(tet): does the tetrahedron block? May_remove(a, b): may the edge a-b go?
// Every flip applied is positive as TetComplex::positive() has it; the log allows to undo all.
template <class IsBad, class MayRemove>
class FlipWalk {
  public:
    FlipWalk(TetComplex& mesh, const FlipWalkLimits& limits, Rng& rng, const IsBad& is_bad,
             const MayRemove& may_remove)
        : mesh_(mesh), limits_(limits), rng_(rng), is_bad_(is_bad), may_remove_(may_remove) {}

    // `bad`: the ids of all blockers. True when none is left; `touched` then gets the points of
    // all added tetrahedra.
    bool run(std::vector<int> bad, std::vector<int>& touched) {
        bad_ = std::move(bad);
        int sideways = limits_.sideways;
        while (!bad_.empty()) {
            if (lower()) continue;
            if (sideways-- == 0) return false;
            const bool near = limits_.wander > 0 && (sideways_seen_ == 0 || (rng_.next() & 1));
            if (near && wander()) continue;
            if (sideways_seen_ == 0) return false;
            commit(sideways_);
        }
        touched.insert(touched.end(), touched_.begin(), touched_.end());
        return true;
    }

    int flips() const { return flips_; }

  private:
    bool lower() {
        sideways_seen_ = 0;
        const int n = static_cast<int>(bad_.size());
        const int first = rng_.below(n);
        for (int k = 0; k < n && k < limits_.width; ++k)
            if (lower_at(bad_[static_cast<std::size_t>((first + k) % n)])) return true;
        return false;
    }

    // Tries the flips of all faces and edges of t in some order; takes the first that lowers the
    // count, remembers one of those that keep it.
    bool lower_at(int t) {
        static constexpr int kSteps[4] = {1, 3, 7, 9};
        int op = rng_.below(10);
        const int step = kSteps[rng_.below(4)];
        for (int k = 0; k < 10; ++k, op = (op + step) % 10) {
            Flip flip;
            if (!propose(t, op, flip)) continue;
            const int delta = rise(flip);
            if (delta < 0) {
                commit(flip);
                return true;
            }
            if (delta == 0 && rng_.below(++sideways_seen_) == 0) sideways_ = flip;
        }
        return false;
    }

    // A random flip near a blocker that does not raise the count.
    bool wander() {
        for (int k = 0; k < limits_.wander; ++k) {
            const int bad =
                bad_[static_cast<std::size_t>(rng_.below(static_cast<int>(bad_.size())))];
            const int t = nearby(bad);
            Flip flip;
            if (!propose(t, rng_.below(10), flip) || rise(flip) > 0) continue;
            commit(flip);
            return true;
        }
        return false;
    }

    // A neighbour of a tetrahedron, or one that shares a corner with it.
    int nearby(int bad) {
        if (rng_.next() & 1) {
            const int code = mesh_.neighbour(bad, rng_.below(4));
            if (code >= 0) return code / 4;
        }
        const int corner = mesh_.tet(bad)[static_cast<std::size_t>(rng_.below(4))];
        const std::vector<int>& star = mesh_.star_of(corner);
        return star[static_cast<std::size_t>(rng_.below(static_cast<int>(star.size())))];
    }

    bool propose(int t, int op, Flip& flip) {
        return op < 4 ? propose_face(t, op, flip)
                      : propose_ring(t, kTetEdges[op - 4][0], kTetEdges[op - 4][1], flip);
    }

    // How many blockers more there would be.
    int rise(const Flip& flip) const {
        int before = 0;
        for (int killed : flip.killed())
            before += std::find(bad_.begin(), bad_.end(), killed) != bad_.end();
        return static_cast<int>(flip.cost) - before;
    }

    bool propose_face(int t, int face, Flip& flip) {
        if (!propose_face_flip(mesh_, t, face, flip)) return false;
        for (const Tet& v : flip.added()) flip.cost += is_bad_(v);
        return true;
    }

    bool propose_ring(int t, int i, int j, Flip& flip) {
        const Tet& v = mesh_.tet(t);
        if (!may_remove_(v[static_cast<std::size_t>(i)], v[static_cast<std::size_t>(j)]))
            return false;
        Ring ring;
        if (!find_ring(mesh_, t, i, j, limits_.max_ring, ring)) return false;
        if (ring.open && (ring.first_class != ring.last_class || ring.size < 2)) return false;
        const auto cost = [&](const Tet& tet) { return is_bad_(tet) ? 1.0 : 0.0; };
        if (!propose_edge_flip(mesh_, ring, cost, flip)) return false;
        return !ring.open || may_open_flip(mesh_, ring);
    }

    void commit(const Flip& flip) {
        const auto killed = flip.killed();
        std::erase_if(bad_, [&](int t) {
            return std::find(killed.begin(), killed.end(), t) != killed.end();
        });
        mesh_.apply(flip);
        ++flips_;
        int id = mesh_.id_count() - flip.add_count;
        for (const Tet& v : flip.added()) {
            if (is_bad_(v)) bad_.push_back(id);
            ++id;
            touched_.insert(touched_.end(), v.begin(), v.end());
        }
    }

    TetComplex& mesh_;
    FlipWalkLimits limits_;
    Rng& rng_;
    const IsBad& is_bad_;
    const MayRemove& may_remove_;
    std::vector<int> bad_, touched_;
    Flip sideways_;
    int sideways_seen_ = 0;
    int flips_ = 0;
};

}  // namespace tetra
