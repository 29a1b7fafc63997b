// SPDX-License-Identifier: LGPL-2.1-or-later
// The order of removals: a heap by crown size, re-keyed around each removed vertex.
#include "tetra/fence/pull_off.h"

#include <algorithm>
#include <memory>
#include <queue>
#include <tuple>

#include "pull_off_crossings.h"
#include "pull_off_crown.h"
#include "pull_off_tree.h"
#include "tetra/exact/predicates.h"

namespace tetra {
namespace {

std::vector<int> used_points(const PullSurface& surface) {
    std::vector<int> ids;
    for (std::size_t v = 0; v < surface.star.size(); ++v)
        if (!surface.star[v].empty()) ids.push_back(static_cast<int>(v));
    return ids;
}

class Puller {
  public:
    Puller(const std::vector<Vec3i>& points, const std::vector<Triangle>& triangles,
           const std::vector<int>& owners, const PullOptions& options, Progress& progress)
        : options_(options),
          progress_(progress),
          surface_(points, triangles, owners),
          tree_(points, used_points(surface_)),
          state_(points.size()) {
        for (const int owner : owners) result_.first_cup = std::max(result_.first_cup, owner + 1);
        if (options.mode == PullMode::crossings) {
            const std::vector<VertexPair> edges = sharp_edges(surface_);
            seen_ = std::make_unique<ProjectedEdges>(points, edges.size());
            result_.crossings_before = result_.crossings_after = add(edges, {});
        }
    }

    PullOff run() {
        // Without crossings the mode could only save sharp edges, which is not what it is for.
        if (result_.crossings_before == 0) {
            finish();
            return std::move(result_);
        }
        const std::vector<int> all = used_points(surface_);
        total_ = all.size() + 1;
        for (const int v : all) push(v);
        // A vertex that was refused may become free when its hindrance goes; rounds end when one
        // removes nothing.
        for (int before = -1; before != result_.statistics.removed;) {
            before = result_.statistics.removed;
            drain();
            if (before == result_.statistics.removed) break;
            for (const int v : all) retry(v);
        }
        finish();
        return std::move(result_);
    }

  private:
    enum class Refusal { none, unfavourable, hindered, gain };

    struct VertexState {
        std::uint32_t version = 0;
        Refusal refusal = Refusal::none;
        Hindrance hindrance;
        std::size_t judged_degree = 0;
    };
    using Entry = std::tuple<std::size_t, int, std::uint32_t>;  // crown size, vertex, version

    VertexState& state(int v) { return state_[static_cast<std::size_t>(v)]; }

    // Keys v anew after its star changed. A hub far above the cap is not looked at again before
    // its degree fell by an eighth, which keeps the cost of re-keying linear.
    void push(int v) {
        VertexState& s = state(v);
        ++s.version;
        s.refusal = Refusal::unfavourable;
        const std::size_t degree = surface_.star_of(v).size();
        const std::size_t cap = static_cast<std::size_t>(options_.degree_cap);
        if (degree < 3) return;
        if (degree > 8 * cap && s.judged_degree > 0 && degree * 8 > s.judged_degree * 7 &&
            degree <= s.judged_degree)
            return;
        s.judged_degree = degree;
        const Crown crown = crown_of(surface_, v, link_);
        if (crown.kind == PulledKind::mixed_owners) ++result_.statistics.refused_owner;
        if (crown.kind != PulledKind::favourable) return;
        if (crown.ring.size() > cap) {
            ++result_.statistics.refused_degree;
            return;
        }
        s.refusal = Refusal::none;
        heap_.push({crown.ring.size(), v, s.version});
    }

    void retry(int v) {
        const VertexState& s = state(v);
        if (surface_.star_of(v).empty()) return;
        if (s.refusal == Refusal::hindered && still_hindered(s.hindrance)) return;
        if (s.refusal == Refusal::hindered || s.refusal == Refusal::gain) push(v);
        if (s.refusal == Refusal::unfavourable && surface_.star_of(v).size() != s.judged_degree) {
            state(v).judged_degree = 0;
            push(v);
        }
    }

    // With an unchanged star a hindrance only ends with its witness.
    bool still_hindered(const Hindrance& h) const {
        if (h.kind == PulledKind::hindered_by_vertex) return !surface_.star_of(h.first).empty();
        return surface_.has_edge(h.first, h.second);
    }

    void drain() {
        while (!heap_.empty()) {
            const auto [size, v, version] = heap_.top();
            heap_.pop();
            if (version != state(v).version || surface_.star_of(v).empty()) continue;
            progress_.poll("pull_off", static_cast<double>(result_.statistics.removed) /
                                           static_cast<double>(total_));
            attempt(v);
        }
    }

