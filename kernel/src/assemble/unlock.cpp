// SPDX-License-Identifier: LGPL-2.1-or-later
// A walk that counts blockers as killed minus added ones, never afresh.
#include "unlock.h"

#include <algorithm>

#include "flips.h"

namespace tetra {
namespace {

std::size_t at(int i) { return static_cast<std::size_t>(i); }

class Walk {
public:
    Walk(TetComplex& mesh, int p, int q, const WalkOptions& options, Rng& rng)
        : mesh_(mesh), p_(p), q_(q), options_(options), rng_(rng) {}

    // `bad`: the tetrahedra of p's star that are not positive with p at q.
    bool run(std::vector<int> bad, std::vector<int>& touched) {
        bad_ = std::move(bad);
        int sideways = options_.sideways;
        while (!bad_.empty()) {
            have_sideways_ = false;
            sideways_seen_ = 0;
            const int first = rng_.below(static_cast<int>(bad_.size()));
            bool fell = false;
            for (int k = 0; k < static_cast<int>(bad_.size()) && k < 6 && !fell; ++k)
                fell = improve_at(bad_[at((first + k) % static_cast<int>(bad_.size()))]);
            if (!fell) {
                if (!have_sideways_ || sideways-- == 0) return false;
                commit(sideways_);
            }
        }
        touched.insert(touched.end(), touched_.begin(), touched_.end());
        return true;
    }

private:
    bool is_bad(const Tet& t) const {
        return TetComplex::contains(t, p_) && !TetComplex::contains(t, q_) &&
               !mesh_.positive_with(t, p_, q_);
    }

    // Tries the flips of all faces and edges of t; takes the first that lowers the count.
    bool improve_at(int t) {
        static constexpr int kEdges[6][2] = {{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 3}, {2, 3}};
        static constexpr int kSteps[4] = {1, 3, 7, 9};
        int op = rng_.below(10);
        const int step = kSteps[rng_.below(4)];
        for (int k = 0; k < 10; ++k, op = (op + step) % 10) {
            Flip flip;
            if (op < 4) {
                if (!propose_face_flip(mesh_, t, op, flip)) continue;
                for (const Tet& v : flip.added()) flip.cost += is_bad(v);
            } else if (!propose_ring(t, kEdges[op - 4][0], kEdges[op - 4][1], flip)) {
                continue;
            }
            int before = 0;
            for (int killed : flip.killed())
                before += std::find(bad_.begin(), bad_.end(), killed) != bad_.end();
            const int delta = static_cast<int>(flip.cost) - before;
            if (delta < 0) {
                commit(flip);
                return true;
            }
            if (delta == 0 && rng_.below(++sideways_seen_) == 0) {
                sideways_ = flip;
                have_sideways_ = true;
            }
        }
        return false;
    }

    bool propose_ring(int t, int i, int j, Flip& flip) {
        const Tet& v = mesh_.tet(t);
        if ((v[at(i)] == p_ && v[at(j)] == q_) || (v[at(i)] == q_ && v[at(j)] == p_)) return false;
        Ring ring;
        if (!find_ring(mesh_, t, i, j, options_.max_ring, ring)) return false;
        if (ring.open && (ring.first_class != ring.last_class || ring.size < 2)) return false;
        const auto cost = [&](const Tet& tet) { return is_bad(tet) ? 1.0 : 0.0; };
        if (!propose_edge_flip(mesh_, ring, cost, flip)) return false;
        return !ring.open || may_open_flip(mesh_, ring);
    }

    void commit(const Flip& flip) {
        std::erase_if(bad_, [&](int t) {
            return std::find(flip.kills.begin(), flip.kills.begin() + flip.kill_count, t) !=
                   flip.kills.begin() + flip.kill_count;
        });
        mesh_.apply(flip);
        int id = mesh_.id_count() - flip.add_count;
        for (const Tet& v : flip.added()) {
            if (is_bad(v)) bad_.push_back(id);
            ++id;
            touched_.insert(touched_.end(), v.begin(), v.end());
        }
    }

    TetComplex& mesh_;
    int p_, q_;
    WalkOptions options_;
    Rng& rng_;
    std::vector<int> bad_, touched_;
    Flip sideways_;
    bool have_sideways_ = false;
    int sideways_seen_ = 0;
};

}  // namespace

bool unlock_collapse(TetComplex& mesh, int p, const WalkOptions& options, Rng& rng,
                     CollapseScratch& s) {
    find_targets(mesh, p, s);
    struct Candidate {
        int point;
        std::vector<int> bad;
    };
    std::vector<Candidate> candidates;
    for (const Target& target : s.targets) {
        Candidate c{target.point, {}};
        for (int t : s.star) {
            const Tet& v = mesh.tet(t);
            if (TetComplex::contains(v, target.point)) continue;
            if (!mesh.positive_with(v, p, target.point)) c.bad.push_back(t);
            if (static_cast<int>(c.bad.size()) > options.max_bad) break;
        }
        if (static_cast<int>(c.bad.size()) <= options.max_bad) candidates.push_back(std::move(c));
    }
    std::stable_sort(candidates.begin(), candidates.end(), [](const auto& a, const auto& b) {
        return a.bad.size() < b.bad.size();
    });
    if (static_cast<int>(candidates.size()) > options.targets)
        candidates.resize(at(options.targets));
    s.touched.clear();
    for (Candidate& c : candidates) {
        const std::size_t mark = mesh.mark();
        if (Walk(mesh, p, c.point, options, rng).run(std::move(c.bad), s.touched)) {
            s.star = mesh.star_of(p);
            if (may_collapse(mesh, s.star, p, c.point)) {
                for (int t : s.star)
                    s.touched.insert(s.touched.end(), mesh.tet(t).begin(), mesh.tet(t).end());
                mesh.forget();
                mesh.collapse(p, c.point);
                return true;
            }
            s.touched.clear();
        }
        mesh.undo_to(mark);
    }
    return false;
}

}  // namespace tetra
