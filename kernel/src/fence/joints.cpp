// SPDX-License-Identifier: LGPL-2.1-or-later
// Ranks all heights over one plan point, spreads splits up and down its vertical line, keeps marks.
#include "joints.h"

#include <algorithm>
#include <limits>
#include <numeric>

namespace tetra::fence {
namespace {

// Ids of surfaces over a point: facets, then edges, then input points.
class Joiner {
  public:
    Joiner(const Plan& plan, Walls& walls, const std::vector<InnerPoint>& inner)
        : plan_(plan), walls_(walls), inner_(inner) {
        group();
    }

    Joints run(Progress& progress) {
        const int n = plan_.points.size();
        joints_.mark_offset.push_back(0);
        for (int p = 0; p < n; ++p) {
            if (p % 64 == 0) progress.poll("fences", 0.5 + 0.2 * p / n);
            if (!walls_at_[p].empty() || !inner_at_[p].empty()) join_at(p);
            joints_.mark_offset.push_back(static_cast<int>(joints_.marks.size()));
            joints_.surfaces.offset.push_back(static_cast<int>(joints_.surfaces.items.size()));
        }
        return std::move(joints_);
    }

  private:
    struct Candidate {
        int surface;
        Height height;
        int root;  // equal for surfaces that are known to meet over the point
        int rank;
    };

    int vertex_id(int v) const { return first_vertex_ + v; }

    const Surface& surface(int id) const {
        if (id < first_vertex_) return at(plan_.surfaces, id);
        return at(vertex_surface_, at(vertex_slot_, id - first_vertex_));
    }

    void group() {
        first_vertex_ = static_cast<int>(plan_.surfaces.size());
        vertex_slot_.assign(plan_.point_of.size(), -1);
        parent_.assign(static_cast<std::size_t>(first_vertex_) + plan_.point_of.size(), -1);
        const int n = plan_.points.size();
        std::vector<int> key;
        for (const WallPoint& w : walls_.points) key.push_back(w.point);
        walls_at_ = group_by(key, n);
        vertices_at_ = group_by(plan_.point_of, n);
        key.clear();
        for (const SharpEdge& e : plan_.edges)
            key.push_back(e.line < 0 ? at(plan_.point_of, e.u) : -1);
        vertical_at_ = group_by(key, n);
        edges_at_ = group_by(walls_.edge_at_point, n);
        key.clear();
        for (const InnerPoint& i : inner_) key.push_back(i.point);
        inner_at_ = group_by(key, n);
    }

    void join_at(int p) {
        point_ = p;
        collect_candidates();
        rank_candidates();
        seed();
        spread();
        use_marks();
        store_marks();
    }

    template <class Visit>  // visit(surface) of the wall point's floor, ceiling and chains
    void for_each_surface(int w, Visit visit) const {
        const WallPoint& wall = at(walls_.points, w);
        const Run& run = at(walls_.runs, wall.run);
        visit(run.floor);
        visit(run.ceiling);
        if (wall.chain > 0)
            for (const int e : walls_.chains[wall.chain]) visit(plan_.edge_surface_id(e));
        const bool first = w == 0 || at(walls_.points, w - 1).run != wall.run;
        if (!first && at(walls_.points, w - 1).chain > 0 &&
            at(walls_.points, w - 1).chain != wall.chain)
            for (const int e : walls_.chains[at(walls_.points, w - 1).chain])
                visit(plan_.edge_surface_id(e));
    }

    void collect_candidates() {
        ids_.clear();
        for (const int w : walls_at_[point_])
            for_each_surface(w, [&](int s) { ids_.push_back(s); });
        for (const int i : inner_at_[point_]) {
            ids_.push_back(at(inner_, i).floor);
            ids_.push_back(at(inner_, i).ceiling);
        }
        vertex_surface_.clear();
        for (const int v : vertices_at_[point_]) {
            at(vertex_slot_, v) = static_cast<int>(vertex_surface_.size());
            vertex_surface_.push_back(vertex_surface(plan_.at(v)));
            ids_.push_back(vertex_id(v));
        }
        std::sort(ids_.begin(), ids_.end());
        ids_.erase(std::unique(ids_.begin(), ids_.end()), ids_.end());
    }

