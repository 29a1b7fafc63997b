// SPDX-License-Identifier: LGPL-2.1-or-later
// Moving points to the caller's coordinates: all at once, one by one, then by flips and peels.
#include "tetra/assemble/restore.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <string>
#include <utility>

#include "flip_walk.h"
#include "insert_point.h"
#include "peel.h"
#include "restore_facets.h"
#include "restore_targets.h"
#include "sweeps.h"
#include "tet_complex.h"
#include "tetra/assemble/tet_quality.h"
#include "tetra/errors.h"
#include "unlock.h"

namespace tetra {
namespace {

std::size_t at(int i) { return static_cast<std::size_t>(i); }

constexpr double kSliver = 1e-6;  // grid steps of height below which a flip is looked for (B6)

class Restorer {
  public:
    Restorer(TetComplex& mesh, RestoreTargets targets, const RestoreOptions& options, Rng& rng,
             Progress& progress)
        : mesh_(mesh),
          targets_(std::move(targets)),
          options_(options),
          progress_(progress),
          rng_(rng),
          home_(at(mesh.point_count())),
          moved_(targets_.bound.size(), 1) {
        for (int p = 0; p < mesh.point_count(); ++p) home_[at(p)] = mesh.place(p);
    }

    RestoreStats run() {
        mesh_.release_places();
        for (int p = 0; p < mesh_.point_count(); ++p)
            if (targets_.bound[at(p)]) moved_[at(p)] = 0;
        move_all();
        for (const double floor : {kSliver, 0.0}) {
            floor_ = floor * mesh_.grid().step;
            move_singly();
            unblock_all();
        }
        right_the_inverted();
        return stats_;
    }

    // Flips that raise the least mean ratio of what they replace (stage 7).
    void improve(double below) {
        for (int t = 0; t < mesh_.id_count(); ++t) {
            progress_.poll("restore", 0.9);
            if (mesh_.alive(t) && quality(mesh_.tet(t)) < below) improve_at(t);
        }
        mesh_.forget();
    }

    void count(RestoreStats& s) const {
        for (int p = 0; p < mesh_.point_count(); ++p) {
            if (!targets_.bound[at(p)]) continue;
            const bool input = !mesh_.steiner(p);
            ++(input ? s.input_vertices : s.steiner_points);
            if (moved_[at(p)]) continue;
            ++(input ? s.vertices_on_grid : s.steiner_on_grid);
            double off = 0;
            for (std::size_t k = 0; k < 3; ++k)
                off = std::max(off, std::fabs(mesh_.place(p)[k] - targets_.place[at(p)][k]));
            s.steiner_off_plane += !input && off > 1e-7;
            if (input) s.left.push_back(mesh_.carrier(p).first);
        }
        for (int t = 0; t < mesh_.id_count(); ++t)
            s.slivers += mesh_.alive(t) && height(mesh_.tet(t)) < kSliver * mesh_.grid().step;
    }

  private:
    using Corners = std::array<Vec3d, 4>;

    Corners corners(const Tet& t) const {
        return {mesh_.place(t[0]), mesh_.place(t[1]), mesh_.place(t[2]), mesh_.place(t[3])};
    }
    double height(const Tet& t) const {
        const Corners c = corners(t);
        return least_height(c[0], c[1], c[2], c[3]);
    }
    double quality(const Tet& t) const {
        const Corners c = corners(t);
        return mean_ratio(c[0], c[1], c[2], c[3]);
    }
    bool sound(const Tet& t) const {
        return mesh_.place_positive(t) && (floor_ == 0 || height(t) >= floor_);
    }
    // Sound once p is at its target.
    bool sound_with(const Tet& t, int p) {
        const Vec3d now = mesh_.place(p);
        mesh_.set_place(p, targets_.place[at(p)]);
        const bool r = sound(t);
        mesh_.set_place(p, now);
        return r;
    }

    void settle(int p) {
        mesh_.set_place(p, targets_.place[at(p)]);
        moved_[at(p)] = 1;
    }
    void put_back(int p) {
        mesh_.set_place(p, home_[at(p)]);
        moved_[at(p)] = 0;
        ++stats_.put_back;
    }