    void attempt(int v) {
        PullStatistics& count = result_.statistics;
        ++count.tries;
        Crown crown = crown_of(surface_, v, link_);
        if (crown.kind != PulledKind::favourable) return;
        const std::vector<Triangle> dome = dome_of(surface_, v, crown.ring);
        if (dome.empty()) {
            ++count.without_dome;
            state(v).refusal = Refusal::unfavourable;
            return;
        }
        const Hindrance hindrance = hindrance_of(surface_, tree_, v, crown.ring, dome);
        if (hindrance.kind != PulledKind::favourable) {
            ++(hindrance.kind == PulledKind::hindered_by_vertex ? count.hindered_by_vertex
                                                                : count.hindered_by_edge);
            state(v).refusal = Refusal::hindered;
            state(v).hindrance = hindrance;
            return;
        }
        Cup cup{v, crown.ring, crown.owner, {}};
        for (const Triangle& t : dome)
            cup.dome.push_back({at(crown.ring, t[0]), at(crown.ring, t[1]), at(crown.ring, t[2])});
        if (!commit(cup, crown.flips)) {
            ++count.refused_gain;
            state(v).refusal = Refusal::gain;
        }
    }

    static int at(const std::vector<int>& ring, int i) { return ring[static_cast<std::size_t>(i)]; }

    // Replaces the star of the apex by flipped triangles and dome; false (and nothing changed)
    // when the mode asks for a gain and there is none.
    bool commit(Cup& cup, const std::vector<CrownFlip>& flips) {
        const std::vector<int> removed = surface_.star_of(cup.apex);
        std::vector<int> touched;
        for (const int id : removed)
            for (const int v : surface_.triangle(id))
                if (v != cup.apex) touched.push_back(v);
        std::sort(touched.begin(), touched.end());
        touched.erase(std::unique(touched.begin(), touched.end()), touched.end());

        const bool closing = cup.dome.size() == 1 && reverse_of(cup.dome.front()) >= 0;
        const bool watch = seen_ != nullptr;
        const std::vector<VertexPair> around =
            watch ? edges_around(cup, flips) : std::vector<VertexPair>();
        const std::vector<VertexPair> before = sharp_among(around);
        for (const int id : removed) surface_.remove(id);
        std::vector<int> added;
        for (const CrownFlip& f : flips) added.push_back(surface_.add({f.u, f.w, f.x}, f.owner));
        const int owner = result_.first_cup + static_cast<int>(result_.cups.size());
        for (const Triangle& t : cup.dome) added.push_back(surface_.add(t, owner));
        if (watch && !closing && !gains(before, sharp_among(around))) {
            for (const int id : added) surface_.remove(id);
            for (const int id : removed) surface_.revive(id);
            return false;
        }
        record(cup, flips);
        if (closing) close(cup, added.back());
        if (watch && closing) {
            result_.crossings_after -= take_off(before, {});
            result_.crossings_after += add(sharp_among(around), {});
        }
        for (const int v : touched) {
            if (surface_.star_of(v).empty()) tree_.erase(v);
            push(v);
        }
        tree_.erase(cup.apex);
        result_.cups.push_back(std::move(cup));
        return true;
    }

    int reverse_of(const Triangle& t) const { return surface_.find(t[0], t[2], t[1]); }

    void close(const Cup& cup, int dome_id) {
        const Triangle dome = cup.dome.front();
        const int facet = reverse_of(dome);
        result_.closings.push_back(
            {static_cast<int>(result_.cups.size()), surface_.owner(facet), dome});
        surface_.remove(facet);
        surface_.remove(dome_id);
    }

    void record(const Cup& cup, const std::vector<CrownFlip>& flips) {
        PullStatistics& count = result_.statistics;
        ++count.removed;
        count.flips += static_cast<int>(flips.size());
        const std::size_t k = cup.crown.size();
        if (count.crowns_by_degree.size() <= k) count.crowns_by_degree.resize(k + 1);
        ++count.crowns_by_degree[k];
        for (std::size_t i = 0; i < k; ++i) {
            const int w = cup.crown[i];
            if (collinear(surface_.point(cup.crown[(i + k - 1) % k]), surface_.point(w),
                          surface_.point(cup.crown[(i + 1) % k])))
                result_.keep.push_back(w);
        }
    }

    // Every edge whose sharpness the removal may change.
    std::vector<VertexPair> edges_around(const Cup& cup,
                                         const std::vector<CrownFlip>& flips) const {
        std::vector<VertexPair> edges;
        const auto add = [&](const Triangle& t) {
            for (std::size_t k = 0; k < 3; ++k) edges.push_back(vertex_pair(t[k], t[(k + 1) % 3]));
        };
        for (const int id : surface_.star_of(cup.apex)) add(surface_.triangle(id));
        for (const CrownFlip& f : flips) add({f.u, f.w, f.x});
        for (const Triangle& t : cup.dome) add(t);
        std::sort(edges.begin(), edges.end());
        edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
        return edges;
    }