    void rank_candidates() {
        const PlanPoint& p = plan_.points[point_];
        candidates_.clear();
        join_incident();
        for (const int id : ids_) candidates_.push_back({id, height(surface(id), p), root(id), 0});
        reset_roots();
        const auto compare = [&](const Candidate& s, const Candidate& t) {
            if (s.root == t.root) return 0;
            return compare_heights(surface(s.surface), s.height, surface(t.surface), t.height, p);
        };
        std::sort(candidates_.begin(), candidates_.end(),
                  [&](const Candidate& s, const Candidate& t) {
                      const int order = compare(s, t);
                      return order != 0 ? order < 0 : s.surface < t.surface;
                  });
        rank_.assign(ids_.size(), 0);
        int rank = 0;
        for (std::size_t i = 0; i < candidates_.size(); ++i) {
            if (i > 0 && compare(candidates_[i - 1], candidates_[i]) != 0) ++rank;
            candidates_[i].rank = rank;
            rank_[slot(candidates_[i].surface)] = rank;
        }
        ranks_ = rank + 1;
    }

    // Edges through the point with the facets and input points on them, without arithmetic.
    void join_incident() {
        for (const int k : edges_at_[point_]) {
            const int e = at(walls_.edge_at, k);
            const SharpEdge& edge = at(plan_.edges, e);
            if (edge.line < 0) continue;
            const int id = plan_.edge_surface_id(e);
            for (const int f : plan_.edge_facets[e])
                if (at(plan_.facets, f).side != 0) unite(id, f);
            for (const int v : {edge.u, edge.v})
                if (at(plan_.point_of, v) == point_) unite(id, vertex_id(v));
        }
    }

    int root(int id) {
        if (at(parent_, id) < 0) return id;
        while (at(parent_, id) != id) id = at(parent_, id) = at(parent_, at(parent_, id));
        return id;
    }

    void unite(int i, int j) {
        for (const int k : {i, j})
            if (at(parent_, k) < 0) {
                at(parent_, k) = k;
                joined_.push_back(k);
            }
        i = root(i);
        j = root(j);
        at(parent_, std::max(i, j)) = std::min(i, j);
    }

    void reset_roots() {
        for (const int k : joined_) at(parent_, k) = -1;
        joined_.clear();
    }

    std::size_t slot(int id) const {
        return static_cast<std::size_t>(std::lower_bound(ids_.begin(), ids_.end(), id) -
                                        ids_.begin());
    }
    int rank_of(int id) const { return rank_[slot(id)]; }

    struct Span {
        int wall, low, high;
    };

    Span span_of(int w) const {
        const Run& run = at(walls_.runs, at(walls_.points, w).run);
        return {w, rank_of(run.floor), rank_of(run.ceiling)};
    }

    void cover(int low, int high) { std::fill(covered_.begin() + low, covered_.begin() + high, 1); }

    // Spans of active walls and of vertical edges; walls that hold a kept vertex become active.
    void seed() {
        covered_.assign(static_cast<std::size_t>(ranks_), 0);
        kept_.assign(static_cast<std::size_t>(ranks_), 0);
        for (const int v : vertices_at_[point_])
            if (plan_.kept(v)) at(kept_, rank_of(vertex_id(v))) = 1;
        for (const int e : vertical_at_[point_]) {
            const SharpEdge& edge = at(plan_.edges, e);
            cover(rank_of(vertex_id(edge.u)), rank_of(vertex_id(edge.v)));
        }
        passive_.clear();
        for (const int w : walls_at_[point_]) {
            const Span span = span_of(w);
            WallPoint& wall = at(walls_.points, w);
            if (!wall.active && std::find(kept_.begin() + span.low, kept_.begin() + span.high + 1,
                                          1) != kept_.begin() + span.high + 1) {
                wall.active = true;
                ++joints_.propagated;
            }
            if (wall.active)
                cover(span.low, span.high);
            else
                passive_.push_back(span);
        }
    }

    // Rules R7 and R7b, until nothing changes.
    void spread() {
        for (bool changed = true; changed;) {
            changed = false;
            std::erase_if(passive_, [&](const Span& span) {
                const bool touched =
                    span.low < span.high
                        ? std::find(covered_.begin() + span.low, covered_.begin() + span.high, 1) !=
                              covered_.begin() + span.high
                        : touches_active_wall_of_cell(span.wall);
                if (!touched) return false;
                at(walls_.points, span.wall).active = true;
                cover(span.low, span.high);
                ++joints_.propagated;
                return changed = true;
            });
        }
    }

    bool touches_active_wall_of_cell(int w) const {
        const Run& run = at(walls_.runs, at(walls_.points, w).run);
        for (const int other : walls_at_[point_]) {
            const Run& r = at(walls_.runs, at(walls_.points, other).run);
            if (at(walls_.points, other).active && r.floor == run.floor && r.ceiling == run.ceiling)
                return true;
        }
        return false;
    }