    void move_all() {
        floor_ = kSliver * mesh_.grid().step;
        for (int p = 0; p < mesh_.point_count(); ++p)
            if (targets_.bound[at(p)]) settle(p);
        std::vector<int> queue;
        for (int t = mesh_.id_count() - 1; t >= 0; --t)
            if (mesh_.alive(t)) queue.push_back(t);
        while (!queue.empty()) {
            const int t = queue.back();
            queue.pop_back();
            progress_.poll("restore", 0.1);
            if (sound(mesh_.tet(t))) continue;
            for (int p : mesh_.tet(t)) {
                if (!targets_.bound[at(p)] || !moved_[at(p)]) continue;
                put_back(p);
                for (int s : mesh_.star_of(p)) queue.push_back(s);
            }
        }
    }

    std::vector<int> stuck() const {
        std::vector<int> r;
        for (int p = 0; p < mesh_.point_count(); ++p)
            if (targets_.bound[at(p)] && !moved_[at(p)]) r.push_back(p);
        return r;
    }

    // The tetrahedra of p's star that forbid its move. Those unsound already don't count while
    // they stay positive: their own turn comes.
    std::vector<int> blockers(int p) {
        std::vector<int> r;
        for (int t : mesh_.star_of(p)) {
            const Tet& v = mesh_.tet(t);
            if (!sound_with(v, p) && !tolerated(v, p)) r.push_back(t);
        }
        return r;
    }
    bool tolerated(const Tet& t, int p) {
        if (floor_ == 0 || sound(t)) return false;
        const double floor = std::exchange(floor_, 0.0);
        const bool r = sound_with(t, p);
        floor_ = floor;
        return r;
    }

    bool move_if_free(int p) {
        if (!blockers(p).empty()) return false;
        settle(p);
        return true;
    }

    void move_singly() {
        for (bool any = true; any;) {
            any = false;
            for (int p : stuck()) any = move_if_free(p) || any;
        }
    }

    // p and the other unmoved points of what blocks it (B4 a).
    std::vector<int> group_of(int p) {
        std::vector<int> group{p};
        for (int t : blockers(p))
            for (int v : mesh_.tet(t))
                if (targets_.bound[at(v)] && !moved_[at(v)]) group.push_back(v);
        std::sort(group.begin(), group.end());
        group.erase(std::unique(group.begin(), group.end()), group.end());
        return group;
    }

    // Moves the points, then walks through meshes that are valid on the grid until none of their
    // tetrahedra is unsound in doubles.
    bool walk(const std::vector<int>& points, int sideways) {
        std::vector<int> bad;
        for (int p : points) {
            const std::vector<int> more = blockers(p);
            bad.insert(bad.end(), more.begin(), more.end());
        }
        for (int p : points) settle(p);
        if (points.size() > 1)
            for (int p : points)
                for (int t : mesh_.star_of(p))
                    if (!sound(mesh_.tet(t))) bad.push_back(t);
        std::sort(bad.begin(), bad.end());
        bad.erase(std::unique(bad.begin(), bad.end()), bad.end());
        std::erase_if(bad, [&](int t) { return sound(mesh_.tet(t)); });
        const auto is_bad = [&](const Tet& t) { return !sound(t); };
        const auto may_remove = [](int, int) { return true; };
        FlipWalk walk(mesh_, {sideways, 7, 6, sideways / 4}, rng_, is_bad, may_remove);
        std::vector<int> touched;
        const std::size_t mark = mesh_.mark();
        mesh_.ask_grid_only(true);
        const bool free = walk.run(std::move(bad), touched);
        mesh_.ask_grid_only(false);
        if (free) {
            stats_.flips += walk.flips();
            mesh_.forget();
            return true;
        }
        mesh_.undo_to(mark);
        for (int p : points) {
            mesh_.set_place(p, home_[at(p)]);
            moved_[at(p)] = 0;
        }
        return false;
    }