    std::vector<VertexPair> sharp_among(const std::vector<VertexPair>& edges) const {
        std::vector<VertexPair> sharp;
        for (const VertexPair& e : edges)
            if (surface_.is_sharp(e[0], e[1])) sharp.push_back(e);
        return sharp;
    }

    // The vertical ones and those in `unchanged` don't matter.
    template <class Visit>
    void for_each_seen(const std::vector<VertexPair>& edges,
                       const std::vector<VertexPair>& unchanged, const Visit& visit) const {
        for (const VertexPair& e : edges)
            if (!is_vertical(surface_, e) &&
                !std::binary_search(unchanged.begin(), unchanged.end(), e))
                visit(e);
    }

    // Crossings lost by taking the edges off, and won by adding them.
    std::int64_t take_off(const std::vector<VertexPair>& edges,
                          const std::vector<VertexPair>& unchanged) {
        std::int64_t lost = 0;
        for_each_seen(edges, unchanged, [&](const VertexPair& e) {
            seen_->erase(e);
            lost += seen_->crossings(e);
        });
        return lost;
    }
    std::int64_t add(const std::vector<VertexPair>& edges,
                     const std::vector<VertexPair>& unchanged) {
        std::int64_t won = 0;
        for_each_seen(edges, unchanged, [&](const VertexPair& e) {
            won += seen_->crossings(e);
            seen_->insert(e);
        });
        return won;
    }

    bool gains(const std::vector<VertexPair>& before, const std::vector<VertexPair>& after) {
        std::vector<VertexPair> both;
        std::set_intersection(before.begin(), before.end(), after.begin(), after.end(),
                              std::back_inserter(both));
        const bool fewer = after.size() < before.size();
        const std::int64_t lost = take_off(before, both);
        if (lost > 0 || fewer) {
            const std::int64_t change = add(after, both) - lost;
            if (change < 0 || (change == 0 && fewer)) {
                result_.crossings_after += change;
                return true;
            }
            for_each_seen(after, both, [&](const VertexPair& e) { seen_->erase(e); });
        }
        for_each_seen(before, both, [&](const VertexPair& e) { seen_->insert(e); });
        return false;
    }

    void finish() {
        for (std::size_t i = 0; i < surface_.triangles.size(); ++i) {
            if (!surface_.alive[i]) continue;
            result_.triangles.push_back(surface_.triangles[i]);
            result_.owners.push_back(surface_.owners[i]);
        }
        std::sort(result_.keep.begin(), result_.keep.end());
        result_.keep.erase(std::unique(result_.keep.begin(), result_.keep.end()),
                           result_.keep.end());
    }

    const PullOptions options_;
    Progress& progress_;
    PullSurface surface_;
    PointTree tree_;
    std::vector<VertexState> state_;
    std::priority_queue<Entry, std::vector<Entry>, std::greater<>> heap_;
    std::unique_ptr<ProjectedEdges> seen_;
    LinkBuffers link_;
    PullOff result_;
    std::size_t total_ = 1;
};

PulledKind classify(const PullSurface& surface, const PointTree& tree, int v) {
    if (surface.star_of(v).empty()) return PulledKind::unused;
    LinkBuffers link;
    const Crown crown = crown_of(surface, v, link);
    if (crown.kind != PulledKind::favourable) return crown.kind;
    const std::vector<Triangle> dome = dome_of(surface, v, crown.ring);
    if (dome.empty()) return PulledKind::without_dome;
    return hindrance_of(surface, tree, v, crown.ring, dome).kind;
}

}  // namespace

PullOff pull_off(const std::vector<Vec3i>& points, const std::vector<Triangle>& triangles,
                 const std::vector<int>& owners, const PullOptions& options, Progress& progress) {
    return Puller(points, triangles, owners, options, progress).run();
}

std::vector<PulledKind> classify_vertices(const std::vector<Vec3i>& points,
                                          const std::vector<Triangle>& triangles,
                                          const std::vector<int>& owners) {
    const PullSurface surface(points, triangles, owners);
    const PointTree tree(points, used_points(surface));
    std::vector<PulledKind> kinds(points.size(), PulledKind::unused);
    for (std::size_t v = 0; v < points.size(); ++v)
        kinds[v] = classify(surface, tree, static_cast<int>(v));
    return kinds;
}

}  // namespace tetra
