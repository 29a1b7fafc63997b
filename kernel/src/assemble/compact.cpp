// SPDX-License-Identifier: LGPL-2.1-or-later
// The order of collapses, flips and walks, and how far each goes.
#include "tetra/assemble/compact.h"

#include <algorithm>
#include <chrono>

#include "collapse.h"
#include "sweeps.h"
#include "tet_complex.h"
#include "unlock.h"

namespace tetra {
namespace {

std::size_t at(int i) { return static_cast<std::size_t>(i); }

class Compactor {
  public:
    Compactor(TetComplex& mesh, const CompactOptions& options, Progress& progress)
        : mesh_(mesh),
          options_(options),
          progress_(progress),
          rng_{options.seed},
          sweep_{mesh, rng_, progress, &dirty_, 0} {
        dirty_.assign(at(mesh.point_count()), 1);
        gone_.assign(at(mesh.point_count()), 0);
        for (const CarrierKind kind : {CarrierKind::edge, CarrierKind::facet, CarrierKind::inner})
            for (int p = 0; p < mesh.point_count(); ++p)
                if (mesh.carrier(p).kind == kind) steiner_.push_back(p);
    }

    CompactStats run() {
        const auto start = std::chrono::steady_clock::now();
        collapse_all();
        reduce_all(sweep_);
        if (options_.level == CompactLevel::max) {
            run_max(start);
        } else {
            for (int round = 0; round < 2; ++round)
                if (unlock_all(WalkOptions{}) == 0) break;
            // Few points are left: longer walks for them cost little, shrinking their stars too
            // much.
            unlock_all({4, 12, 12, 7, 2, 0});
            reduce_all(sweep_);
            for (int sweep = 0; sweep < 2; ++sweep) neutral_sweep(sweep_);
        }
        reduce_all(sweep_);
        stats_.reducing_flips = sweep_.reducing;
        return stats_;
    }

  private:
    void run_max(std::chrono::steady_clock::time_point start) {
        WalkOptions walk;
        walk.targets = 6;
        walk.max_ring = 7;
        walk.max_bad = 30;
        int idle = 0;
        for (int round = 0; round < options_.rounds && idle < 3; ++round) {
            const int before = mesh_.tet_count();
            walk.sideways = round == 0 ? 4 : 25;
            walk.wander = round < 4 ? 0 : 4;
            walk.shrink = round % 2 == 1 ? 4 : 0;
            std::fill(dirty_.begin(), dirty_.end(), 1);
            const int moved = unlock_all(walk);
            reduce_all(sweep_);
            for (int sweep = 0; sweep < 4; ++sweep) neutral_sweep(sweep_);
            ++stats_.rounds;
            // Sweeps go on to find a tetrahedron here and there: less than 0.1 % counts as none.
            idle = moved == 0 && before - mesh_.tet_count() <= before / 1000 ? idle + 1 : 0;
            const std::chrono::duration<double> spent = std::chrono::steady_clock::now() - start;
            if (options_.seconds > 0 && spent.count() > options_.seconds) break;
        }
    }

    void touch(const std::vector<int>& points) {
        for (int v : points) dirty_[at(v)] = 1;
    }

    void drop_removed() {
        std::erase_if(steiner_, [&](int p) { return gone_[at(p)]; });
    }

    void collapse_all() {
        for (bool moved = true; moved;) {
            moved = false;
            for (int p : steiner_) {
                progress_.poll("compact", 0.1);
                if (!dirty_[at(p)]) continue;
                dirty_[at(p)] = 0;
                if (!try_collapse(mesh_, p, scratch_)) continue;
                touch(scratch_.touched);
                gone_[at(p)] = 1;
                ++stats_.collapses;
                moved = true;
            }
            drop_removed();
        }
    }

    // One walk for each stuck point, in random order; a collapse pass after.
    int unlock_all(const WalkOptions& walk) {
        std::vector<int> order = steiner_;
        for (int i = static_cast<int>(order.size()) - 1; i > 0; --i)
            std::swap(order[at(i)], order[at(rng_.below(i + 1))]);
        int moved = 0;
        for (std::size_t i = 0; i < order.size(); ++i) {
            progress_.poll("compact",
                           0.2 + 0.5 * static_cast<double>(i) / static_cast<double>(order.size()));
            if (!unlock_collapse(mesh_, order[i], walk, rng_, scratch_)) continue;
            touch(scratch_.touched);
            gone_[at(order[i])] = 1;
            ++moved;
        }
        stats_.unlocked += moved;
        drop_removed();
        collapse_all();
        return moved;
    }

    TetComplex& mesh_;
    CompactOptions options_;
    Progress& progress_;
    Rng rng_;
    CompactStats stats_;
    Sweep sweep_;
    CollapseScratch scratch_;
    std::vector<char> dirty_;   // per point: its star changed since its last try
    std::vector<char> gone_;    // per point: collapsed
    std::vector<int> steiner_;  // still there: on edges first, then in facets, then inside
};

}  // namespace

SteinerCount count_steiner(const ExactMesh& mesh) {
    SteinerCount n;
    for (const Carrier& c : mesh.carriers) {
        n.edge += c.kind == CarrierKind::edge;
        n.facet += c.kind == CarrierKind::facet;
        n.inner += c.kind == CarrierKind::inner;
    }
    return n;
}

CompactStats compact(ExactMesh& mesh, const GridSolid& solid, std::span<const int> faces,
                     const CompactOptions& options, Progress& progress) {
    const auto start = std::chrono::steady_clock::now();
    const int tets_before = static_cast<int>(mesh.tets.size());
    const SteinerCount steiner_before = count_steiner(mesh);
    CompactStats stats;
    if (options.level != CompactLevel::none) {
        TetComplex complex(mesh, solid.grid, facet_classes(solid, faces));
        stats = Compactor(complex, options, progress).run();
        complex.write_back(mesh, nullptr);
    }
    stats.tets_before = tets_before;
    stats.tets_after = static_cast<int>(mesh.tets.size());
    stats.steiner_before = steiner_before;
    stats.steiner_after = count_steiner(mesh);
    stats.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    return stats;
}

}  // namespace tetra