    bool peel_at(int p) {
        const std::vector<int> flat = blockers(p);
        bool any = false;
        for (int t : flat) {
            if (!mesh_.alive(t) || !may_peel(mesh_, t, targets_.place)) continue;
            mesh_.peel(t);
            ++stats_.peeled;
            any = true;
        }
        return any && move_if_free(p);
    }

    // Removes a Steiner point that is in the way (B4 b): p itself or one of its blockers.
    bool collapse_near(int p) {
        std::vector<int> candidates;
        if (mesh_.steiner(p)) candidates.push_back(p);
        for (int t : blockers(p))
            for (int v : mesh_.tet(t))
                if (v != p && mesh_.steiner(v)) candidates.push_back(v);
        WalkOptions strong;
        strong.targets = 6;
        strong.max_bad = 20;
        strong.sideways = 20;
        strong.max_ring = 7;
        strong.wander = 4;
        for (int v : candidates) {
            if (mesh_.star_of(v).empty() || !unlock_collapse(mesh_, v, strong, rng_, scratch_))
                continue;
            ++stats_.collapses;
            targets_.bound[at(v)] = 0;
            if (v == p || move_if_free(p)) return true;
        }
        return false;
    }

    bool unblock(int p) {
        if (move_if_free(p) || walk({p}, 0) || peel_at(p)) return true;
        const std::vector<int> group = group_of(p);
        if (group.size() > 1 && walk(group, 0)) return true;
        if (collapse_near(p)) return true;
        const bool last = floor_ == 0;
        for (int k = 0; k < options_.walks; ++k) {
            progress_.poll("restore", 0.5);
            if (!walk(k % 4 == 3 ? group : std::vector<int>{p}, last ? 80 : 30)) continue;
            ++stats_.walks;
            return true;
        }
        return last && insert_near(p);
    }

    // The last resort: one more point inside the solid.
    bool insert_near(int p) {
        const std::vector<int> bad = blockers(p);
        settle(p);
        if (insert_for(bad)) return true;
        mesh_.set_place(p, home_[at(p)]);
        moved_[at(p)] = 0;
        return false;
    }

    bool insert_for(const std::vector<int>& bad) {
        const Insertion done =
            insert_point(mesh_, bad, rng_, [&](const Tet& t) { return sound(t); });
        if (done.point < 0) return false;
        targets_.place.push_back(mesh_.place(done.point));
        targets_.bound.push_back(0);
        home_.push_back(mesh_.place(done.point));
        moved_.push_back(1);
        for (const int v : done.vanished) targets_.bound[at(v)] = 0;
        ++stats_.inserted;
        return true;
    }

    void unblock_all() {
        for (bool any = true; any;) {
            any = false;
            for (int p : stuck())
                if (!moved_[at(p)] && targets_.bound[at(p)] && unblock(p)) any = true;
        }
    }

    // Tetrahedra that were not positive on the grid's doubles and that no move made so.
    void right_the_inverted() {
        for (int t = 0; t < mesh_.id_count(); ++t) {
            if (!mesh_.alive(t) || mesh_.place_positive(mesh_.tet(t))) continue;
            const auto is_bad = [&](const Tet& v) { return !mesh_.place_positive(v); };
            const auto may_remove = [](int, int) { return true; };
            std::vector<int> touched;
            FlipWalk walk(mesh_, {0, 7, 6}, rng_, is_bad, may_remove);
            if (walk.run({t}, touched)) {
                mesh_.forget();
                stats_.flips += walk.flips();
                continue;
            }
            if (insert_for({t})) continue;
            const Tet& v = mesh_.tet(t);
            std::string where;
            for (int p : v) where += " " + std::to_string(mesh_.carrier(p).first);
            throw VerificationFailed(
                "restoring left a tetrahedron without volume near the input vertices" + where +
                "; try another direction or a finer grid");
        }
    }