    void use_marks() {
        used_.assign(static_cast<std::size_t>(ranks_), 0);
        used_id_.assign(ids_.size(), 0);
        const auto use = [&](int id) {
            const std::size_t k = slot(id);
            used_id_[k] = 1;
            at(used_, rank_[k]) = 1;
        };
        for (const int w : walls_at_[point_])
            if (at(walls_.points, w).active) for_each_surface(w, use);
        for (const int i : inner_at_[point_]) {
            use(at(inner_, i).floor);
            use(at(inner_, i).ceiling);
        }
        for (const int e : vertical_at_[point_]) {
            use(vertex_id(at(plan_.edges, e).u));
            use(vertex_id(at(plan_.edges, e).v));
        }
        for (const int v : vertices_at_[point_])
            if (plan_.kept(v)) use(vertex_id(v));
    }

    void store_marks() {
        std::vector<int>& mark = mark_of_rank_;
        mark.assign(static_cast<std::size_t>(ranks_), -1);
        double below = -std::numeric_limits<double>::infinity();
        for (std::size_t i = 0; i < candidates_.size();) {
            std::size_t j = i;
            while (j < candidates_.size() && candidates_[j].rank == candidates_[i].rank) ++j;
            if (at(used_, candidates_[i].rank)) {
                at(mark, candidates_[i].rank) = static_cast<int>(joints_.marks.size());
                Mark m = make_mark(i, j);
                m.z = below = std::max(below, to_doubles(place_of(plan_, m))[2]);
                joints_.marks.push_back(m);
            }
            i = j;
        }
        for (std::size_t k = 0; k < ids_.size(); ++k) {
            if (!used_id_[k] || ids_[k] >= first_vertex_) continue;
            joints_.surfaces.items.push_back(ids_[k]);
            joints_.surface_marks.push_back(at(mark, rank_[k]));
        }
    }

    // The candidates i .. j-1 are at one height, facets first, input points last.
    Mark make_mark(std::size_t i, std::size_t j) const {
        const int last = candidates_[j - 1].surface;
        if (last >= first_vertex_) {
            const int v = last - first_vertex_;
            return {point_, -1, {CarrierKind::vertex, v, -1}, 0};
        }
        const auto on_edge = [&](int e, int surface) {
            const SharpEdge& edge = at(plan_.edges, e);
            return Mark{point_, surface, {CarrierKind::edge, edge.u, edge.v}, 0};
        };
        if (last >= plan_.facet_count()) return on_edge(last - plan_.facet_count(), last);
        for (const int k : edges_at_[point_]) {
            const int e = at(walls_.edge_at, k);
            if (at(plan_.edges, e).line < 0) continue;
            const int id = plan_.edge_surface_id(e);
            if (compare_heights(surface(id), surface(last), plan_.points[point_]) == 0)
                return on_edge(e, id);
        }
        for (const int e : vertical_at_[point_]) {
            const SharpEdge& edge = at(plan_.edges, e);
            const int rank = candidates_[i].rank;
            if (rank_of(vertex_id(edge.u)) < rank && rank < rank_of(vertex_id(edge.v)))
                return on_edge(e, last);
        }
        return {point_, last, {CarrierKind::facet, last, -1}, 0};
    }

    const Plan& plan_;
    Walls& walls_;
    const std::vector<InnerPoint>& inner_;
    Joints joints_;
    Lists walls_at_, vertices_at_, vertical_at_, edges_at_, inner_at_;
    int first_vertex_ = 0;

    int point_ = -1, ranks_ = 0;
    std::vector<int> ids_, rank_, vertex_slot_, mark_of_rank_;
    std::vector<int> parent_, joined_;  // sets of surfaces that meet, while a point is ranked
    std::vector<Surface> vertex_surface_;
    std::vector<Candidate> candidates_;
    std::vector<char> covered_, kept_, used_, used_id_;
    std::vector<Span> passive_;
};

}  // namespace

int Joints::mark_of(int point, int surface) const {
    const std::span<const int> list = surfaces[point];
    const auto place = std::lower_bound(list.begin(), list.end(), surface);
    return at(surface_marks, at(surfaces.offset, point) + static_cast<int>(place - list.begin()));
}

Joints join_walls(const Plan& plan, Walls& walls, const std::vector<InnerPoint>& inner,
                  Progress& progress) {
    return Joiner(plan, walls, inner).run(progress);
}

HPoint place_of(const Plan& plan, const Mark& mark) {
    if (mark.surface < 0) return hpoint(plan.at(mark.carrier.first));
    const Surface& s = at(plan.surfaces, mark.surface);
    const PlanPoint& p = plan.points[mark.point];
    const WideInt<1> c(s.plane.c);
    return {multiply<4>(WideInt<2>(p.X), c), multiply<4>(WideInt<2>(p.Y), c),
            height_numerator(s, p), multiply<4>(WideInt<1>(p.w), c)};
}

}  // namespace tetra::fence