    void improve_at(int t) {
        for (int op = 0; op < 10; ++op) {
            Flip flip;
            double worst = 1;
            if (op < 4) {
                if (!propose_face_flip(mesh_, t, op, flip)) continue;
                for (int k : flip.killed()) worst = std::min(worst, quality(mesh_.tet(k)));
                bool better = true;
                for (const Tet& v : flip.added()) better = better && quality(v) > worst;
                if (!better) continue;
            } else {
                Ring ring;
                const auto& e = kTetEdges[op - 4];
                if (!find_ring(mesh_, t, e[0], e[1], 7, ring)) continue;
                if (ring.open && (ring.first_class != ring.last_class || ring.size < 2)) continue;
                for (int k = 0; k < ring.size; ++k)
                    worst = std::min(worst, quality(mesh_.tet(ring.tets[at(k)])));
                const auto cost = [&](const Tet& v) {
                    const double q = quality(v);
                    return q > worst ? 1 / q : std::numeric_limits<double>::infinity();
                };
                if (!propose_edge_flip(mesh_, ring, cost, flip)) continue;
                if (ring.open && !may_open_flip(mesh_, ring)) continue;
            }
            mesh_.apply(flip);
            ++stats_.quality_flips;
            return;
        }
    }

    TetComplex& mesh_;
    RestoreTargets targets_;
    RestoreOptions options_;
    Progress& progress_;
    Rng& rng_;
    std::vector<Vec3d> home_;  // the grid's places
    std::vector<char> moved_;  // at its target
    RestoreStats stats_;
    CollapseScratch scratch_;
    double floor_ = 0;  // least height of a sound tetrahedron, in the caller's unit

  public:
    int quality_flips() const { return stats_.quality_flips; }
};

struct Model {
    const GridSolid& solid;
    const FacetClasses& classes;
    const std::vector<Vec3d>& vertices;
};

int misplaced(const RestoreStats& s) { return s.vertices_on_grid + s.steiner_on_grid; }

// What blocks a vertex is a matter of luck: a later attempt starts from other diagonals.
Restored attempt_restore(const ExactMesh& mesh, ExactMesh& result, const Model& model,
                         const RestoreOptions& options, int attempt, Progress& progress) {
    TetComplex complex(mesh, model.solid.grid, model.classes);
    Rng rng{options.seed + static_cast<std::uint64_t>(attempt)};
    Sweep sweep{complex, rng, progress, nullptr, 0};
    for (int k = 0; k < std::min(attempt, 3); ++k) neutral_sweep(sweep);
    Restorer restorer(complex, restore_targets(complex, model.solid, model.classes, model.vertices),
                      options, rng, progress);
    Restored out;
    out.stats = restorer.run();
    if (options.quality_below > 0) restorer.improve(options.quality_below);
    out.stats.quality_flips = restorer.quality_flips();
    restorer.count(out.stats);
    for (int& v : out.stats.left) v = model.solid.point_source[at(v)];
    complex.write_back(result, &out.points);
    out.facet_of_triangle = joined_facets(model.classes, complex.peeled_pairs());
    refine_sources(result, model.solid, out.facet_of_triangle);
    return out;
}

}  // namespace

Restored restore(ExactMesh& mesh, const GridSolid& solid, const std::vector<Vec3d>& vertices,
                 std::span<const int> faces, const RestoreOptions& options, Progress& progress) {
    const auto start = std::chrono::steady_clock::now();
    const FacetClasses classes = facet_classes(solid, faces);
    Restored best;
    ExactMesh best_mesh;
    for (int attempt = 0; attempt < std::max(1, options.attempts); ++attempt) {
        ExactMesh result;
        Restored now =
            attempt_restore(mesh, result, {solid, classes, vertices}, options, attempt, progress);
        const bool better = attempt == 0 || misplaced(now.stats) < misplaced(best.stats);
        if (better) {
            best = std::move(now);
            best_mesh = std::move(result);
        }
        best.stats.attempts = attempt + 1;
        // Where many are left, luck is not what is missing.
        if (misplaced(best.stats) == 0 || (misplaced(best.stats) > 3 && attempt == 1)) break;
    }
    mesh = std::move(best_mesh);
    best.stats.seconds =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    return best;
}

}  // namespace tetra
